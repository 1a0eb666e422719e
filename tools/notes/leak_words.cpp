#include "tools/notes/leak_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lib/closing/closing.h"

namespace bp {

Vec3d middle_of(VoxelCoord p, const GridFrame& frame) {
  constexpr std::int64_t kHalf = kLatticePerVoxel / 2;
  return frame.world(LatticeCoord{p.x, p.y, p.z} * kLatticePerVoxel + LatticeCoord{kHalf, kHalf, kHalf});
}

GroundSide ground_of(const GridFrame& frame) {
  const std::string_view name = name_of(frame.up);  // "x" or "-x"
  return {name.back() - 'x', name.front() == '-'};
}

double closing_scale(const Leak& leak, const GridFrame& frame) {
  const double scale = (std::max(leak.trial.scale_vox, leak.clearance) + kBeyondWholeVox) * frame.voxel;
  const double unit = std::pow(10.0, std::floor(std::log10(scale)) - 3);
  return std::ceil(scale / unit) * unit;
}

double filling_scale(const Leak& leak, const GridFrame& frame) {
  return leak.room_clearance * frame.voxel;
}

double room_volume(const Leak& leak, const GridFrame& frame) {
  return double(leak.room_voxels) * std::pow(frame.voxel, 3);
}

std::string place_text(const Vec3d& p, const GridFrame& frame) {
  const int digits = std::clamp(int(std::ceil(1 - std::log10(frame.voxel))), 0, 17);
  return fmt::format("{:.{}f},{:.{}f},{:.{}f}", p[0] + 0.0, digits, p[1] + 0.0, digits, p[2] + 0.0, digits);
}

std::string leak_sentence(const Leak& leak, const GridFrame& frame) {
  return fmt::format("the largest room ({:.3g}) leaks at {}, where it is {:.3g} wide; {}", room_volume(leak, frame),
                     place_text(middle_of(leak.place, frame), frame), leak.width * frame.voxel,
                     scale_text(leak, frame));
}

std::string scale_text(const Leak& leak, const GridFrame& frame) {
  const double scale = closing_scale(leak, frame);
  const auto or_more = [&](const std::string& why) {
    return fmt::format("it needs --scale {:.4g} or more; {}", scale, why);
  };
  switch (leak.trial.answer) {
    case ShutTrial::Answer::shut:
      return fmt::format("--scale {:.4g} shuts it, as tried there", scale);
    case ShutTrial::Answer::open:
      return or_more("none was found that shuts it");
    case ShutTrial::Answer::filled:
      return or_more(
          fmt::format("none was found that shuts it below {:.4g}, which fills the room", filling_scale(leak, frame)));
    default:
      return or_more("it is too long or too wide to try one");
  }
}

std::string parts_text(const char* where, const std::set<std::string>& names) {
  if (names.empty()) return "";
  std::string name = *names.begin();
  std::replace_if(
      name.begin(), name.end(), [](char c) { return std::uint8_t(c) < ' ' || c == 0x7f; }, '?');
  const std::size_t others = names.size() - 1;
  return fmt::format(" {} '{}'{}", where, name,
                     others == 0 ? "" : fmt::format(" and {} other part{}", others, others == 1 ? "" : "s"));
}

}  // namespace bp
