#pragma once
#include <array>
#include <string>
#include <vector>

#include "lib/grid/brick.h"
#include "tests/fuzz/choices.h"

/// Brick streams with any contents, whose hashes and counts fit (docs/brick-stream.md).
namespace fuzz {

/// A stream by its fields; nothing is checked.
struct RawStream {
  std::uint16_t flags = 0;
  std::uint8_t fill = 0, element = 0, slab_axis = 2, up = 0;
  double voxel = 0.25;
  std::array<std::int64_t, 3> origin{};
  std::array<double, 6> bounds{0, 0, 0, 2, 2, 2};
  std::array<std::int32_t, 6> box{0, 0, 0, 2, 2, 2};
  std::string scale, provenance = "[]", orientation;
  std::vector<bp::Brick> bricks;  ///< written in this order
};

[[nodiscard]] std::string bytes_of(const RawStream& stream);

/// A small stream: mostly sound, with a few fields at their limits or beyond, bricks anywhere in the box, layers that
/// do not nest.
[[nodiscard]] RawStream hostile_stream(Choices& choices);

/// The bytes of an orientation: a small sound one, with a few numbers at their limits.
[[nodiscard]] std::string hostile_orientation(Choices& choices);

/// Rules of all shapes as JSON, for bpscale; lengths as below, or texts with units.
[[nodiscard]] std::string hostile_rules(Choices& choices, double voxel);

/// A scale field as JSON, for streams and for bpclose --field; lengths are about as large as `voxel`, or hostile.
[[nodiscard]] std::string hostile_field(Choices& choices, double voxel);

}  // namespace fuzz
