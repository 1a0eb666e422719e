#pragma once
#include <array>
#include <vector>

#include "lib/core/color.h"
#include "lib/core/coords.h"

/// Mean colours of a surface in each cell of a grid, for each direction that the surface looks to. Means are weighted
/// by area and kept as sums of integers, so that neither the order of triangles nor threads change them.
namespace bp {

constexpr int kColorCellVox = 4;  ///< voxels along a side of a cell: about half an edge of a level's triangles

using ColorCell = Coord3<struct ColorCellSpace, std::int32_t>;  ///< voxels [4 c, 4 c + 4) of its level

/// Directions that a surface may look to: along an axis, between two axes, between three. Each stands for both ways.
constexpr std::array<std::array<int, 3>, 13> kColorSides{{{1, 0, 0},
                                                          {0, 1, 0},
                                                          {0, 0, 1},
                                                          {1, 1, 0},
                                                          {1, -1, 0},
                                                          {0, 1, 1},
                                                          {0, 1, -1},
                                                          {1, 0, 1},
                                                          {-1, 0, 1},
                                                          {1, 1, 1},
                                                          {-1, 1, 1},
                                                          {1, -1, 1},
                                                          {1, 1, -1}}};
constexpr std::uint16_t kColorAxes = 3;  ///< the first of kColorSides
/// Returns the entry of kColorSides that is nearest to a normal of any length; 0 if the normal is zero. Both sides of a
/// thin wall look to the same entry, because broken scenes have inverted triangles.
[[nodiscard]] std::uint16_t color_side_of(const Vec3d& normal);

struct ColorSum {
  std::uint64_t weight = 0;           ///< area; 2^20 is that of a side of a cell
  std::uint64_t r = 0, g = 0, b = 0;  ///< linear light times weight
  void add(const ColorSum& s) { weight += s.weight, r += s.r, g += s.g, b += s.b; }
  [[nodiscard]] LinearColor mean() const {
    const std::uint64_t half = weight / 2;
    return {std::uint16_t((r + half) / weight), std::uint16_t((g + half) / weight), std::uint16_t((b + half) / weight)};
  }
  friend bool operator==(const ColorSum&, const ColorSum&) = default;
};

struct ColorCellSum {
  ColorCell cell;
  std::uint16_t side = 0;   ///< index in kColorSides
  std::uint16_t layer = 0;  ///< layer of the cell's voxels along an axis, if `side` is below kColorAxes
  ColorSum sum;
};

/// The colour in a cell of the surfaces that look to one side.
struct CellColor {
  ColorCell cell;
  LinearColor color;
  std::uint16_t side = 0;    ///< index in kColorSides
  std::uint32_t weight = 0;  ///< area as in ColorSum, clamped to 32 bits
  friend bool operator==(const CellColor&, const CellColor&) = default;
};

/// Appends what a triangle, given in voxels, adds to the cells that it crosses; a cell may come several times. Samples
/// lie half a cell apart: a cell in which it has less may be passed over. 64 bits hold 2^28 samples of white in a cell.
void add_colors(const TriangleD& triangle_vox, const TriangleColors& colors, std::vector<ColorCellSum>& out);

}  // namespace bp
