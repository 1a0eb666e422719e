// stream_to_raw STREAM DIR: the layers of a stream as plain arrays, for peers that know no brick stream.
// Writes DIR/solid.raw and DIR/closing.raw, one bit per voxel of the stream's brick box, x fastest, lowest bit first,
// and prints the box as JSON.
#include <cstdio>

#include "io/stream/brick_stream.h"
#include "lib/core/error.h"

int main(int argc, char** argv) try {
  if (argc != 3) {
    std::fprintf(stderr, "usage: stream_to_raw STREAM DIR\n");
    return 2;
  }
  bp::BrickReader source(argv[1]);
  const bp::VoxelBox box = bp::voxels_of(source.header().bricks);
  bp::BitBox layers[2] = {bp::BitBox(box), bp::BitBox(box)};
  for (bp::Brick brick; source.read(brick);) {
    bp::BitBox& bits = layers[std::size_t(brick.layer)];
    const bp::VoxelCoord first = bp::first_voxel(brick.coord);
    for (std::int32_t z = 0; z < bp::kBrickEdge; ++z) {
      for (std::int32_t y = 0; y < bp::kBrickEdge; ++y) {
        bits.row(first.y + y, first.z + z)[(first.x - box.min.x) / 64] =
            brick.bits[std::size_t(z * bp::kBrickEdge + y)];
      }
    }
  }
  for (const char* name : {"solid", "closing"}) {
    const bp::BitBox& bits = layers[name[0] == 's' ? 0 : 1];
    bp::OutputFile file(fmt::format("{}/{}.raw", argv[2], name), true);
    file.write(std::as_bytes(std::span(bits.data(), std::size_t(bits.word_count()))));
    file.commit();
  }
  const bp::VoxelCoord size = box.size();
  fmt::print("{{\"size\": [{}, {}, {}], \"solid\": {}, \"closing\": {}}}\n", size.x, size.y, size.z, layers[0].count(),
             layers[1].count());
  return 0;
} catch (const bp::Error& e) {
  std::fprintf(stderr, "stream_to_raw: %s\n", e.what());
  return bp::exit_code(e.code());
}
