#include "io/gltf/detail/gltf_instances.h"

namespace bp {

InstanceArray gltf_instances(GltfDocument& doc, const GltfObject& node) {
  const GltfObject attributes = node.object("extensions").object(kInstancing).object("attributes");
  if (attributes.json().empty()) attributes.unfit("are none, so programs disagree on the number of instances");
  const auto count_of = [&](const std::string& name) {
    return doc.root().item("accessors", attributes.number(name.c_str())).number("count");
  };
  InstanceArray array;
  array.count = count_of(attributes.json().begin().key());
  for (const auto& [name, accessor] : attributes.json().items()) {
    if (count_of(name) != array.count) attributes.broken("have different counts");
  }
  const auto take = [&](const char* name, std::size_t components, Accessor& a) {
    if (attributes.has(name)) a = doc.accessor(attributes.number(name), components);
  };
  take("TRANSLATION", 3, array.translation);
  take("ROTATION", 4, array.rotation);
  take("SCALE", 3, array.scale);
  return array;
}

}  // namespace bp
