// X + r is the dilation of X by a cube of reach r, and S is the solid. Then the middles of free cubes are F(r) = not (S
// + r), and the places that free cubes hold are F(r) + r. To answer for a tile T, level k needs
//   the middles on T + rk, so places of the level on T + 2 rk:
//     F(rk) on T + 3 rk              and S on T + 4 rk
//     F(r(k-1)) on T + 2 rk + r(k-1) and S on T + 2 rk + 2 r(k-1)
// so a box that holds T + 4 r(k-1) suffices for level k.
#include "lib/volume/openings.h"

#include <algorithm>

#include "lib/volume/dilate.h"

namespace bp {

namespace {

template <class Combine>
void combine(BitBox& to, const BitBox& from, const Combine& op) {
  for (std::int64_t i = 0; i < to.word_count(); ++i) to.data()[i] = op(to.data()[i], from.data()[i]);
}
void keep_common(BitBox& to, const BitBox& with) {
  combine(to, with, [](std::uint64_t a, std::uint64_t b) { return a & b; });
}
void take_away(BitBox& from, const BitBox& gone) {
  combine(from, gone, [](std::uint64_t a, std::uint64_t b) { return a & ~b; });
}
void invert(BitBox& bits) {
  for (std::int64_t i = 0; i < bits.word_count(); ++i) bits.data()[i] = ~bits.data()[i];
}

BitBox dilated(const BitBox& bits, std::int32_t reach) {
  BitBox out = bits;
  dilate(out, reach);
  return out;
}

/// Returns the middles of free cubes.
BitBox free_middles(const BitBox& solid, std::int32_t reach) {
  BitBox out = dilated(solid, reach);
  invert(out);
  return out;
}

BitBox cut(const BitBox& bits, const VoxelBox& box) {
  BitBox out(box);
  copy_voxels(bits, out);
  return out;
}

bool is_empty(const BitBox& bits) {
  return std::all_of(bits.data(), bits.data() + bits.word_count(), [](std::uint64_t word) { return word == 0; });
}

}  // namespace

BitBox thin_parts(const BitBox& solid, std::int32_t h) {
  BitBox thick = solid;  // middles of solid cubes
  invert(thick);
  dilate(thick, h);
  invert(thick);
  dilate(thick, 3 * h);
  BitBox thin = solid;
  take_away(thin, thick);
  return thin;
}

BitBox narrow_places(const BitBox& solid, std::int32_t r) {
  BitBox narrow = free_middles(solid, r);
  dilate(narrow, r);
  invert(narrow);
  take_away(narrow, solid);
  return narrow;
}

void openings(const BitBox& solid, const BitBox* near, const std::vector<std::int32_t>& reaches, const VoxelBox& tile,
              const std::function<void(std::size_t, const BitBox&)>& found) {
  BitBox wider = dilated(free_middles(solid, reaches[0]), reaches[0]);
  for (std::size_t k = 1; k < reaches.size(); ++k) {
    const std::int32_t above = reaches[k - 1], reach = reaches[k];
    const BitBox here = cut(solid, intersect(tile.grown(4 * above + 1), solid.box()));
    wider = cut(wider, here.box());
    const BitBox free = free_middles(here, reach);
    const BitBox held = dilated(free, reach);
    BitBox places = held;
    take_away(places, wider);
    wider = held;
    if (is_empty(places)) continue;
    BitBox middles = dilated(places, reach);
    keep_common(middles, free);
    if (near != nullptr) {
      keep_common(middles, dilated(cut(*near, here.box()), above + 1));
      keep_common(places, dilated(middles, reach));
    }
    combine(middles, places, [](std::uint64_t a, std::uint64_t b) { return a | b; });
    if (!is_empty(cut(middles, intersect(tile, here.box())))) found(k, middles);
  }
}

}  // namespace bp
