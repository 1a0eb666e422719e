#include "tools/run/scale_rules.h"

#include <fmt/format.h>

#include <span>

#include "io/files/file.h"
#include "lib/store/content_hash.h"
#include "lib/store/hex.h"
#include "tools/run/part_boxes.h"

namespace bp {

ScaleField read_rules(const std::string& file, const StreamHeader& header,
                      const decltype(RuleContext::measure)& measure,
                      const decltype(RuleContext::orientation)& orientation) {
  RuleContext context;
  context.orientation = orientation;
  context.measure = measure;
  context.diagonal = header.bounds.empty() ? 0 : header.bounds.diagonal();
  context.voxel = header.frame.voxel;
  context.parts = [&](const std::string& pattern) { return part_boxes(header.scene, header.bounds, pattern); };
  return parse_scale_field(read_text(file), file, context);
}

std::string provenance_text(const ScaleField& field) {
  return provenance_text(to_json(field), fmt::format("{} rules", field.rules.size()));
}

std::string provenance_text(const std::string& json, const std::string& what) {
  constexpr std::size_t kLong = 1000;
  if (json.size() <= kLong) return json;
  ContentHash hash;
  hash.add(std::as_bytes(std::span(json)));
  const auto [high, low] = hash.value().words;
  return fmt::format("{}, hash {}", what, hex_of(high, low));
}

}  // namespace bp
