#include <assimp/metadata.h>
#include <assimp/scene.h>

#include <algorithm>
#include <array>
#include <string>

#include "io/scene/detail/exact/exact_scene.h"

// FBX. Assimp reads meshes, and knows no InheritType of a model: every model stands where the matrices of those above
// it place it. Surfaces of other kinds are dropped without a word.

namespace bp {

namespace {

/// Kinds of geometry, and of models in old files, whose surfaces Assimp drops.
constexpr std::array<std::string_view, 6> kDropped{"NurbsSurface", "TrimNurbsSurface", "Nurbs", "Nurb",
                                                   "Patch",        "Boundary"};

/// Returns whether the word is a text of the file: between quotes, or with its length before it in a binary file.
bool holds_text(std::string_view bytes, std::string_view word) {
  const std::string quoted = "\"" + std::string(word) + "\"";
  const std::string counted = std::string("S") + char(word.size()) + std::string(3, '\0') + std::string(word);
  return bytes.find(quoted) != bytes.npos || bytes.find(counted) != bytes.npos;
}

bool turns_or_scales(const aiMatrix4x4& m) {
  return m.a1 != 1 || m.a2 != 0 || m.a3 != 0 || m.b1 != 0 || m.b2 != 1 || m.b3 != 0 || m.c1 != 0 || m.c2 != 0 ||
         m.c3 != 1;
}

/// Returns whether a node is the last of those that Assimp makes of one model: it has the properties of the model.
bool ends_model(const aiNode& node) {
  return node.mMetaData != nullptr && node.mMetaData->HasKey("IsNull");
}

bool inherits_matrices(const aiNode& node) {
  constexpr int kRSrs = 1;
  int type = 0;
  return node.mMetaData->Get("InheritType", type) && type == kRSrs;
}

}  // namespace

ExactScene exact_fbx(std::string_view bytes) {
  ExactScene scene;
  scene.unfollowed.missing = std::uint64_t(
      std::count_if(kDropped.begin(), kDropped.end(), [&](std::string_view word) { return holds_text(bytes, word); }));
  return scene;
}

std::uint64_t models_that_inherit(const aiNode& root) {
  struct Pending {
    const aiNode* node;
    bool above, own;  // whether models above, or nodes before this one of the same model, turn or scale
  };
  std::uint64_t doubtful = 0;
  std::vector<Pending> stack{{&root, false, false}};
  while (!stack.empty()) {
    Pending next = stack.back();
    stack.pop_back();
    next.own = next.own || turns_or_scales(next.node->mTransformation);
    if (ends_model(*next.node)) {
      doubtful += next.above && !inherits_matrices(*next.node) ? 1 : 0;
      next.above = next.above || next.own;
      next.own = false;
    }
    for (unsigned k = 0; k < next.node->mNumChildren; ++k)
      stack.push_back({next.node->mChildren[k], next.above, next.own});
  }
  return doubtful;
}

}  // namespace bp
