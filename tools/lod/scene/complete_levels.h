#pragma once
#include "tools/lod/scene/lod_scene.h"

/// Levels with all that they carry besides their shape: colours, textures, provenance.
namespace bp {

/// What completes levels. Keeps references.
struct Completion {
  const LodScene& scene;
  CageRoom room{};                    ///< of a cage
  const SceneLooks* looks = nullptr;  ///< what textures are baked from; null: levels get none now
  std::string input_hash;             ///< of the scene, for the provenance; empty: none
};

/// Makes the levels of a range, each as a stage of the report, and completes them.
[[nodiscard]] CompleteLevels make_levels(Build& build, LodChain& chain, const ChainRange& range,
                                         const Completion& completion);

/// The looks of the scene, for levels that get their textures as they are made, and for leaves; null if nothing needs
/// them. kBesideLooks of the memory for work is left beside them.
[[nodiscard]] std::unique_ptr<SceneLooks> hold_looks(Build& build, const LodScene& scene);
/// For each image that is baked beside held looks.
[[nodiscard]] MemoryShare texture_memory(const Build& build);

/// All levels of a scene, in one mesh each.
struct MadeChain {
  LodScene scene;  ///< without its voxels
  CageRoom room;
  SceneParts parts;  ///< of the scene
  CompleteLevels made;
};
[[nodiscard]] MadeChain make_chain(Build& build);

}  // namespace bp
