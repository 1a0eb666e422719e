#include "tools/view/geometry/wire.h"

#include <algorithm>
#include <mutex>
#include <span>

#include "lib/core/parallel.h"

namespace bp {

namespace {

template <class T>
void append(std::string& out, std::span<const T> values) {
  out.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
}
template <class T>
void append(std::string& out, const T& value) {
  append(out, std::span<const T>(&value, 1));
}

std::string bytes_of(const SurfacePiece& piece) {
  std::string out;
  for (int axis = 0; axis < 3; ++axis) append(out, piece.brick[axis]);
  append(out, std::uint32_t(piece.vertices.size()));
  append(out, std::uint32_t(piece.faces.size()));
  append(out, std::span(piece.vertices));
  if (piece.vertices.size() > UINT16_MAX) {  // whose index would begin a strip anew
    append(out, std::span(piece.faces));
  } else {
    for (const auto& face : piece.faces) {
      for (const std::uint32_t corner : face) append(out, std::uint16_t(corner));
    }
  }
  return out;
}

std::string head_of(const LiveSurface::Change& change) {
  std::string out;
  append(out, std::uint32_t(change.generation));
  append(out, std::uint32_t(change.whole));
  append(out, std::uint32_t(change.bricks.size()));
  append(out, std::uint32_t(0));
  append(out, change.frame.voxel);
  append(out, change.frame.world_origin());
  return out;
}

}  // namespace

std::string SurfaceParts::next() {
  std::string out = begun_ ? "" : head_of(change_);
  begun_ = true;
  const std::size_t count = std::min(change_.bricks.size() - sent_, std::size_t(2 * thread_count()));
  std::vector<std::string> made(count);
  static std::mutex one;  // pieces take memory while they are made, so one part is made at a time
  const std::lock_guard lock(one);
  isolated([&] {
    parallel_for(std::int64_t(count), [&](std::int64_t i) {
      made[std::size_t(i)] = bytes_of(change_.piece(change_.bricks[sent_ + std::size_t(i)]));
    });
  });
  for (const std::string& piece : made) out += piece;
  sent_ += count;
  return out;
}

}  // namespace bp
