#include "lib/core/error.h"
#include "tests/catch.h"
#include "tools/cli/args.h"
#include "tools/cli/help/help.h"

using namespace bp;

namespace {

enum class Element { cube, ball };

struct Options {
  std::string in = "-", out = "-";
  Length scale{2, Length::Unit::percent};
  std::optional<int> faces;
  Element element = Element::cube;
  bool keep = false, loud = false;
  std::vector<std::string> names;
  std::string progress = "off";
};

Options parse(std::vector<const char*> words) {
  words.insert(words.begin(), "bptest");
  Options o;
  Args args("bptest", int(words.size()), words.data());
  args.positional("INPUT", o.in, "what to read");
  args.option("-o,--output", "FILE", o.out, "where to");
  args.option("-s,--scale", "LENGTH", o.scale, "how far");
  args.option("--faces", "N", o.faces, "how many");
  args.option("--element", {{"cube", Element::cube}, {"ball", Element::ball}}, o.element, "which");
  args.option("--name", "NAME", o.names, "several");
  args.flag("-k,--keep", o.keep, "keep it");
  args.flag("-l", o.loud, "loudly");
  args.flag_with_word(
      "--progress", {"json"}, [&](const std::string& word) { o.progress = word; }, "show it");
  args.parse();
  return o;
}

std::string complaint(const std::vector<const char*>& words) {
  try {
    parse(words);
  } catch (const Error& e) {
    CHECK(e.code() == ErrorCode::bad_argument);
    return e.what();
  }
  return "none";
}

}  // namespace

TEST_CASE("options that are not given keep their defaults", "[quick][tools]") {
  const Options o = parse({});
  CHECK(o.in == "-");
  CHECK(o.scale == Length{2, Length::Unit::percent});
  CHECK_FALSE(o.faces);
  CHECK(o.element == Element::cube);
}

TEST_CASE("a value follows its option, an equals sign or a short name", "[quick][tools]") {
  CHECK(parse({"--scale", "3"}).scale.value == 3);
  CHECK(parse({"--scale=3"}).scale.value == 3);
  CHECK(parse({"-s", "3"}).scale.value == 3);
  CHECK(parse({"-s3"}).scale.value == 3);
  CHECK(parse({"-kls3"}).scale.value == 3);
  CHECK(parse({"-kls3"}).keep);
  CHECK(parse({"--faces", "12"}).faces == 12);
  CHECK(parse({"--element", "ball"}).element == Element::ball);
  CHECK(parse({"--name", "a", "--name=b"}).names == std::vector<std::string>{"a", "b"});
  CHECK(parse({"-o", "-"}).out == "-");
  CHECK_THROWS_WITH(parse({"--output="}), Catch::Matchers::Contains("--output is empty"));
}

TEST_CASE("an optional word never swallows a file name", "[quick][tools]") {
  CHECK(parse({}).progress == "off");
  CHECK(parse({"--progress", "scene.glb"}).progress.empty());
  CHECK(parse({"--progress", "scene.glb"}).in == "scene.glb");
  CHECK(parse({"--progress", "json", "scene.glb"}).progress == "json");
  CHECK(parse({"--progress=json"}).progress == "json");
}

TEST_CASE("after two dashes everything is an argument", "[quick][tools]") {
  CHECK(parse({"--", "--scale"}).in == "--scale");
  CHECK(parse({"-"}).in == "-");
}

TEST_CASE("a usage error names the option and the fact", "[quick][tools]") {
  CHECK(complaint({"--scale", "-1"}) == "--scale: '-1' is negative; a length is at least 0 (see bptest --help)");
  CHECK(complaint({"--scale"}) == "--scale needs a value (see bptest --help)");
  CHECK(complaint({"--scal", "1"}) == "there is no option --scal; did you mean --scale? (see bptest --help)");
  CHECK(complaint({"-x"}) == "there is no option -x (see bptest --help)");
  CHECK(complaint({"-s1", "--scale=1"}) == "--scale is given twice (see bptest --help)");
  CHECK(complaint({"a", "b"}) == "'b' is one argument too many; did you mean -o b? (see bptest --help)");
  CHECK(complaint({"--keep=1"}) == "--keep takes no value (see bptest --help)");
  CHECK(complaint({"--element", "Cube"}) ==
        "--element: 'Cube' is none of cube|ball; did you mean cube? (see bptest --help)");
  CHECK(complaint({"--faces", "-1"}) == "--faces: '-1' is not a whole number from 0 to 2147483647 (see bptest --help)");
  CHECK(complaint({"--progress=xml"}) == "--progress: 'xml' is none of [json] (see bptest --help)");
}

TEST_CASE("an option that means nothing beside the others is refused, its default included", "[quick][tools]") {
  const auto parsed = [](std::vector<const char*> words) {
    words.insert(words.begin(), "bptest");
    int size = 720;
    std::string image;
    Args args("bptest", int(words.size()), words.data());
    args.option("-i,--image", "FILE", image, "draw");
    args.option("--size", "N", size, "how large");
    args.parse();
    CHECK(args.given("--image") == !image.empty());
    args.needs({"--size"}, "--image");
  };
  CHECK_NOTHROW(parsed({}));
  CHECK_NOTHROW(parsed({"-i", "x"}));
  CHECK_NOTHROW(parsed({"--size", "9", "-ix"}));
  CHECK_THROWS_AS(parsed({"--size", "720"}), Error);
}

TEST_CASE("a required list of files is asked for", "[quick][tools]") {
  std::vector<std::string> files;
  const char* words[] = {"bptest", "a", "b"};
  Args full("bptest", 3, words);
  full.positional("SCENE", files, "scenes");
  full.parse();
  CHECK(files == std::vector<std::string>{"a", "b"});
  Args none("bptest", 1, words);
  none.positional("SCENE", files, "scenes");
  CHECK_THROWS_AS(none.parse(), Error);
}

TEST_CASE("the help shows names, defaults and the example within 80 columns", "[quick][tools]") {
  Args args("bptest", 0, nullptr);
  double x = 0.5;
  args.about("Tests.");
  args.example("bptest --edge 1");
  args.option("-e,--edge", "LENGTH", x, "a text that is long enough to be wrapped at the right margin, and then some");
  const std::string help = full_help(args.declaration());
  CHECK(help.find("-e, --edge LENGTH") != std::string::npos);
  CHECK(help.find("(default: 0.5)") != std::string::npos);
  CHECK(help.find("bptest --edge 1") != std::string::npos);
  for (std::size_t begin = 0; begin < help.size(); begin = help.find('\n', begin) + 1)
    CHECK(help.find('\n', begin) - begin <= 80);
}

TEST_CASE("a slip is answered with what it is likely to mean", "[quick][tools]") {
  using Catch::Matchers::Contains;
  CHECK_THAT(complaint({"--face", "12"}), Contains("there is no option --face; did you mean --faces?"));
  CHECK_THAT(complaint({"--facse=12"}), Contains("did you mean --faces?"));
  CHECK_THAT(complaint({"--Scale", "2"}), Contains("did you mean --scale?"));
  CHECK_THAT(complaint({"-faces", "12"}), Contains("there is no option -faces; did you mean --faces?"));
  CHECK_THAT(complaint({"-scale", "2"}), Contains("there is no option -scale; did you mean --scale?"));
  CHECK_THAT(complaint({"--element", "bal"}), Contains("'bal' is none of cube|ball; did you mean ball?"));
  CHECK_THAT(complaint({"--progress=jsn"}), Contains("did you mean json?"));
  CHECK_THAT(complaint({"--element", "sphere"}), !Contains("did you mean"));
  CHECK_THAT(complaint({"--enormous"}), !Contains("did you mean"));
  CHECK_THAT(complaint({"-x"}), !Contains("did you mean"));
}

TEST_CASE("counts may be in thousands and millions", "[quick][tools]") {
  CHECK(parse({"--faces", "2k"}).faces == 2000);
  CHECK(parse({"--faces", "1.5M"}).faces == 1500000);
  CHECK_THAT(complaint({"--faces", "1.2345k"}), Catch::Matchers::Contains("'1.2345k' is not a whole number"));
  CHECK_THAT(complaint({"--faces", "9G"}), Catch::Matchers::Contains("'9G' is not a whole number from 0 to"));
}

TEST_CASE("an option of earlier versions is answered with what replaces it", "[quick][tools]") {
  const char* const words[] = {"bptest", "--old"};
  Args args("bptest", 2, words);
  args.removed("--old", "--new does the same");
  using Catch::Matchers::Contains;
  try {
    args.parse();
    FAIL("--old was taken");
  } catch (const Error& e) {
    CHECK_THAT(e.what(), Contains("there is no option --old any more; --new does the same"));
  }
}

TEST_CASE("the short help has the options that are needed often, the full help and the manual have all",
          "[quick][tools]") {
  const char* const words[] = {"bptest"};
  Args args("bptest", 1, words);
  double edge = 0.5;
  int kind = 0;
  args.group("Size");
  args.option("-e,--edge", "LENGTH", edge, "length of an edge; a longer text");
  args.group("Kind");
  args.option("--kind", {{"plain", 0, "nothing else"}, {"round", 1, "as --edge says"}}, kind, "what is made");
  args.often({"--edge"});
  const ToolDeclaration tool = args.declaration();
  CHECK(short_help(tool).find("length of an edge (default: 0.5)\n") != std::string::npos);
  CHECK(short_help(tool).find("--kind") == std::string::npos);
  CHECK(full_help(tool).find("Kind:\n  --kind plain|round") != std::string::npos);
  CHECK(full_help(tool).find("        round  as --edge says\n") != std::string::npos);
  CHECK(markdown_help(tool).find("## Kind\n\n- `--kind plain|round`: what is made (default: plain)\n") !=
        std::string::npos);
  CHECK(markdown_help(tool).find("  - `round`: as `--edge` says\n") != std::string::npos);
}
