#include "tools/run/scale_rules.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "io/files/file.h"
#include "lib/core/error.h"
#include "lib/store/content_hash.h"
#include "lib/store/hex.h"
#include "tools/run/memory_shares.h"
#include "tools/run/part_boxes.h"
#include "tools/run/scene_budget.h"

namespace bp {

RulesText read_rules_text(const std::string& file) {
  return {read_text(file), file};
}

ScalePlan read_rules(const RulesText& rules, const StreamHeader& header, const SceneOptions& scene, bool may_orient) {
  RuleContext context;
  context.may_orient = may_orient;
  context.diagonal = header.bounds.empty() ? 0 : header.bounds.diagonal();
  context.voxel = header.frame.voxel;
  context.parts = [&](const std::string& pattern) { return part_boxes(header.scene, header.bounds, pattern, scene); };
  ScalePlan plan = parse_scale_rules(rules.json, rules.name, context);
  (void)plan.field.upper_bound(header.frame);  // refuses what is out of range
  return plan;
}

RuledSource::RuledSource(BrickSource& source, const PassContext& context, std::uint64_t memory, const std::string& temp)
    : source_(source), measure_{0, context} {
  scene_.memory_bytes = MemoryLimit{memory, kVoxelProgram}.rest_bytes() / 2;
  scene_.temp_dir = temp;
  scene_.document = document_budget(memory, kVoxelProgram, 2);
}

ScalePlan RuledSource::read_rules(const RulesText& rules, bool may_orient) {
  ScalePlan plan = bp::read_rules(rules, header(), scene_, may_orient);
  const auto by_shape = [](const RuleEntry& entry) { return entry.shape.has_value(); };
  if (std::none_of(plan.entries.begin(), plan.entries.end(), by_shape)) return plan;
  if (header().fill == FillMode::inside)
    fail(ErrorCode::bad_input, "rules by shape are for closings, and a stream of bpvox --fill inside is opened");
  shelve();
  return measured(plan, header(), *shelf_, measure_);
}

void RuledSource::shelve() {
  shelf_ = measure_.context.make_shelf();
  for_bricks(source_, [&](const Brick& brick) {
    if (brick.layer == Layer::solid) shelf_->put(brick.coord, brick.fill, brick.bits);
  });
  shelved_ = std::make_unique<ShelfSource>(header(), *shelf_, nullptr, ShelfSource::Keep::all);
}

bool RuledSource::read(Brick& out) {
  if (!shelved_) return source_.read(out);
  if (!shelved_->read(out)) return false;
  shelf_->drop(out.coord);
  return true;
}

std::string provenance_text(const ScalePlan& plan) {
  return provenance_text(to_json(plan), fmt::format("{} rules", plan.entries.size()));
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
