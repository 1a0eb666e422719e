#pragma once
#include <cstdint>
#include <string>

namespace bp::detail {

/// What the JSON of a glTF becomes, counted in one pass over its text: nothing of it need fit in memory for that.
struct GltfSketch {
  std::uint64_t text_bytes = 0, parsed_bytes = 0;
  std::uint64_t places = 0;        ///< the primitives of the meshes of all nodes
  std::uint64_t copied_bytes = 0;  ///< of a GltfCopy in which each place has a mesh and accessors of its own, at most
  std::uint64_t target_bytes = 0;  ///< of a morph target for each place in a GltfCopy, at most
};

/// `text`: LeanJson::text. Memory: some words for each mesh. Text that is no JSON is counted up to its fault.
[[nodiscard]] GltfSketch sketch_of(std::string text);

}  // namespace bp::detail
