#include <algorithm>
#include <array>
#include <charconv>

#include "io/scene/detail/exact/exact_scene.h"

// DXF (AutoCAD 2012 DXF Reference). Assimp reads faces and polyface meshes; it moves what INSERT places in single
// precision, and drops its turn. It drops faces of polyface meshes with a corner's number below 0, which means that the
// edge from there is invisible. Here, only what it does not follow is counted.

namespace bp {

namespace {

/// Entities that Assimp reads, and those that are points, lines or letters.
constexpr std::array<std::string_view, 28> kRead{
    "3DFACE",    "POLYLINE", "VERTEX",  "SEQEND",    "LWPOLYLINE",    "LINE",
    "POINT",     "CIRCLE",   "ARC",     "ELLIPSE",   "SPLINE",        "TEXT",
    "MTEXT",     "ATTDEF",   "ATTRIB",  "LEADER",    "MLEADER",       "MULTILEADER",
    "MLINE",     "XLINE",    "RAY",     "DIMENSION", "ARC_DIMENSION", "LARGE_RADIAL_DIMENSION",
    "TOLERANCE", "VIEWPORT", "SECTION", "ENDSEC"};

std::string_view trimmed_line(std::string_view& text) {
  constexpr std::string_view kSpace = " \t\r";
  std::string_view line = text.substr(0, text.find('\n'));
  text.remove_prefix(std::min(text.size(), line.size() + 1));
  line.remove_prefix(std::min(line.size(), line.find_first_not_of(kSpace)));
  return line.substr(0, line.find_last_not_of(kSpace) + 1);
}

double number_of(std::string_view text) {
  double value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

class Entities {
 public:
  /// Takes a group: its code, and its value.
  void take(std::string_view code, std::string_view value) {
    if (code == "0") {
      begins_section_ = value == "SECTION";
      is_layer_ = !inside_ && value == "LAYER";
      if (inside_) begin(value);
    } else if (code == "2" && begins_section_) {
      inside_ = value == "ENTITIES";
    } else if (inside_) {
      look_at(code, value);
    } else if (is_layer_) {
      look_at_layer(code, value);
    }
  }
  [[nodiscard]] const Unfollowed& unfollowed() const { return unfollowed_; }

 private:
  void begin(std::string_view entity) {
    entity_ = entity;
    if (entity == "INSERT") {
      ++unfollowed_.placed;
    } else if (std::find(kRead.begin(), kRead.end(), entity) == kRead.end() && entity != "EOF") {
      ++unfollowed_.missing;
    }
  }
  void look_at(std::string_view code, std::string_view value) {
    constexpr int kGrid = 16;
    const bool is_grid = entity_ == "POLYLINE" && code == "70" && (int(number_of(value)) & kGrid) != 0;
    const bool is_thick = code == "39" && number_of(value) != 0;
    const bool is_turned =
        ((code == "210" || code == "220") && number_of(value) != 0) || (code == "230" && number_of(value) != 1);
    const bool is_corner = entity_ == "VERTEX" && code.size() == 2 && code >= "71" && code <= "74";
    const bool is_dropped = is_corner && value.find_first_not_of("0123456789") != value.npos;
    unfollowed_.missing += is_grid || is_thick || is_dropped ? 1 : 0;
    unfollowed_.transforms += is_turned ? 1 : 0;
    const bool is_invisible = code == "60" && number_of(value) != 0,
               is_on_paper = code == "67" && number_of(value) == 1;
    unfollowed_.hidden += is_invisible || is_on_paper ? 1 : 0;
  }
  /// Counts a layer that is off (its colour is below 0) or frozen: Assimp reads what lies on it.
  void look_at_layer(std::string_view code, std::string_view value) {
    constexpr int kFrozen = 1;
    const bool is_off = code == "62" && value.starts_with('-');
    unfollowed_.hidden += is_off || (code == "70" && (int(number_of(value)) & kFrozen) != 0) ? 1 : 0;
  }

  bool begins_section_ = false, inside_ = false, is_layer_ = false;
  std::string_view entity_;
  Unfollowed unfollowed_;
};

}  // namespace

ExactScene exact_dxf(std::string_view text) {
  Entities entities;
  while (!text.empty()) {
    const std::string_view code = trimmed_line(text);
    entities.take(code, trimmed_line(text));
  }
  ExactScene scene;
  scene.unfollowed = entities.unfollowed();
  return scene;
}

}  // namespace bp
