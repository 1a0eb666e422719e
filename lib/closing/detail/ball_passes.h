#pragma once
#include <cstddef>
#include <cstdint>

/// The inner loops of ball_transform.cpp: one axis each, 64 voxels at once, with 16 or 32 bits a value.
namespace bp::detail {

constexpr std::int32_t kBlockRows = 64;  ///< rows handled together, at most

/// need[z][y] = max over slices z' of need[z'][y] - |z - z'|, not below 0.
void spread(std::uint16_t* need, std::int32_t slices);

/// x: `squares[i]` = i^2, saturated; row = min(0, (x - s)^2 - bound) for the seeds s in `middle`, and to its left and
/// right, unless `none`.
void nearest(std::uint64_t middle, std::int32_t left, std::int32_t right, std::int32_t none, std::int16_t bound,
             const std::int16_t* squares, std::int16_t* row);
void nearest(std::uint64_t middle, std::int32_t left, std::int32_t right, std::int32_t none, std::int32_t bound,
             const std::int32_t* squares, std::int32_t* row);
/// x: row = min(row, squares + c): one seed of a row of seeds that differ in w.
void lower(const std::int16_t* squares, std::int16_t c, std::int16_t* row);
void lower(const std::int32_t* squares, std::int32_t c, std::int32_t* row);

/// The y pass of one slice: rows y0 + i with need[i] != 0 get 64 values at out + i * step.
struct RowPass {
  const std::int32_t* row_y;  ///< of the rows that hold seeds, ascending
  std::int32_t count, y0, radius;
  const std::uint16_t* need;
  std::size_t step;
};
/// Values are how far they reach along z if those put out differ in type, else the minima themselves.
void y_pass(const std::int16_t* rows, const RowPass& p, std::int16_t top, std::uint8_t* out);
void y_pass(const std::int32_t* rows, const RowPass& p, std::int32_t top, std::uint16_t* out);
void y_pass(const std::int16_t* rows, const RowPass& p, std::int16_t top, std::int16_t* out);
void y_pass(const std::int32_t* rows, const RowPass& p, std::int32_t top, std::int32_t* out);

/// One row (column, y) along z: the values and needs of its slices, and where its targets lie among them.
template <class T>
struct Line {
  T* values;  ///< 64 per slice
  const std::uint16_t* need;
  std::int32_t slices;
  std::uint64_t* target;  ///< word of the first slice that has one
  std::size_t target_step;
  std::int32_t first_target, target_count;
};
/// z: slices to go, carried up and then down; a target with some left is reached.
void z_sweep(const Line<std::uint8_t>& line);
void z_sweep(const Line<std::uint16_t>& line);
/// z: bits of the 64 targets at slice z whose minimum over the slices within `reach` is below their own `limit`.
[[nodiscard]] std::uint64_t z_minimum(const std::int16_t* values, const std::uint8_t* present, std::int32_t z,
                                      std::int32_t slices, std::int32_t reach, const std::int16_t* limit);
[[nodiscard]] std::uint64_t z_minimum(const std::int32_t* values, const std::uint8_t* present, std::int32_t z,
                                      std::int32_t slices, std::int32_t reach, const std::int32_t* limit);

}  // namespace bp::detail
