#pragma once
#include <memory>
#include <string>

#include "io/scene/scene_reader.h"
#include "lib/grid/shelf_stream.h"
#include "lib/pass/measure/shape_rules.h"

namespace bp {

/// A text of rules (docs/bpscale.1.md), and its name for messages.
struct RulesText {
  std::string json, name;
};
[[nodiscard]] RulesText read_rules_text(const std::string& file);

/// Reads rules for the scene and the grid of `header`. `scene`: how that is read again, for rules by name.
/// `may_orient`: as RuleContext. Throws bad_input with the key at fault, bad_argument if a scale is out of range.
[[nodiscard]] ScalePlan read_rules(const RulesText& rules, const StreamHeader& header, const SceneOptions& scene,
                                   bool may_orient = false);
/// Does the same for the rules of a file.
[[nodiscard]] inline ScalePlan read_rules(const std::string& file, const StreamHeader& header,
                                          const SceneOptions& scene, bool may_orient = false) {
  return read_rules(read_rules_text(file), header, scene, may_orient);
}

/// A stream and its rules. It is shelved, and read on from the shelf, if a rule is to be measured on its voxels.
class RuledSource final : public BrickSource {
 public:
  /// `context` of measuring. The scene is read again within `memory`, that of the tool, while nothing else is at work.
  RuledSource(BrickSource& source, const PassContext& context, std::uint64_t memory, const std::string& temp);
  /// All rules by shape are measured. Throws bad_input also if the stream is one to be opened.
  [[nodiscard]] ScalePlan read_rules(const RulesText& rules, bool may_orient = false);

  [[nodiscard]] const StreamHeader& header() const override { return source_.header(); }
  bool read(Brick& out) override;

 private:
  void shelve();
  BrickSource& source_;
  MeasureOptions measure_;
  SceneOptions scene_;
  std::unique_ptr<BrickShelf> shelf_;
  std::unique_ptr<ShelfSource> shelved_;  // bricks leave it as they are read
};

/// Rules for the provenance: their JSON, or, where it is long, what it is and its hash.
[[nodiscard]] std::string provenance_text(const std::string& json, const std::string& what);
[[nodiscard]] std::string provenance_text(const ScalePlan& plan);

}  // namespace bp
