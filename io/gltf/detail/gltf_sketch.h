#pragma once
#include <cstdint>
#include <string>

namespace bp::detail {

/// Sizes of the document that a JSON text of a glTF becomes, counted in one pass over the text. Nothing of it need fit
/// in memory for that.
struct GltfSketch {
  std::uint64_t text_bytes = 0, parsed_bytes = 0;
  std::uint64_t places = 0;        ///< places: primitives of the meshes of all nodes
  std::uint64_t copied_bytes = 0;  ///< most bytes of a GltfCopy in which each place has a mesh and accessors of its own
  std::uint64_t target_bytes = 0;  ///< most bytes of a morph target for each place in a GltfCopy
};

/// Counts a text. `text`: LeanJson::text. Memory: some words for each mesh. Text that is no JSON is counted up to its
/// fault.
[[nodiscard]] GltfSketch sketch_of(std::string text);

}  // namespace bp::detail
