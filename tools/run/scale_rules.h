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

/// Reads rules for the scene and the grid of `header`. `scene`: how to read the scene again, for rules by name.
/// `may_orient`: as in RuleContext. Throws bad_input with the wrong key, bad_argument if a scale is out of range.
[[nodiscard]] ScalePlan read_rules(const RulesText& rules, const StreamHeader& header, const SceneOptions& scene,
                                   bool may_orient = false);
/// Does the same for the rules of a file.
[[nodiscard]] inline ScalePlan read_rules(const std::string& file, const StreamHeader& header,
                                          const SceneOptions& scene, bool may_orient = false) {
  return read_rules(read_rules_text(file), header, scene, may_orient);
}

/// A stream with a file of rules. The stream is shelved, and read on from the shelf, if a rule must be measured on its
/// voxels.
class RuledSource final : public BrickSource {
 public:
  /// `context`: for measuring. The scene is read again within `memory`, the tool's limit, while nothing else is at
  /// work.
  RuledSource(BrickSource& source, const PassContext& context, std::uint64_t memory, const std::string& temp);
  /// Reads the rules, and measures all rules by shape. Throws bad_input also if the stream is the input of an opening.
  [[nodiscard]] ScalePlan read_rules(const RulesText& rules, bool may_orient = false);
  /// How the scene is read again within `memory`.
  [[nodiscard]] const SceneOptions& scene_options() const { return scene_; }

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

/// Returns rules for the provenance: their JSON, or, if it is long, `what` and a hash.
[[nodiscard]] std::string provenance_text(const std::string& json, const std::string& what);
[[nodiscard]] std::string provenance_text(const ScalePlan& plan);

}  // namespace bp
