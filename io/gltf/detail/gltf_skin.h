#pragma once
#include <optional>
#include <vector>

#include "io/gltf/gltf_document.h"
#include "io/scene/affine.h"

/// Joints that move the vertices of a mesh (glTF 2.0, section 3.7.3).
namespace bp {

class GltfSkin {
 public:
  /// `skin`: an item of the document's "skins". `places`: transforms of the nodes that the scene reaches; joints are
  /// nodes. Throws bad_input if a joint is no node, or is not reached.
  GltfSkin(GltfDocument& doc, const GltfObject& skin, const std::vector<std::optional<Affine>>& places);

  /// Returns where the joints move the vertices of a primitive, in the coordinates of `places`. Each joint has its
  /// share of a vertex: JOINTS_n and WEIGHTS_n, which need not sum to 1. A vertex without weight follows its first
  /// joint. In double. Throws out_of_resource if a primitive takes more than SceneOptions::document.
  [[nodiscard]] Accessor points(const GltfObject& attributes, const Accessor& positions) const;
  /// Returns whether the weights of each vertex have the sum 1, but for the rounding of bytes. Programs disagree on
  /// others: some divide by the sum, some do not.
  [[nodiscard]] bool are_whole(const GltfObject& attributes, std::uint64_t vertices) const;
  /// As points(), for normals of any length.
  [[nodiscard]] Accessor normals(const GltfObject& attributes, const Accessor& normals) const;

 private:
  struct Shares {
    std::vector<double> joints, weights;  ///< four of each for a vertex
  };
  [[nodiscard]] std::vector<Shares> shares_of(const GltfObject& attributes, std::uint64_t vertices) const;
  [[nodiscard]] Shares read_shares(const GltfObject& attributes, const std::string& joints, const std::string& weights,
                                   std::uint64_t vertices) const;
  [[nodiscard]] Affine blend(const std::vector<Shares>& shares, std::uint64_t vertex) const;
  template <class Move>
  [[nodiscard]] Accessor moved(const GltfObject& attributes, const Accessor& vectors, const Move& move) const;

  GltfDocument& doc_;
  std::vector<Affine> joints_;  // each takes a vertex from the bind pose to its place
};

}  // namespace bp
