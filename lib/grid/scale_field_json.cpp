#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "lib/core/error.h"
#include "lib/core/length.h"
#include "lib/grid/scale_field.h"

// Scale fields as JSON.

namespace bp {

namespace {

using Json = nlohmann::ordered_json;

/// Reads one JSON value and knows its place, such as "strokes[3].support", for messages.
class Node {
 public:
  Node(const Json& json, std::string path, const std::string& name)
      : json_(json), path_(std::move(path)), name_(name) {}

  [[noreturn]] void refuse(const std::string& fact) const {
    fail(ErrorCode::bad_input, "{}: scale field: {} {}", name_, path_.empty() ? "the document" : path_, fact);
  }
  void expect_keys(std::initializer_list<const char*> known) const {
    if (!json_.is_object()) refuse("is not an object");
    for (const auto& [key, value] : json_.items()) {
      if (std::find(known.begin(), known.end(), key) == known.end()) {
        fail(ErrorCode::bad_input, "{}: scale field: unknown key '{}'; known here: {}", name_, join(key).path_,
             fmt::join(known, ", "));
      }
    }
  }
  [[nodiscard]] bool has(const char* key) const { return json_.contains(key); }
  [[nodiscard]] Node at(const char* key) const {
    if (!has(key)) join(key).refuse("is missing");
    return {json_[key], join(key).path_, name_};
  }
  [[nodiscard]] Node item(std::size_t i) const { return {json_[i], fmt::format("{}[{}]", path_, i), name_}; }
  [[nodiscard]] std::size_t list_size() const {
    if (!json_.is_array()) refuse("is not a list");
    return json_.size();
  }
  [[nodiscard]] bool is_number() const { return json_.is_number(); }
  [[nodiscard]] double number() const {
    if (!json_.is_number()) refuse("is not a number");
    const double x = json_.get<double>();
    if (!std::isfinite(x)) refuse("is not finite");
    return x;
  }
  [[nodiscard]] double length() const {
    const double x = number();
    if (x < 0) refuse("is negative");
    return x;
  }
  [[nodiscard]] Vec3d point() const {
    if (list_size() != 3) refuse("is not a list of three numbers");
    return {item(0).number(), item(1).number(), item(2).number()};
  }
  [[nodiscard]] std::string json() const { return json_.dump(); }
  [[nodiscard]] std::string text() const {
    if (!json_.is_string()) refuse("is not a text");
    return json_.get<std::string>();
  }
  /// Returns a text that people can read.
  [[nodiscard]] std::string plain_text() const {
    const std::string x = text();
    if (std::any_of(x.begin(), x.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }))
      refuse("holds control characters");
    return x;
  }

 private:
  [[nodiscard]] Node join(const std::string& key) const {
    return {json_, path_.empty() ? key : path_ + "." + key, name_};
  }
  const Json& json_;
  std::string path_;
  const std::string& name_;
};

constexpr const char* kModeNames[] = {"set", "increase", "decrease", "erase"};

ScaleMode mode_of(const Node& node) {
  const std::string mode = node.text();
  const auto found = std::find(std::begin(kModeNames), std::end(kModeNames), mode);
  if (found == std::end(kModeNames)) node.refuse("is none of set, increase, decrease, erase");
  return ScaleMode(found - std::begin(kModeNames));
}

/// Returns one point, or a list of points.
std::vector<Vec3d> points_of(const Node& node) {
  if (node.list_size() == 0) node.refuse("is an empty list");
  if (node.item(0).is_number()) return {node.point()};
  std::vector<Vec3d> points;
  for (std::size_t i = 0; i < node.list_size(); ++i) points.push_back(node.item(i).point());
  return points;
}

void check_box(const Node& node, const ScaleRule& box) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (box.points[0][i] > box.points[1][i]) node.refuse("has its min above its max");
  }
}

/// Returns the one key that gives the place of the rule.
std::string place_key(const Node& node) {
  std::string found;
  for (const char* key : {"at", "box", "node", "view", "thickness", "gap"}) {
    if (!node.has(key)) continue;
    if (!found.empty()) node.refuse(fmt::format("has both '{}' and '{}'", found, key));
    found = key;
  }
  if (found.empty()) node.refuse("says no place: give it one of at, box, node, view, thickness, gap");
  return found;
}

/// Reads the rules of a file.
class RuleReader {
 public:
  RuleReader(ScalePlan& plan, const RuleContext& context) : plan_(plan), field_(plan.field), context_(context) {}

  [[nodiscard]] double length(const Node& node) const {
    if (node.is_number() || !(context_.diagonal > 0 || context_.voxel > 0)) return node.length();
    try {
      const Length length = parse_length(node.text());
      if (length.unit == Length::Unit::scene)
        node.refuse(fmt::format("is a text without a unit: write {0}, or \"{0}%\"", length.text()));
      return length.in_world(context_.diagonal, context_.voxel);
    } catch (const Error& e) {
      if (e.code() == ErrorCode::bad_input) throw;
      node.refuse(fmt::format("is no length: {}", e.what()));
    }
  }
  /// Returns a length for openings. Nothing of a scene is farther apart than its diagonal.
  [[nodiscard]] double within_scene(const Node& node) const {
    const double found = length(node);
    if (context_.diagonal > 0 && found > context_.diagonal)
      node.refuse(fmt::format("is longer than the scene's diagonal ({:.4g})", context_.diagonal));
    return found;
  }

  void add(const Node& node) {
    const std::string place = place_key(node);
    if (place == "view") return add_view(node);
    if (place == "thickness" || place == "gap") return add_shape(node, place.c_str());
    node.expect_keys({"name", place.c_str(), "radius", "support", "mode", "scale"});
    ScaleRule rule = start(node);
    if (node.has("support")) rule.support = length(node.at("support"));
    if (place == "at") {
      rule.points = points_of(node.at("at"));
      rule.radius = rule.mode == ScaleMode::erase ? field_.base : rule.scale;
    }
    if (node.has("radius")) rule.radius = length(node.at("radius"));
    if (place == "node") return add_parts(node.at("node"), rule);
    if (place == "box") {
      rule.shape = ScaleShape::box;
      rule.points = points_of(node.at("box"));
      if (rule.points.size() != 2) node.at("box").refuse("is not a list of two points");
      check_box(node.at("box"), rule);
    }
    push(rule);
  }

  /// Adds a box as earlier versions wrote them: its scale jumps at the sides.
  void add_old_box(const Node& node) {
    node.expect_keys({"min", "max", "scale"});
    const ScaleRule box = box_rule(node.at("min").point(), node.at("max").point(), node.at("scale").length());
    check_box(node, box);
    push(box);
  }

  void add_old_stroke(const Node& node) {
    node.expect_keys({"mode", "position", "support", "target"});
    const ScaleMode mode = mode_of(node.at("mode"));
    if (mode == ScaleMode::set) node.at("mode").refuse("is none of increase, decrease, erase");
    const Vec3d position = node.at("position").point();
    const double support = node.at("support").length();
    const bool has_target = mode != ScaleMode::erase || node.has("target");
    const double target = has_target ? node.at("target").length() : 0;
    push(stroke_rule(mode, position, support, target, field_.base));
  }

 private:
  void push(const ScaleRule& rule) {
    field_.rules.push_back(rule);
    plan_.entries.emplace_back();
  }

  /// Returns a rule with name, mode and scale.
  [[nodiscard]] ScaleRule start(const Node& node) const {
    ScaleRule rule;
    if (node.has("name")) rule.name = node.at("name").plain_text();
    if (node.has("mode")) rule.mode = mode_of(node.at("mode"));
    if (rule.mode != ScaleMode::erase || node.has("scale")) rule.scale = within_scene(node.at("scale"));
    return rule;
  }

  void add_view(const Node& node) {
    node.expect_keys({"name", "view", "per_distance", "mode", "scale"});
    ScaleRule rule = start(node);
    rule.shape = ScaleShape::view;
    if (!node.has("mode")) rule.mode = ScaleMode::increase;
    if (rule.mode == ScaleMode::erase) node.at("mode").refuse("is none of set, increase, decrease, as a view needs");
    rule.points = points_of(node.at("view"));
    rule.per_distance = node.at("per_distance").length();
    if (rule.per_distance > field_.slope) node.at("per_distance").refuse("is above the slope of the field");
    push(rule);
  }

  void add_shape(const Node& node, const char* place) {
    ShapeRule rule;
    const bool thin = std::string(place) == "thickness";
    rule.kind = thin ? ShapeRule::Kind::thickness : ShapeRule::Kind::gap;
    node.expect_keys({"name", place, thin ? "scale" : "mode"});
    rule.length = within_scene(node.at(place));
    if (!(rule.length > 0)) node.at(place).refuse("is 0");
    if (node.has("scale")) rule.least = length(node.at("scale"));
    if (node.has("mode")) rule.mode = mode_of(node.at("mode"));
    if (rule.mode == ScaleMode::erase) node.at("mode").refuse("is none of set, increase, decrease, as a gap needs");
    rule.name = node.has("name") ? node.at("name").plain_text() : thin ? "thin parts" : "openings";
    plan_.entries.push_back({0, rule});
  }

  void add_parts(const Node& node, ScaleRule rule) {
    const std::string pattern = node.plain_text();
    if (!context_.parts) node.refuse("names parts of a scene, and none is known here");
    rule.shape = ScaleShape::box;
    if (rule.name.empty()) rule.name = pattern;
    const std::vector<Bounds3d> boxes = context_.parts(pattern);
    for (const Bounds3d& box : boxes) {
      rule.points = {box.min, box.max};
      field_.rules.push_back(rule);
    }
    plan_.entries.push_back({boxes.size(), {}});
  }

  ScalePlan& plan_;
  ScaleField& field_;  // of the plan
  const RuleContext& context_;
};

template <class Add>
void for_each_of(const Node& root, const char* key, const Add& add) {
  if (!root.has(key)) return;
  const Node list = root.at(key);
  for (std::size_t i = 0; i < list.list_size(); ++i) add(list.item(i));
}

/// Refuses repeated keys. nlohmann would keep the last of two equal keys without a word.
Json parse_without_repeats(const std::string& text, const std::string& name) {
  constexpr int kMostLevels = 6;
  std::vector<std::set<std::string>> keys;
  const auto watch = [&](int depth, Json::parse_event_t event, Json& value) {
    if (depth > kMostLevels)
      fail(ErrorCode::bad_input, "{}: scale field: is more than {} levels deep", name, kMostLevels);
    if (event == Json::parse_event_t::object_start) keys.emplace_back();
    if (event == Json::parse_event_t::object_end) keys.pop_back();
    if (event == Json::parse_event_t::key && !keys.back().insert(value.get<std::string>()).second)
      fail(ErrorCode::bad_input, "{}: scale field: key '{}' appears twice", name, value.get<std::string>());
    return true;
  };
  try {
    return Json::parse(text, watch);
  } catch (const nlohmann::json::parse_error& e) {
    fail(ErrorCode::bad_input, "{}: scale field: not valid JSON at byte {}", name, e.byte);
  } catch (const nlohmann::json::exception&) {
    fail(ErrorCode::bad_input, "{}: scale field: a number is too large, or a text is not UTF-8", name);
  }
}

Json json_of(const Vec3d& p) {
  return Json::array({p[0] + 0.0, p[1] + 0.0, p[2] + 0.0});  // -0 becomes 0: equal fields, equal text
}

Json json_of(const std::vector<Vec3d>& points) {
  Json list = Json::array();
  for (const Vec3d& p : points) list.push_back(json_of(p));
  return list;
}

Json json_of(const ScaleRule& rule) {
  constexpr const char* kPlaces[] = {"box", "at", "view"};
  Json j;
  if (!rule.name.empty()) j["name"] = rule.name;
  j[kPlaces[int(rule.shape)]] = json_of(rule.points);
  if (rule.shape == ScaleShape::view) {
    j["per_distance"] = rule.per_distance + 0.0;
  } else {
    j["radius"] = rule.radius + 0.0;
    if (rule.support != ScaleRule::kNoSupport) j["support"] = rule.support + 0.0;
  }
  j["mode"] = kModeNames[int(rule.mode)];
  j["scale"] = rule.scale + 0.0;
  return j;
}

Json json_of(const ShapeRule& rule) {
  const bool thin = rule.kind == ShapeRule::Kind::thickness;
  Json j{{"name", rule.name}, {thin ? "thickness" : "gap", rule.length + 0.0}};
  if (thin) {
    j["scale"] = rule.least + 0.0;
  } else {
    j["mode"] = kModeNames[int(rule.mode)];
  }
  return j;
}

std::string to_json(const ScaleField& field, const Json& rules) {
  if (rules.empty()) return Json{{"base", field.base + 0.0}}.dump();
  return Json{{"base", field.base + 0.0}, {"slope", field.slope + 0.0}, {"rules", rules}}.dump(
      -1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

ScalePlan parse_scale_rules(const std::string& json, const std::string& name, const RuleContext& context) {
  const Json document = parse_without_repeats(json, name);
  const Node root(document, "", name);
  root.expect_keys({"base", "slope", "rules", "boxes", "strokes", "orientation"});
  ScalePlan plan;
  ScaleField& field = plan.field;
  RuleReader reader(plan, context);
  field.base = reader.within_scene(root.at("base"));
  if (root.has("slope")) field.slope = root.at("slope").length();
  if (root.has("rules") && (root.has("boxes") || root.has("strokes")))
    root.refuse("has 'rules' and, as earlier versions had them, 'boxes' or 'strokes'");
  if (root.has("orientation") && !context.may_orient)
    root.at("orientation").refuse("is made for the voxels of a stream: bpvox | bpscale RULES | bpclose | bpmesh");
  for_each_of(root, "rules", [&](const Node& node) { reader.add(node); });
  for_each_of(root, "boxes", [&](const Node& node) { reader.add_old_box(node); });
  for_each_of(root, "strokes", [&](const Node& node) { reader.add_old_stroke(node); });
  if (root.has("orientation")) plan.orientation = root.at("orientation").json();
  return plan;
}

ScaleField parse_scale_field(const std::string& json, const std::string& name) {
  ScalePlan plan = parse_scale_rules(json, name, {});
  for (const RuleEntry& entry : plan.entries) {
    if (entry.shape)
      fail(ErrorCode::bad_input, "{}: scale field: '{}' is measured on voxels, and should be boxes by now", name,
           entry.shape->name);
  }
  return std::move(plan.field);
}

std::string to_json(const ScaleField& field) {
  Json rules = Json::array();
  for (const ScaleRule& rule : field.rules) rules.push_back(json_of(rule));
  return to_json(field, rules);
}

std::string to_json(const ScalePlan& plan) {
  Json rules = Json::array();
  std::size_t next = 0;
  for (const RuleEntry& entry : plan.entries) {
    if (entry.shape) rules.push_back(json_of(*entry.shape));
    for (std::size_t i = 0; i < entry.rules; ++i, ++next) {
      if (!entry.shape) rules.push_back(json_of(plan.field.rules[next]));
    }
  }
  return to_json(plan.field, rules);
}

}  // namespace bp
