// kept_parts STREAM THIN GAP WIDE: counts the parts that a closing keeps. Lengths in voxels. For a stream with both
// layers:
//   - thin parts, at most THIN thick and in pieces of THIN^3 / 8 voxels or more: kept if at least half of their voxels
//     are thin in the closing, too, which may be two voxels thicker; others are bridged or swallowed;
//   - openings that are GAP wide or more, but less than WIDE: pieces that are at least half empty in the closing, and
//     the share of their voxels that is empty;
//   - narrower places: the share of their voxels that is filled.
#include <cstdio>
#include <cstdlib>

#include "io/stream/brick_stream.h"
#include "lib/core/error.h"
#include "lib/volume/openings.h"

namespace {

using namespace bp;

template <class Body>
void for_each_set(const BitBox& bits, const Body& body) {
  const VoxelBox& box = bits.box();
  for (VoxelCoord p = box.min; p.z < box.max.z; ++p.z) {
    for (p.y = box.min.y; p.y < box.max.y; ++p.y) {
      for (p.x = box.min.x; p.x < box.max.x; ++p.x) {
        if (bits.test(p)) body(p);
      }
    }
  }
}

void clear(BitBox& bits, VoxelCoord p) {
  const std::int32_t i = p.x - bits.box().min.x;
  bits.row(p.y, p.z)[i >> 6] &= ~(std::uint64_t(1) << (i & 63));
}

struct Pieces {
  std::uint64_t count = 0, kept = 0, voxels = 0, kept_voxels = 0;
};

/// Pieces that touch, over corners, of at least `least` voxels; one is kept if half of it is in `in`.
Pieces pieces_in(BitBox bits, const BitBox& in, std::uint64_t least) {
  Pieces all;
  for_each_set(BitBox(bits), [&](VoxelCoord first) {
    if (!bits.test(first)) return;
    std::uint64_t voxels = 0, kept = 0;
    std::vector<VoxelCoord> left{first};
    clear(bits, first);
    while (!left.empty()) {
      const VoxelCoord p = left.back();
      left.pop_back();
      ++voxels;
      kept += in.test(p);
      for (VoxelCoord d{-1, -1, -1}; d.z < 2; ++d.z) {
        for (d.y = -1; d.y < 2; ++d.y) {
          for (d.x = -1; d.x < 2; ++d.x) {
            if (!bits.test(p + d)) continue;
            clear(bits, p + d);
            left.push_back(p + d);
          }
        }
      }
    }
    if (voxels < least) return;
    ++all.count;
    all.kept += 2 * kept >= voxels;
    all.voxels += voxels;
    all.kept_voxels += kept;
  });
  return all;
}

BitBox without(BitBox bits, const BitBox& gone) {
  for (std::int64_t i = 0; i < bits.word_count(); ++i) bits.data()[i] &= ~gone.data()[i];
  return bits;
}

BitBox complement(BitBox bits) {
  for (std::int64_t i = 0; i < bits.word_count(); ++i) bits.data()[i] = ~bits.data()[i];
  return bits;
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 5) {
    std::fprintf(stderr, "usage: kept_parts STREAM THIN GAP WIDE\n");
    return 2;
  }
  BrickReader source(argv[1]);
  const int thin = std::atoi(argv[2]), gap = (std::atoi(argv[3]) - 1) / 2, wide = (std::atoi(argv[4]) - 1) / 2;
  BitBox solid(voxels_of(source.header().bricks).grown(2 * wide + 2)), closing(solid.box());
  for (Brick brick; source.read(brick);) {
    BitBox& to = brick.layer == Layer::solid ? solid : closing;
    const VoxelCoord first = first_voxel(brick.coord);
    for (std::int32_t z = 0; z < kBrickEdge; ++z) {
      for (std::int32_t y = 0; y < kBrickEdge; ++y)
        to.row(first.y + y, first.z + z)[(first.x - to.box().min.x) / 64] = brick.bits[std::size_t(z * kBrickEdge + y)];
    }
  }
  const int h = (thin + 1) / 2;
  const Pieces parts =
      pieces_in(thin_parts(solid, h), thin_parts(closing, h + 1), std::uint64_t(thin * thin * thin / 8));
  const BitBox narrow = narrow_places(solid, gap), empty = complement(closing);
  const Pieces openings = pieces_in(without(narrow_places(solid, wide), narrow), empty, std::uint64_t(gap * gap * gap));
  const Pieces narrows = pieces_in(narrow, closing, 1);
  const auto share = [](const Pieces& p) { return p.voxels > 0 ? double(p.kept_voxels) / double(p.voxels) : 1; };
  fmt::print(
      "closing {} voxels; thin parts {} of {}; openings {} of {}, {:.3f} of their voxels; narrow places {:.3f} "
      "closed\n",
      closing.count(), parts.kept, parts.count, openings.kept, openings.count, share(openings), share(narrows));
  return 0;
} catch (const bp::Error& e) {
  std::fprintf(stderr, "kept_parts: %s\n", e.what());
  return bp::exit_code(e.code());
}
