#pragma once
#include "tools/lod/scene/lod_scene.h"

/// Makes levels complete: with colours, textures and provenance in addition to their shape.
namespace bp {

/// The inputs that complete levels. Keeps references.
struct Completion {
  const LodScene& scene;
  CageRoom room{};                    ///< only for a cage
  const SceneLooks* looks = nullptr;  ///< the looks that textures are baked from; null: levels get no texture now
  std::string input_hash;             ///< hash of the scene, for the provenance; empty: none
};

/// Makes the levels of a range, each as a stage of the report, and completes them.
[[nodiscard]] CompleteLevels make_levels(Build& build, LodChain& chain, const ChainRange& range,
                                         const Completion& completion);

/// Reads the looks of the scene and keeps them, for leaves and for levels that get their textures as soon as they are
/// made. Null if neither is needed. kBesideLooks of the memory for work is left for the levels.
[[nodiscard]] std::unique_ptr<SceneLooks> hold_looks(Build& build, const LodScene& scene);
/// Returns the memory for each image that is baked while the looks are kept.
[[nodiscard]] MemoryShare texture_memory(const Build& build);

/// All levels of a scene, each as one mesh.
struct MadeChain {
  LodScene scene;  ///< the scene without its voxels
  CageRoom room;
  SceneParts parts;  ///< the scene's parts
  CompleteLevels made;
};
[[nodiscard]] MadeChain make_chain(Build& build);
/// Tells the notes on the levels.
void note_chain(Build& build, const MadeChain& chain);

}  // namespace bp
