#include "io/scene/detail/assimp_bones.h"

#include <assimp/mesh.h>
#include <assimp/scene.h>

#include <algorithm>
#include <cmath>
#include <vector>

// A vertex with bones is drawn at the weighted mean of bone * offset * p. In the pose in which a mesh was bound, each
// bone * offset is the place of the mesh's own node. Exporters mostly save that pose. Then the mean lies where the node
// places p, to within the difference of the matrices.

namespace bp {

namespace {

constexpr double kMostMoved = 0x1p-12;  // largest difference, over a matrix's largest number: more is a pose
// Largest deviation of a sum of weights from 1: more is no rounding, and programs differ.
constexpr double kMostMissing = 0x1p-8;

Affine rounded_matrix(const aiMatrix4x4& m) {
  Affine a;
  a.m = {{{m.a1, m.a2, m.a3, m.a4}, {m.b1, m.b2, m.b3, m.b4}, {m.c1, m.c2, m.c3, m.c4}}};
  for (std::size_t i = 0; i < 3; ++i) {
    const double sum = std::abs(a.m[i][0]) + std::abs(a.m[i][1]) + std::abs(a.m[i][2]);
    const double largest = std::max({std::abs(a.m[i][0]), std::abs(a.m[i][1]), std::abs(a.m[i][2])});
    const bool exact = sum == 1 && largest == 1;
    for (std::size_t j = 0; j < 3; ++j) a.off.set(i, j, exact ? 0 : kImporterShare * largest);
    a.off.set(i, 3, kImporterShare * std::abs(a.m[i][3]));
  }
  return a;
}

/// The size of a matrix's 3 x 3 numbers, and that of its translation.
struct Sizes {
  explicit Sizes(const Affine& a) {
    for (const auto& row : a.m) {
      for (std::size_t j = 0; j < 3; ++j) linear = std::max(linear, std::abs(row[j]));
      far = std::max(far, std::abs(row[3]));
    }
  }
  double linear = 0, far = 0;
};

/// Returns by how much the sums of weights miss 1; none if a vertex has no weight.
std::optional<double> missing_weight(const aiMesh& mesh) {
  std::vector<double> sums(mesh.mNumVertices, 0);
  for (unsigned b = 0; b < mesh.mNumBones; ++b) {
    const aiBone& bone = *mesh.mBones[b];
    for (unsigned k = 0; k < bone.mNumWeights; ++k) {
      const aiVertexWeight& w = bone.mWeights[k];
      if (w.mVertexId >= sums.size() || !(w.mWeight >= 0)) return {};
      sums[w.mVertexId] += double(w.mWeight);
    }
  }
  double most = 0;
  for (const double sum : sums) most = std::max(most, std::abs(sum - 1));
  if (!(most <= kMostMissing)) return {};
  return most;
}

}  // namespace

Affine rounded_affine(const aiNode& node) {
  return rounded_matrix(node.mTransformation);
}

void BonePlaces::add(const aiNode& node, const Affine& place) {
  const auto [at, is_new] = places_.try_emplace(node.mName.C_Str(), place);
  if (!is_new) at->second.reset();
}

bool BonePlaces::hold(const aiMesh& mesh, Affine& mesh_place) const {
  const std::optional<double> missing = missing_weight(mesh);
  if (!missing) return false;
  Affine widened = mesh_place;
  const Sizes own(mesh_place);
  for (unsigned b = 0; b < mesh.mNumBones; ++b) {
    const aiBone& bone = *mesh.mBones[b];
    if (bone.mNumWeights == 0) continue;
    const auto found = places_.find(bone.mName.C_Str());
    if (found == places_.end() || !found->second) return false;
    const Affine offset = rounded_matrix(bone.mOffsetMatrix);
    const Affine moved = *found->second * offset;
    const Sizes joint(*found->second), back(offset);
    // The importer's product may have cancelled: these are bounds on its terms.
    const double cancelled = kImporterShare * (joint.far + own.far + 3 * joint.linear * back.far);
    const double far = joint.far + own.far + 3 * joint.linear * back.far;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 4; ++j) {
        const double apart = std::abs(moved.m[i][j] - mesh_place.m[i][j]) + moved.off(i, j) + (j == 3 ? cancelled : 0);
        if (!(apart <= kMostMoved * (j == 3 ? std::max(far, own.linear) : own.linear))) return false;
        widened.off.set(i, j, std::max(widened.off(i, j), mesh_place.off(i, j) + apart));
      }
    }
  }
  widened.blur(*missing);
  mesh_place = widened;
  return true;
}

bool is_morphed(const aiMesh& mesh) {
  for (unsigned k = 0; k < mesh.mNumAnimMeshes; ++k) {
    const aiAnimMesh& target = *mesh.mAnimMeshes[k];
    if (target.mVertices == nullptr || target.mWeight == 0) continue;
    if (target.mNumVertices != mesh.mNumVertices ||
        !std::equal(target.mVertices, target.mVertices + target.mNumVertices, mesh.mVertices))
      return true;
  }
  return false;
}

}  // namespace bp
