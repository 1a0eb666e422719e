// bp-plant: writes an industrial plant of any size, as PLY or GLB. A sample scene: thousands of components that
// overlap, are open, mirrored and repeated, as in real models.
#include <fmt/core.h>

#include <optional>

#include "io/scene/file_ending.h"
#include "lib/core/error.h"
#include "samples/plant/write.h"
#include "tools/cli/run_tool.h"

namespace {

enum class Format { by_name, ply, glb };

struct Options {
  std::uint64_t triangles = 200000, seed = 1;
  std::optional<std::uint64_t> change;
  std::string out = "-";
  Format format = Format::by_name;
  bool overwrite = false;
};

Options parse(bp::Args& args) {
  Options o;
  args.about("Writes a generated industrial plant: tanks, pipe racks, columns, halls, fences, in metres, y up.");
  args.example("bp-plant --triangles 1000000 --seed 7 -o plant.glb");
  args.option("--triangles", "N", o.triangles, "how many, about: within 1 percent");
  args.option("--seed", "N", o.seed, "another seed, another plant");
  args.option("--change", "N", o.change, ".ply: the same plant with its N-th component raised by 2 m");
  args.option("-o,--output", "FILE", o.out, ".ply (all triangles) or .glb (instanced)");
  args.option("--format", {{"auto", Format::by_name}, {"ply", Format::ply}, {"glb", Format::glb}}, o.format,
              "instead of the ending of FILE");
  args.flag("--overwrite", o.overwrite, "replace FILE if it exists");
  args.parse();
  const bp::FileEnding ending = bp::file_ending_of(o.out);
  if (o.format == Format::by_name && !ending.is(bp::FileKind::unknown) && ending.text != "ply" && ending.text != "glb")
    bp::fail(bp::ErrorCode::bad_argument, "{}: the plant is written as .ply or .glb, not as {}", o.out, ending.text);
  return o;
}

void run(const Options& o) {
  const bool glb = o.format == Format::glb || (o.format == Format::by_name && o.out.ends_with(".glb"));
  if (glb && o.change) bp::fail(bp::ErrorCode::bad_argument, "--change needs PLY: in a GLB a shape is shared");
  const plant::Site site(o.triangles, o.seed);
  const auto file = bp::open_output(o.out, o.overwrite);
  if (o.change) {
    plant::write_changed_ply(site, *o.change, *file);
  } else {
    glb ? plant::write_glb(site, *file) : plant::write_ply(site, *file);
  }
  file->commit();
  const plant::Counts& c = site.counts();
  if (o.out != "-")
    fmt::print("{}: {} triangles, {} components, {} bytes\n", o.out, c.triangles, c.parts, file->bytes());
}

}  // namespace

int main(int argc, char** argv) {
  return bp::run_tool("bp-plant", argc, argv, parse, run);
}
