#include <cmath>

#include "lib/device/cpu/cpu_backend.h"
#include "lib/pass/close/close_pass.h"
#include "lib/pass/mesh/complement.h"
#include "tests/catch.h"
#include "tests/reference/closing.h"
#include "tests/support/memory_scene.h"
#include "tests/support/voxel_source.h"

using namespace bp;
using namespace bp::test;

namespace {

BitBox layer_of(const MemorySink& sink, Layer layer) {
  MemoryShelf shelf;
  for (const Brick& b : sink.bricks) {
    if (b.layer == layer) shelf.put(b.coord, b.fill, b.bits);
  }
  BitBox bits(voxels_of(sink.header.bricks));
  load_voxels(shelf, bits);
  return bits;
}

BitBox complement_of(const BitBox& bits) {
  BitBox out = bits;
  for (std::int64_t i = 0; i < out.word_count(); ++i) out.data()[i] = ~out.data()[i];
  return out;
}

/// A box with a fin, a tunnel and a cavity.
bool shape(VoxelCoord p) {
  const bool box = p.x >= 8 && p.x < 30 && p.y >= 9 && p.y < 27 && p.z >= 7 && p.z < 31;
  const bool fin = p.x >= 30 && p.x < 40 && p.y >= 16 && p.y < 18 && p.z >= 10 && p.z < 26;
  const bool tunnel = std::hypot(p.y - 15.0, p.z - 14.0) < 2.5;
  const bool cavity = std::abs(p.x - 20) < 3 && std::abs(p.y - 20) < 2 && std::abs(p.z - 24) < 3;
  return (box || fin) && !tunnel && !cavity;
}

}  // namespace

TEST_CASE("the opening is the complement of the closing of the complement", "[quick][pass]") {
  const auto element = GENERATE(StructuringElement::ball, StructuringElement::cube);
  const double scale = GENERATE(1.0, 2.5, 4.0);
  VoxelSource source({{0, 0, 0}, {48, 40, 40}}, shape);
  source.set_slab_axis(GENERATE(0, 1, 2));
  CAPTURE(scale, source.header().slab_axis);
  const BitBox solid = bits_of({{0, 0, 0}, {48, 40, 40}}, shape);
  ScaleField field;
  field.base = scale;
  MemorySink written;
  written.header = source.header();
  Backends backends;
  backends.push_back(std::make_unique<CpuBackend>());
  CloseOptions options;
  options.keep_cavities = true;
  options.context.make_shelf = memory_shelves();
  ComplementSource complement(source);
  ComplementSink sink(written, source.header());
  close_stream(complement, sink, backends, field, {element}, options);
  sink.finish();

  CHECK(layer_of(written, Layer::solid) == solid);
  BitBox wide(solid.box().grown(64));  // so wide that its border does not matter
  copy_voxels(solid, wide);
  const GridFrame frame;
  const ScaleLattice lattice = field.sample(frame, wide.box().grown(8));
  const BitBox opened = complement_of(reference::close(complement_of(wide), lattice, element, solid.box()));
  CHECK(layer_of(written, Layer::closing) == opened);
  if (scale > 2) CHECK(opened.count() < solid.count());
  CHECK(opened.count() > 0);
}

TEST_CASE("the complement of the complement of a stream is the stream", "[quick][pass]") {
  const VoxelBox box{{-70, 3, 10}, {140, 60, 90}};
  const Solid solid = [](VoxelCoord p) { return (p.x * 7 + p.y * 5 + p.z * 3) % 13 < 5 || p.x > 63; };
  VoxelSource source(box, solid);
  source.set_slab_axis(GENERATE(0, 1, 2));
  const BitBox bits = bits_of(box, solid);
  ComplementSource complement(source);
  MemoryShelf turned, again;
  Brick last, brick;
  for (bool first = true; complement.read(brick); first = false) {
    if (!first) REQUIRE(slab_order(source.header().slab_axis, last, brick));
    REQUIRE(brick.fill == classify(brick.bits));
    turned.put(brick.coord, brick.fill, brick.bits);
    last = brick;
  }
  bp::complement(turned, source.header().bricks, again);
  BitBox got(bits.box());
  load_voxels(again, got);
  CHECK(got == bits);
}
