#include "lib/live/design.h"

#include <nlohmann/json.hpp>

#include "lib/core/error.h"
#include "lib/pass/measure/orientation_rules.h"

namespace bp {

namespace {

using Json = nlohmann::ordered_json;

/// Rules are flat. A deep text would overflow the stack when it is written again, so it is refused.
Json parse_flat(const std::string& text, const std::string& name) {
  constexpr int kMostLevels = 8;
  const auto watch = [&](int depth, Json::parse_event_t, Json&) {
    if (depth > kMostLevels) fail(ErrorCode::bad_input, "{}: is more than {} levels deep", name, kMostLevels);
    return true;
  };
  try {
    return Json::parse(text, watch);
  } catch (const nlohmann::json::exception&) {
    fail(ErrorCode::bad_input, "{}: not valid JSON", name);
  }
}

std::string compact(const Json& json, const std::string& name) {
  try {
    return json.dump();
  } catch (const nlohmann::json::exception&) {
    fail(ErrorCode::bad_input, "{}: a text is not UTF-8", name);
  }
}

}  // namespace

Design::Design(const std::string& json, std::string name, RuleContext context, const GridFrame& frame)
    : name_(std::move(name)),
      context_(std::move(context)),
      frame_(frame),
      parts_(std::make_shared<std::map<std::string, std::vector<Bounds3d>>>()) {
  if (context_.parts) {
    context_.parts = [find = context_.parts, known = parts_](const std::string& pattern) {
      const auto found = known->find(pattern);
      return found != known->end() ? found->second : known->emplace(pattern, find(pattern)).first->second;
    };
  }
  plan_ = read(json);
  Json document = parse_flat(json, name_);
  // Files of earlier versions are rewritten in today's words.
  if (document.contains("boxes") || document.contains("strokes")) document = parse_flat(to_json(plan_), name_);
  Step step;
  step.base = compact(document["base"], name_);
  if (document.contains("slope")) step.slope = compact(document["slope"], name_);
  if (document.contains("orientation")) step.orientation = compact(document["orientation"], name_);
  for (const Json& rule : document.value("rules", Json::array()))
    step.rules.push_back(std::make_shared<const std::string>(compact(rule, name_)));
  steps_.push_back(std::move(step));
}

std::string Design::json() const {
  return text_of(now());
}

std::string Design::text_of(const Step& step) {
  std::string text = "{\"base\": " + step.base;
  if (!step.slope.empty()) text += ",\n \"slope\": " + step.slope;
  if (!step.orientation.empty()) text += ",\n \"orientation\": " + step.orientation;
  text += ",\n \"rules\": [";
  for (std::size_t i = 0; i < step.rules.size(); ++i) text += (i == 0 ? "\n  " : ",\n  ") + *step.rules[i];
  return text + (step.rules.empty() ? "]}\n" : "\n ]}\n");
}

ScalePlan Design::read(const std::string& json) const {
  ScalePlan plan = parse_scale_rules(json, name_, context_);
  (void)plan.field.upper_bound(frame_);
  if (!plan.orientation.empty()) (void)parse_orientation(plan.orientation, name_);
  return plan;
}

Design::Step Design::next(Kind kind, bool again) const {
  Step step = again && at_ > 0 && now().kind == kind ? steps_[at_ - 1] : now();
  step.kind = kind;
  return step;
}

void Design::push(Step step, bool again) {
  ScalePlan plan = read(text_of(step));  // throws before anything is changed
  const std::size_t kept = again && at_ > 0 && now().kind == step.kind ? at_ : at_ + 1;
  steps_.resize(kept);
  steps_.push_back(std::move(step));
  if (steps_.size() > kMostSteps + 1) steps_.erase(steps_.begin());
  at_ = steps_.size() - 1;
  plan_ = std::move(plan);
  ++revision_;
}

void Design::set_base(const std::string& length, bool again) {
  Step step = next(Kind::base, again);
  step.base = compact(parse_flat(length, name_), name_);
  push(std::move(step), again);
}

void Design::set_orientation(const std::string& value, bool again) {
  const Json json = parse_flat(value, name_);
  Step step = next(Kind::orientation, again);
  step.orientation = json.is_null() ? "" : compact(json, name_);
  push(std::move(step), again);
}

void Design::add(const std::string& rule, bool again) {
  Json some = parse_flat(rule, name_);
  if (!some.is_array() || some.empty()) some = Json::array({some});
  Step step = next(Kind::rule, again);
  for (const Json& json : some) {
    if (!json.is_object()) fail(ErrorCode::bad_input, "{}: a rule is no object", name_);
    step.rules.push_back(std::make_shared<const std::string>(compact(json, name_)));
  }
  if (step.rules.size() > kMostRules)
    fail(ErrorCode::bad_input, "{}: has {} rules; {} is the most", name_, step.rules.size(), kMostRules);
  push(std::move(step), again);
}

void Design::remove(std::size_t i) {
  if (i >= rules()) fail(ErrorCode::bad_input, "{}: has no rule {}", name_, i);
  Step step = next(Kind::other, false);
  step.rules.erase(step.rules.begin() + std::ptrdiff_t(i));
  push(std::move(step), false);
}

void Design::move_to(std::size_t at) {
  plan_ = read(text_of(steps_[at]));
  at_ = at;
  ++revision_;
}

void Design::undo() {
  if (can_undo()) move_to(at_ - 1);
}

void Design::redo() {
  if (can_redo()) move_to(at_ + 1);
}

}  // namespace bp
