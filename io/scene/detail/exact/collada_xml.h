#pragma once
#include <pugixml.hpp>
#include <string>
#include <string_view>

#include "io/scene/detail/exact/exact_scene.h"

/// The parts that both halves of the COLLADA reader share: meshes (collada.cpp) and nodes (collada_nodes.cpp).
namespace bp {

using ColladaXml = pugi::xml_node;

struct ColladaUnfit {};  // thrown where the document is anything else

/// Returns the text of an element. Programs differ where comments, CDATA and others part it, or stand in its place.
inline std::string_view collada_text(const ColladaXml& node) {
  const ColladaXml text = node.first_child();
  if (text.next_sibling() || (text && text.type() != pugi::node_pcdata)) throw ColladaUnfit();
  return text.value();
}

/// Returns the numbers of an element that holds nothing else.
inline std::vector<double> collada_numbers(const ColladaXml& node) {
  std::optional<std::vector<double>> numbers = only_numbers_in(collada_text(node));
  if (!numbers) throw ColladaUnfit();
  return *std::move(numbers);
}

/// Returns the id that a URI names within this document, "#id"; else "".
inline std::string collada_target(const char* uri) {
  return uri[0] == '#' ? uri + 1 : "";
}

inline std::uint64_t collada_number(const ColladaXml& node, const char* attribute, std::uint64_t otherwise) {
  const pugi::xml_attribute found = node.attribute(attribute);
  return found.empty() ? otherwise : found.as_ullong();
}

inline bool is_element(const ColladaXml& node, std::string_view name) {
  return name == node.name();
}

/// Returns the number of references that programs resolve in different ways: ids that occur twice, and targets that are
/// the name of something else.
[[nodiscard]] std::uint64_t doubtful_ids(const ColladaXml& document);

/// Reads the nodes of the visual scene that the document shows, under one root, and counts their content that no reader
/// follows. A document that cannot be understood gives a root without children, unlike Assimp's.
void read_collada_nodes(const ColladaXml& document, ExactScene& scene);

}  // namespace bp
