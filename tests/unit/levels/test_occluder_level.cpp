#include "lib/levels/level_chain.h"
#include "lib/levels/occluder_level.h"
#include "tests/catch.h"
#include "tests/support/memory_scene.h"
#include "tests/support/voxel_source.h"

using namespace bp;
using namespace bp::test;

namespace {

constexpr VoxelBox kBox{{0, 0, 0}, {128, 112, 120}};

VoxelizedScene voxels(const Solid& touched) {
  VoxelSource source(kBox, touched);
  VoxelizedScene scene;
  scene.header = source.header();
  scene.header.fill = FillMode::none;
  scene.header.slab_axis = longest_axis(scene.header.bricks);
  scene.solid = std::make_unique<MemoryShelf>();
  for (Brick brick; source.read(brick);) scene.solid->put(brick.coord, brick.fill, brick.bits);
  return scene;
}

/// The hidden voxels of a scene, its occluder, and the progress that was shown.
struct Run {
  HiddenScene hidden;
  MadeOccluder made;
  struct Step {
    std::string pass;
    std::uint64_t done = 0, total = 0;
  };
  std::vector<Step> steps;
};

Run run(const Solid& touched) {
  Run out;
  OccluderRequest request;
  request.hidden.context = memory_context();
  request.hidden.context.progress = [&](const char* pass, const char*, std::uint64_t done, std::uint64_t total) {
    out.steps.push_back({pass, done, total});
  };
  Backends backends = plain_backends(2);
  const VoxelizedScene scene = voxels(touched);
  out.hidden = hidden_scene(scene.header, *scene.solid, backends, request, "closing openings");
  out.made = make_occluder(scene.header, out.hidden, backends, request);
  return out;
}

/// A wall of 3 voxels around a box.
bool wall(const VoxelBox& box, VoxelCoord p) {
  return box.contains(p) && !box.grown(-3).contains(p);
}

/// A plate of ten voxels over all of the box, open on no side.
bool plate(VoxelCoord p) {
  return wall({{0, 0, 0}, {128, 10, 120}}, p);
}

/// On the plate, behind a door of 7 voxels.
bool hut(VoxelCoord p) {
  const bool door = p.x >= 27 && p.x < 30 && p.y < 25 && p.z >= 16 && p.z < 23;
  return plate(p) || (wall({{6, 7, 6}, {30, 30, 30}}, p) && !door);
}

/// A box with one corner cut off: little of it, in steps that no few faces follow.
bool cut_box(VoxelCoord p) {
  return p.x + p.y + p.z >= 7;
}

/// Returns the number of hidden voxels that the definition gives at a scale.
std::uint64_t hidden_at(const Solid& touched, double scale) {
  VoxelizedScene scene = voxels(touched);
  HiddenOptions options;
  options.scale_world = scale;
  options.context = memory_context();
  Backends backends = plain_backends(2);
  return hidden_voxels(scene.header, *scene.solid, backends, options).count;
}

}  // namespace

TEST_CASE("the least scale of an occluder that hides enough of all is taken, also where some are not tried",
          "[quick][levels][occluder]") {
  const Solid scene = GENERATE(Solid(plate), Solid(hut));
  const HiddenScene made = run(scene).hidden;
  for (const auto& [scale, count] : made.tried) {
    CAPTURE(scale);
    CHECK(count == hidden_at(scene, scale));
  }
  const std::vector<double> scales = occluder_scales(voxels(scene).header);
  CHECK(made.tried.size() <= scales.size());
  std::vector<std::uint64_t> counts;
  for (const double scale : scales) counts.push_back(hidden_at(scene, scale));
  const double most = double(*std::max_element(counts.begin(), counts.end()));
  const auto enough =
      std::find_if(counts.begin(), counts.end(), [&](std::uint64_t n) { return double(n) >= 0.95 * most; });
  CHECK(made.scale_world == scales[std::size_t(enough - counts.begin())]);
  CHECK(made.voxels.count == *enough);
}

TEST_CASE("a search for what is hidden gives up where no scale can hide as much as is wanted",
          "[quick][levels][occluder]") {
  VoxelizedScene scene = voxels(hut);
  Backends backends = plain_backends(2);
  OccluderRequest request;
  request.hidden.context = memory_context();
  const auto hidden = [&](double more_than) {
    request.more_than_voxels = more_than;
    return hidden_scene(scene.header, *scene.solid, backends, request, "closing openings").voxels.count;
  };
  const std::uint64_t most = hidden(0);
  CHECK(most > 0);
  CHECK(hidden(double(most) - 1) == most);
  CHECK(hidden(2 * double(most)) == 0);
}

TEST_CASE("a plate does not hide the hut on it, and a closing does", "[quick][levels][occluder]") {
  CHECK(run(plate).hidden.scale_world == 0);
  const HiddenScene made = run(hut).hidden;
  CHECK(made.scale_world > 0);
  CHECK(made.voxels.count > made.tried.front().hidden_voxels);
}

TEST_CASE("a scene that fills its bounds gains nothing on the ground, one that is open below does",
          "[quick][levels][occluder]") {
  const auto count = [](const Solid& touched) { return run(touched).hidden.voxels.count; };
  const StreamHeader header = voxels(plate).header;
  CHECK_FALSE(may_gain_on_ground(header, count([](VoxelCoord p) { return wall(kBox, p); })));
  const Solid open = [](VoxelCoord p) { return (wall(kBox, p) && p.y >= 3) || (kBox.contains(p) && p.y >= 100); };
  const std::uint64_t without = count(open);
  CHECK(may_gain_on_ground(header, without));
  CHECK(gains_on_ground(count([&](VoxelCoord p) { return open(p) || p.y == 0; }), without));
}

TEST_CASE("openings of what an occluder hides are tried until a mesh holds all of it", "[quick][levels][occluder]") {
  const Run all = run([](VoxelCoord p) { return wall(kBox, p); });
  CHECK(all.made.level.attempts == 1);
  CHECK(volume_of(all.made.level) == double(all.hidden.voxels.count));
  const Run less = run(cut_box);
  CHECK(volume_of(less.made.level) < double(less.hidden.voxels.count));
  CHECK(volume_of(less.made.level) > 0.999 * double(less.hidden.voxels.count));
  CHECK(less.made.level.attempts == 2);  // the first holds 0.999 of it, and the next might hold more
}

TEST_CASE("an occluder shows the scales and openings that are done, of those that may come",
          "[quick][levels][occluder]") {
  const Run open = run(cut_box);
  std::vector<std::string> passes;
  std::uint64_t done = 0;
  for (const Run::Step& step : open.steps) {
    const bool begins = passes.empty() || passes.back() != step.pass;
    if (begins) passes.push_back(step.pass);
    CHECK(step.done >= (begins ? 0 : done));
    CHECK(step.done <= step.total);
    done = step.done;
  }
  CHECK(passes == std::vector<std::string>{"closing openings", "meshing"});
  CHECK(open.steps.back().done == std::uint64_t(open.made.level.attempts));
  CHECK(open.steps.back().total == 5);  // 0, 2, 4, 8 and 16 voxels of 209
}
