#include "tools/view/geometry/wire.h"

#include <span>

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

}  // namespace

std::string surface_bytes(const std::vector<LiveClosing::Piece>& pieces, std::uint64_t generation) {
  std::string out;
  append(out, std::uint32_t(generation));
  append(out, std::uint32_t(pieces.size()));
  for (const LiveClosing::Piece& piece : pieces) {
    const SurfacePiece& s = *piece.surface;
    for (int axis = 0; axis < 3; ++axis) append(out, s.brick[axis]);
    append(out, std::uint32_t(s.vertices.size()));
    append(out, std::uint32_t(s.triangles.size()));
    append(out, std::span(s.vertices));
    append(out, std::span(s.triangles));
  }
  return out;
}

}  // namespace bp
