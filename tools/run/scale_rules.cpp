#include "tools/run/scale_rules.h"

#include <fmt/format.h>

#include <span>

#include "io/files/file.h"
#include "lib/store/content_hash.h"
#include "lib/store/hex.h"
#include "tools/run/part_boxes.h"

namespace bp {

ScaleField read_rules(const std::string& file, const StreamHeader& header,
                      const decltype(RuleContext::measure)& measure) {
  RuleContext context;
  context.measure = measure;
  context.diagonal = header.bounds.empty() ? 0 : header.bounds.diagonal();
  context.voxel = header.frame.voxel;
  context.parts = [&](const std::string& pattern) { return part_boxes(header.scene, header.bounds, pattern); };
  return parse_scale_field(read_text(file), file, context);
}

std::string provenance_text(const ScaleField& field) {
  constexpr std::size_t kLong = 1000;
  std::string text = to_json(field);
  if (text.size() <= kLong) return text;
  ContentHash hash;
  hash.add(std::as_bytes(std::span(text)));
  const auto [high, low] = hash.value().words;
  return fmt::format("{} rules, hash {}", field.rules.size(), hex_of(high, low));
}

}  // namespace bp
