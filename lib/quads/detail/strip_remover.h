#pragma once
#include <optional>
#include <utility>
#include <vector>

#include "lib/quads/cell_quads.h"
#include "lib/quads/detail/enclosed_by_pairs.h"
#include "lib/quads/detail/strips.h"
#include "lib/tighten/proxy_editor.h"

namespace bp {

/// Removes strips from a cage whose pairs of triangles are 2 i and 2 i + 1, as QuadMesher numbers them. Each step keeps
/// the enclosed set inside.
class StripRemover {
 public:
  /// Keeps references. With a plane, each step removes a strip's mirror image, too.
  StripRemover(const CellQuads& cage, const Enclosed& enclosed, const std::optional<MirrorPlane>& plane);

  [[nodiscard]] const HalfEdgeMesh& mesh() const { return mesh_; }
  /// Returns the corners of all quads of the cage, with those that are gone.
  [[nodiscard]] const std::vector<Quad>& quads() const { return quads_; }
  [[nodiscard]] bool is_alive(std::uint32_t quad) const { return alive_[quad] != 0; }
  [[nodiscard]] std::size_t left() const { return left_; }  ///< quads that are left
  void refresh() { editor_->refresh(); }

  /// Returns the quads of a strip, with those of its mirror image, each once.
  [[nodiscard]] std::vector<std::uint32_t> quads_of(const Strip& strip) const;
  /// Removes a strip whose quads_of() are `gone`, or leaves everything as it was.
  bool remove(const Strip& strip, const std::vector<std::uint32_t>& gone);
  /// Returns the vertices that the last remove() merged: which one, and into which.
  [[nodiscard]] const std::vector<std::array<VertexId, 2>>& merged() const { return into_; }
  /// Returns the cage with the quads that are left.
  [[nodiscard]] CellQuads result() const;

 private:
  [[nodiscard]] std::uint32_t image(std::uint32_t quad) const;
  bool merge_all(const Strip& strip);
  bool turn(std::uint32_t quad, VertexId corner);
  bool rename(const std::vector<std::uint32_t>& gone);
  bool merge_rung(const std::array<VertexId, 2>& rung);
  bool merge(VertexId a, VertexId d, bool in_plane);
  bool merge_at(VertexId a, VertexId d, const LatticeCoord& to);

  const CellQuads& cage_;
  const std::optional<MirrorPlane>& plane_;
  std::vector<Quad> quads_;
  std::vector<char> alive_;
  std::size_t left_;
  HalfEdgeMesh mesh_;
  EnclosedByPairs kept_;
  std::optional<ProxyEditor> editor_;
  // These belong to the strip that is being removed.
  std::vector<std::array<VertexId, 2>> into_;            // what merged into what
  std::vector<char> is_target_;                          // by vertex: another one was merged into it
  std::vector<std::pair<std::uint32_t, Quad>> renamed_;  // quads as they were
};

}  // namespace bp
