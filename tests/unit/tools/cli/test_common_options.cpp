#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "io/files/kept_files.h"
#include "io/scene/scene_parts.h"
#include "lib/core/error.h"
#include "tests/catch.h"
#include "tests/unit/io/scene/scene_files.h"
#include "tools/cli/common_options.h"
#include "tools/cli/report.h"
#include "tools/run/make_backend.h"
#include "tools/run/provenance.h"

using namespace bp;

namespace {

CommonOptions parse_common(std::vector<const char*> words) {
  words.insert(words.begin(), "bptest");
  CommonOptions o;
  Args args("bptest", int(words.size()), words.data());
  o.add_to(args);
  args.parse();
  return o;
}

}  // namespace

TEST_CASE("devices are auto, cpu, cuda or a list", "[quick][tools]") {
  using Kind = DeviceChoice::Kind;
  CHECK(parse_device("auto").kind == Kind::automatic);
  CHECK(parse_device("cpu").kind == Kind::cpu);
  CHECK(parse_device("cuda") == DeviceChoice{Kind::cuda, {}});
  CHECK(parse_device("cuda:0,3") == DeviceChoice{Kind::cuda, {0, 3}});
  const std::string bad =
      GENERATE("", "gpu", "cuda:", "cuda:a", "cuda:0,", "cuda:-1", "CPU", "cuda:0,,1", "cuda:0,0", "cuda:1,0,1");
  CAPTURE(bad);
  CHECK_THROWS_AS(parse_device(bad), Error);
}

TEST_CASE("common options mean the same in every tool", "[quick][tools]") {
  const CommonOptions o = parse_common({"-j2", "--memory", "1G", "--device=cpu", "--progress", "json", "--overwrite"});
  CHECK(o.threads == 2);
  CHECK(o.memory_bytes == std::uint64_t(1) << 30);
  CHECK(o.device.kind == DeviceChoice::Kind::cpu);
  CHECK(o.progress == ProgressMode::json);
  CHECK(o.overwrite);
  CHECK(parse_common({"-q"}).progress == ProgressMode::quiet);
}

TEST_CASE("a scratch directory that cannot be used is noticed before the work", "[quick][tools]") {
  CommonOptions missing = parse_common({"--temp", "/nonexistent/directory"});
  CHECK_THROWS_AS(missing.prepare(), Error);
  CommonOptions file = parse_common({"--temp", "/dev/null"});
  CHECK_THROWS_AS(file.prepare(), Error);
  CommonOptions no_unit = parse_common({"--memory", "4"});
  CHECK_THROWS_AS(no_unit.prepare(SmallMemory::waits), Error);
  CommonOptions small = parse_common({"--memory", "1M"});
  CHECK_THROWS_AS(small.prepare(), Error);
  check_outputs();  // another call of the same process may write
  CommonOptions good = parse_common({});
  good.prepare();
  CHECK_FALSE(good.temp.empty());
  CHECK(good.memory_bytes == default_memory());
}

TEST_CASE("a file in the place of the report is noticed before the work", "[quick][tools]") {
  const auto path = std::filesystem::temp_directory_path() / "bp-test-report-exists.json";
  std::ofstream(path) << "kept";
  CommonOptions o = parse_common({"--report", path.c_str()});
  CHECK_THROWS_AS(o.prepare(), Error);
  o.overwrite = true;
  CHECK_NOTHROW(o.prepare());
  std::filesystem::remove(path);
}

TEST_CASE("a report replaces an earlier one, and nothing else", "[quick][tools]") {
  const test::TempDir dir;
  Report report("bpvox");
  const std::string earlier = dir.file("r.json", report.text()), empty = dir.file("empty", "");
  CHECK_NOTHROW(parse_common({"--report", earlier.c_str()}).prepare());
  CHECK_NOTHROW(parse_common({"--report", empty.c_str()}).prepare());
  for (const char* text : {"{\"tool\": 1}", "{\n  \"tool\": \"ot", "v 0 0 0\n"})
    CHECK_THROWS_AS(parse_common({"--report", dir.file("other", text).c_str()}).prepare(), Error);
}

TEST_CASE("a GPU that a CPU build is asked for is a missing resource", "[quick][tools]") {
#ifndef BP_HAVE_CUDA
  try {
    (void)make_backends(parse_common({"--device", "cuda"}), 0);
    FAIL("no error");
  } catch (const Error& e) {
    CHECK(e.code() == ErrorCode::out_of_resource);
  }
#endif
}

TEST_CASE("a GPU that BP_BACKEND asks for and that is not there is an error that names the variable",
          "[quick][tools]") {
  ::setenv("BP_BACKEND", "cuda:999", 1);
  try {
    (void)make_backends(parse_common({}), 0);
    FAIL("no error");
  } catch (const Error& e) {
    CHECK(e.code() == ErrorCode::out_of_resource);
    CHECK(std::string(e.what()).find("BP_BACKEND cuda") == 0);
  }
  ::unsetenv("BP_BACKEND");
}

TEST_CASE("a BP_BACKEND that names no device is a usage error that names the variable", "[quick][tools]") {
  ::setenv("BP_BACKEND", "gpu", 1);
  try {
    (void)make_backends(parse_common({}), 0);
    FAIL("no error");
  } catch (const Error& e) {
    CHECK(e.code() == ErrorCode::bad_argument);
    CHECK(std::string(e.what()).find("BP_BACKEND") != std::string::npos);
  }
  ::setenv("BP_BACKEND", "cpu", 1);
  CHECK(names_of(make_backends(parse_common({"-j2"}), 0)) == std::vector<std::string>{"cpu"});
  ::unsetenv("BP_BACKEND");
}

TEST_CASE("the option text is canonical", "[quick][tools]") {
  OptionText text;
  text.add("voxel", 0.1)
      .add("error", "")
      .add("fill", "flood")
      .add("tile", 256)
      .add("keep", false)
      .add("scale", parse_length("2.50%"));
  CHECK(text.text() == "voxel=0.1 fill=flood tile=256 keep=no scale=2.5%");
  CHECK(make_provenance("bpvox", text).options == text.text());
}

TEST_CASE("an output is neither an input nor another output", "[quick][tools]") {
  const KeepsInputs scope;
  const std::filesystem::path folder = std::filesystem::temp_directory_path();
  const std::string scene = (folder / "bp-test-scene.obj").string(), out = (folder / "bp-test-out.bpv").string();
  keep_inputs({scene, "-"});
  CHECK_THROWS_AS(open_output(scene, true), Error);
  CHECK_THROWS_AS(open_output((folder / "." / "bp-test-scene.obj").string(), true), Error);
  const auto first = open_output(out, true);
  CHECK_THROWS_AS(open_output(out, true), Error);
  CHECK_NOTHROW(open_output("/dev/null", true));
  CHECK_NOTHROW(open_output("/dev/null", true));
}

TEST_CASE("an output is no buffer, texture or material of an input", "[quick][tools]") {
  const KeepsInputs scope;
  const test::TempDir dir;
  const std::string gltf = dir.file(
      "s.gltf",
      R"({"asset":{"version":"2.0"},"buffers":[{"uri":"a%20b.bin"},{"uri":"data:,"}],"images":[{"uri":"t.png"},{}]})");
  const std::string obj = dir.file("s.obj", "v 0 0 0\nmtllib s.mtl\r\nmtllib other/more.mtl\n");
  (void)dir.file("s.mtl", "newmtl a\nmap_Kd -s 1 1 1 wood.png\n bump my bumps.png\r\n");
  CHECK(missing_materials(obj) == std::vector<std::string>{dir.path("other/more.mtl") + " is not there"});
  keep_inputs({gltf, obj, dir.file("broken.gltf", "{")});
  for (const char* name : {"a b.bin", "t.png", "wood.png", "my bumps.png", "free.png"}) (void)dir.file(name, "");
  for (const char* name : {"a b.bin", "t.png", "s.mtl", "wood.png", "my bumps.png"})
    CHECK_THROWS_AS(open_output(dir.path(name), true), Error);
  CHECK_NOTHROW(open_output(dir.path("free.png"), true));
  CHECK_NOTHROW(open_output(dir.path("new.bin"), true));
}

TEST_CASE("an output is no input by another name", "[quick][tools]") {
  const KeepsInputs scope;
  const test::TempDir dir;
  const std::string scene = dir.file("scene.obj", "v 0 0 0\n");
  keep_inputs({scene});
  std::filesystem::create_hard_link(scene, dir.path("hard.obj"));
  std::filesystem::create_symlink("scene.obj", dir.path("soft.obj"));
  std::filesystem::create_directory_symlink(".", dir.path("here"));
  for (const char* name : {"hard.obj", "soft.obj", "here/scene.obj", "./scene.obj", "here/hard.obj"}) {
    CAPTURE(name);
    CHECK_THROWS_AS(open_output(dir.path(name), true), Error);
  }
  CHECK(test::bytes_of_file(scene) == "v 0 0 0\n");
}
