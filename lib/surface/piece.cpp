#include "lib/surface/piece.h"

#include <unordered_map>

#include "lib/core/error.h"
#include "lib/grid/coord_hash.h"

namespace bp {

namespace {

class Welder {
 public:
  void reserve(std::size_t vertices, std::size_t triangles, bool quadrics) {
    out_.vertices.reserve(vertices);
    out_.triangles.reserve(triangles);
    if (quadrics) out_.quadrics.reserve(vertices);
  }

  void add(const Piece& piece) {
    ids_.clear();
    for (std::size_t i = 0; i < piece.vertices.size(); ++i) {
      const LatticeCoord& v = piece.vertices[i];
      const auto fresh = std::uint32_t(out_.vertices.size());
      const std::uint32_t id = piece.cell.holds_inside(v) ? fresh : rim_.try_emplace(v, fresh).first->second;
      ids_.push_back(id);
      if (id == fresh) {
        out_.vertices.push_back(v);
        if (!piece.quadrics.empty()) out_.quadrics.push_back(piece.quadrics[i]);
      } else if (!piece.quadrics.empty()) {
        out_.quadrics[id].add(piece.quadrics[i]);
      }
    }
    for (const auto& t : piece.triangles) out_.triangles.push_back({ids_[t[0]], ids_[t[1]], ids_[t[2]]});
  }

  [[nodiscard]] Piece take() { return std::move(out_); }

 private:
  Piece out_;
  std::unordered_map<LatticeCoord, std::uint32_t, CoordHash> rim_;
  std::vector<std::uint32_t> ids_;  // numbers of the vertices of the piece that was added last
};

}  // namespace

Piece weld(std::span<Piece> pieces) {
  std::size_t vertices = 0, triangles = 0;
  bool quadrics = false;
  for (const Piece& p : pieces) {
    vertices += p.vertices.size();
    triangles += p.triangles.size();
    quadrics |= !p.quadrics.empty();
  }
  if (triangles >= (std::size_t(1) << 32) / 3) {
    fail(ErrorCode::out_of_resource, {Remedy::larger_voxels},
         "the surface has {} triangles, more than one piece can index", triangles);
  }
  Welder welder;
  welder.reserve(vertices, triangles, quadrics);
  for (Piece& p : pieces) {
    welder.add(p);
    p = {};
  }
  return welder.take();
}

}  // namespace bp
