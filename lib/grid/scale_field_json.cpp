#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "lib/core/error.h"
#include "lib/grid/scale_field.h"

// Scale fields as JSON.

namespace bp {

namespace {

using Json = nlohmann::ordered_json;

/// Reads one JSON value, knowing where it is: "strokes[3].support".
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
  [[nodiscard]] std::string text() const {
    if (!json_.is_string()) refuse("is not a text");
    return json_.get<std::string>();
  }

 private:
  [[nodiscard]] Node join(const std::string& key) const {
    return {json_, path_.empty() ? key : path_ + "." + key, name_};
  }
  const Json& json_;
  std::string path_;
  const std::string& name_;
};

constexpr const char* kModeNames[] = {"increase", "decrease", "erase"};

BrushStroke stroke_of(const Node& node) {
  node.expect_keys({"mode", "position", "support", "target"});
  BrushStroke stroke;
  const std::string mode = node.at("mode").text();
  const auto found = std::find(std::begin(kModeNames), std::end(kModeNames), mode);
  if (found == std::end(kModeNames)) node.at("mode").refuse("is none of increase, decrease, erase");
  stroke.mode = BrushMode(found - std::begin(kModeNames));
  stroke.position = node.at("position").point();
  stroke.support = node.at("support").length();
  if (stroke.mode != BrushMode::erase || node.has("target")) stroke.target = node.at("target").length();
  return stroke;
}

ScaleBox box_of(const Node& node) {
  node.expect_keys({"min", "max", "scale"});
  const ScaleBox box{node.at("min").point(), node.at("max").point(), node.at("scale").length()};
  for (std::size_t i = 0; i < 3; ++i) {
    if (box.min[i] > box.max[i]) node.refuse("has its min above its max");
  }
  return box;
}

/// nlohmann keeps the last of two equal keys without a word; we refuse them.
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

}  // namespace

ScaleField parse_scale_field(const std::string& json, const std::string& name) {
  const Json document = parse_without_repeats(json, name);
  const Node root(document, "", name);
  root.expect_keys({"base", "strokes", "boxes"});
  ScaleField field;
  field.base = root.at("base").length();
  if (root.has("strokes")) {
    const Node list = root.at("strokes");
    for (std::size_t i = 0; i < list.list_size(); ++i) field.strokes.push_back(stroke_of(list.item(i)));
  }
  if (root.has("boxes")) {
    const Node list = root.at("boxes");
    for (std::size_t i = 0; i < list.list_size(); ++i) field.boxes.push_back(box_of(list.item(i)));
  }
  return field;
}

std::string to_json(const ScaleField& field) {
  Json strokes = Json::array(), boxes = Json::array();
  for (const BrushStroke& s : field.strokes) {
    strokes.push_back(Json{{"mode", kModeNames[int(s.mode)]},
                           {"position", json_of(s.position)},
                           {"support", s.support + 0.0},
                           {"target", s.target + 0.0}});
  }
  for (const ScaleBox& b : field.boxes)
    boxes.push_back(Json{{"min", json_of(b.min)}, {"max", json_of(b.max)}, {"scale", b.scale + 0.0}});
  return Json{{"base", field.base + 0.0}, {"strokes", strokes}, {"boxes", boxes}}.dump();
}

}  // namespace bp
