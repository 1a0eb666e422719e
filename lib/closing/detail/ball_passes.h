#pragma once
#include <cstddef>
#include <cstdint>

/// The inner loops of ball_transform.cpp, one axis each. They work on 64 voxels at once, with 16 or 32 bits a value.
namespace bp::detail {

constexpr std::int32_t kBlockRows = 64;  ///< rows that are handled together, at most

/// need[z][y] = max over slices z' of need[z'][y] - |z - z'|, not below 0.
void spread(std::uint16_t* need, std::int32_t slices);

/// x pass: `squares[i]` = i^2, saturated. row = min(0, (x - s)^2 - bound) for the seeds s in `middle`, and for the
/// seeds to its left and right, unless they are `none`.
void nearest(std::uint64_t middle, std::int32_t left, std::int32_t right, std::int32_t none, std::int16_t bound,
             const std::int16_t* squares, std::int16_t* row);
void nearest(std::uint64_t middle, std::int32_t left, std::int32_t right, std::int32_t none, std::int32_t bound,
             const std::int32_t* squares, std::int32_t* row);
/// x pass: row = min(row, squares + c) for one seed of a row of seeds that differ in w.
void lower(const std::int16_t* squares, std::int16_t c, std::int16_t* row);
void lower(const std::int32_t* squares, std::int32_t c, std::int32_t* row);

/// The y pass of one slice. For each row y0 + i with need[i] != 0 it writes 64 values to out + i * step; other rows are
/// skipped.
struct RowPass {
  const std::int32_t* row_y;  ///< of the rows that hold seeds, ascending
  std::int32_t count, y0, radius;
  const std::uint16_t* need;
  std::size_t step;
};
/// If the output differs in type, the values are how far seeds reach along z; else the minima themselves.
void y_pass(const std::int16_t* rows, const RowPass& p, std::int16_t top, std::uint8_t* out);
void y_pass(const std::int32_t* rows, const RowPass& p, std::int32_t top, std::uint16_t* out);
void y_pass(const std::int16_t* rows, const RowPass& p, std::int16_t top, std::int16_t* out);
void y_pass(const std::int32_t* rows, const RowPass& p, std::int32_t top, std::int32_t* out);

/// One row (column, y) along z: the values and needs of its slices, and the place of its targets among them.
template <class T>
struct Line {
  T* values;  ///< 64 per slice
  const std::uint16_t* need;
  std::int32_t slices;
  std::uint64_t* target;  ///< word of the first slice that has a target
  std::size_t target_step;
  std::int32_t first_target, target_count;
};
/// z pass: carries the slices to go up and then down. A target is reached if some are left.
void z_sweep(const Line<std::uint8_t>& line);
void z_sweep(const Line<std::uint16_t>& line);
/// z pass: returns bits of the 64 targets at slice z. A bit is set if the minimum over the slices within `reach` is
/// below `limit`.
[[nodiscard]] std::uint64_t z_minimum(const std::int16_t* values, const std::uint8_t* present, std::int32_t z,
                                      std::int32_t slices, std::int32_t reach, const std::int16_t* limit);
[[nodiscard]] std::uint64_t z_minimum(const std::int32_t* values, const std::uint8_t* present, std::int32_t z,
                                      std::int32_t slices, std::int32_t reach, const std::int32_t* limit);

}  // namespace bp::detail
