#pragma once
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "lib/grid/scale_field.h"

/// A design in progress: a file of rules (docs/bpscale.1.md) that changes step by step, with undo and redo. Each rule
/// stays as it was written, and parse_scale_rules() alone gives it a meaning. So a saved file means what was shown.
namespace bp {

class Design {
 public:
  /// The number of steps that can be undone; earlier steps are forgotten.
  static constexpr std::size_t kMostSteps = 500;
  static constexpr std::size_t kMostRules = 10000;

  /// Begins with the rules in `json`. `name`: name of their file, for messages. Scales are checked against `frame`.
  /// Throws as parse_scale_rules() and ScaleField::upper_bound() do.
  Design(const std::string& json, std::string name, RuleContext context, const GridFrame& frame);

  /// Returns the plan that the rules give now. Rules by shape are in `entries`, not measured.
  [[nodiscard]] const ScalePlan& plan() const { return plan_; }
  /// Returns the file of rules, one rule a line. Reading it gives plan() again.
  [[nodiscard]] std::string json() const;
  [[nodiscard]] std::size_t rules() const { return now().rules.size(); }                  ///< entries of the file
  [[nodiscard]] const std::string& rule(std::size_t i) const { return *now().rules[i]; }  ///< as JSON
  [[nodiscard]] const std::string& base() const { return now().base; }                    ///< as JSON: 0.1 or "3%"
  /// Returns the orientation of cubes as JSON; empty if there is none.
  [[nodiscard]] const std::string& orientation() const { return now().orientation; }
  /// Returns a number, from 1 on, that rises with each change. Undo and redo are changes, too.
  [[nodiscard]] std::uint64_t revision() const { return revision_; }

  // Each edit throws bad_input, and changes nothing, if the file would no longer be read as rules.
  /// Sets the base; `length` is JSON. `again` replaces the last step if that set the base, too, as while a slider
  /// moves.
  void set_base(const std::string& length, bool again = false);
  /// Sets the orientation of cubes; `value` is JSON, and null takes it away. `again` replaces the last step likewise,
  /// as while a frame is turned.
  void set_orientation(const std::string& value, bool again = false);
  /// Adds a rule, or a list of rules, at the end; `rule` is JSON. `again` replaces the last step if that added a rule,
  /// as while a stroke is drawn.
  void add(const std::string& rule, bool again = false);
  void remove(std::size_t i);  ///< throws bad_input if there is no such rule
  [[nodiscard]] bool can_undo() const { return at_ > 0; }
  [[nodiscard]] bool can_redo() const { return at_ + 1 < steps_.size(); }
  void undo();  ///< does nothing if there is nothing to undo
  void redo();

 private:
  using Rule = std::shared_ptr<const std::string>;
  /// One state of the file. Texts are JSON; an empty text means that the file has no such key.
  enum class Kind { other, base, orientation, rule };
  struct Step {
    std::string base, slope, orientation;
    std::vector<Rule> rules;
    Kind kind = Kind::other;  ///< what the step has changed
  };
  [[nodiscard]] const Step& now() const { return steps_[at_]; }
  [[nodiscard]] static std::string text_of(const Step& step);
  [[nodiscard]] ScalePlan read(const std::string& json) const;
  /// Returns a copy of the present step, to be changed. It will replace the last step if `again` is set and that step
  /// is of this kind.
  [[nodiscard]] Step next(Kind kind, bool again) const;
  void push(Step step, bool again);
  void move_to(std::size_t at);

  const std::string name_;
  RuleContext context_;
  const GridFrame frame_;
  std::shared_ptr<std::map<std::string, std::vector<Bounds3d>>> parts_;  ///< parts that were found before, by name
  std::vector<Step> steps_;
  std::size_t at_ = 0;  ///< number of the present step in steps_
  ScalePlan plan_;
  std::uint64_t revision_ = 1;
};

}  // namespace bp
