#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "io/gltf/base64.h"
#include "tests/fuzz/choices.h"
#include "tests/fuzz/entries.h"
#include "tests/fuzz/tool_runs.h"

namespace fuzz {

namespace {

using Json = nlohmann::ordered_json;
using Point = std::array<double, 3>;
using Triangle = std::array<Point, 3>;
using Soup = std::vector<Triangle>;
using Cell = std::array<double, 6>;

constexpr Cell kRoot{0, 0, 0, 16, 16, 16};
constexpr double kError = 1e-6;

/// Twelve triangles.
Soup box(const Cell& b) {
  const auto at = [&](int i) { return Point{b[i & 1 ? 3 : 0], b[i & 2 ? 4 : 1], b[i & 4 ? 5 : 2]}; };
  constexpr int kCorners[12][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                                   {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  Soup soup;
  for (const auto& t : kCorners) soup.push_back({at(t[0]), at(t[1]), at(t[2])});
  return soup;
}

/// Returns the parts of the triangles in a cell.
Soup cut(const Soup& soup, const Cell& cell) {
  Soup out;
  for (const Triangle& t : soup) {
    std::vector<Point> polygon(t.begin(), t.end());
    for (std::size_t face = 0; face < 6; ++face) {
      const double way = face < 3 ? 1 : -1, at = cell[face];
      std::vector<Point> kept;
      for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Point &p = polygon[k], &q = polygon[(k + 1) % polygon.size()];
        const double hp = way * (p[face % 3] - at), hq = way * (q[face % 3] - at);
        if (hp >= 0) kept.push_back(p);
        if ((hp >= 0) == (hq >= 0)) continue;
        Point& middle = kept.emplace_back();
        for (std::size_t i = 0; i < 3; ++i) middle[i] = p[i] + hp / (hp - hq) * (q[i] - p[i]);
        middle[face % 3] = at;
      }
      polygon = std::move(kept);
    }
    for (std::size_t k = 1; k + 1 < polygon.size(); ++k) out.push_back({polygon[0], polygon[k], polygon[k + 1]});
  }
  return out;
}

/// As glTF, which is y-up. Coordinates are rounded to floats, by less than half of kError.
std::string gltf_of(const Soup& soup) {
  std::string bytes;
  std::array<float, 3> min{}, max{};
  for (const Triangle& t : soup) {
    for (const Point& p : t) {
      const std::array<float, 3> corner{float(p[0]), float(p[2]), float(-p[1])};
      for (std::size_t i = 0; i < 3; ++i) {
        min[i] = bytes.empty() ? corner[i] : std::min(min[i], corner[i]);
        max[i] = bytes.empty() ? corner[i] : std::max(max[i], corner[i]);
      }
      bytes.append(reinterpret_cast<const char*>(corner.data()), sizeof corner);
    }
  }
  Json json = {{"asset", {{"version", "2.0"}}}, {"scene", 0}};
  json["scenes"] = {{{"nodes", {0}}}};
  json["nodes"] = {{{"mesh", 0}}};
  json["meshes"] = {{{"primitives", {{{"attributes", {{"POSITION", 0}}}}}}}};
  json["accessors"] = {{{"bufferView", 0}, {"componentType", 5126}, {"count", 3 * soup.size()}, {"type", "VEC3"}}};
  json["accessors"][0]["min"] = min;
  json["accessors"][0]["max"] = max;
  json["bufferViews"] = {{{"buffer", 0}, {"byteLength", bytes.size()}}};
  const std::string uri = "data:application/octet-stream;base64," + bp::base64_of(bytes);
  json["buffers"] = {{{"byteLength", bytes.size()}, {"uri", uri}}};
  return json.dump();
}

std::string obj_of(const Soup& soup) {
  std::string text;
  for (const Triangle& t : soup) {
    for (const Point& p : t) text += "v " + text_of(p[0]) + " " + text_of(p[1]) + " " + text_of(p[2]) + "\n";
  }
  for (std::size_t i = 0; i < soup.size(); ++i)
    text += "f " + std::to_string(3 * i + 1) + " " + std::to_string(3 * i + 2) + " " + std::to_string(3 * i + 3) + "\n";
  return text;
}

/// The damage that was done to a tileset.
struct Damage {
  bool any = false;   ///< the answer may be "does not hold"
  bool hole = false;  ///< the answer must be "does not hold"
};

class Maker {
 public:
  Maker(Choices& c, Workplace& place) : c_(c), place_(place) {}

  /// A root, and leaves in the octants that hold a part of the scene, or one in its whole cell.
  Damage make() {
    scene_ = c_.once_in(3) ? Soup{{Point{2, 2, 2}, {14, 2.5, 2}, {3, 3, 3}}} : box({2, 2, 2}, c_);
    place_.write("s.obj", obj_of(scene_));
    Json root = tile("r.gltf", box({1, 1, 1, 15, 15, 15}), kRoot, 8);
    root["refine"] = "REPLACE";
    if (c_.once_in(2)) {
      add_leaf(root, kRoot);
    } else {
      for (int k = 0; k < 8; ++k) {
        const double x = k & 1 ? 8 : 0, y = k & 2 ? 8 : 0, z = k & 4 ? 8 : 0;
        add_leaf(root, {x, y, z, x + 8, y + 8, z + 8});
      }
    }
    const Json ours = {{"up", "z"}, {"provenance", Json::array()}};
    Json json = {{"asset", {{"version", "1.1"}, {"extras", ours}}}, {"geometricError", real(40)}};
    json["root"] = std::move(root);
    place_.write("tileset.json", raw_numbers(json.dump()));
    return damage_;
  }

 private:
  static Soup box(const Cell& b) { return fuzz::box(b); }
  /// Returns a bar along x, sometimes very thin.
  static Soup box(const Point& low, Choices& c) {
    const double y = c.of({1.0, 1.0, 0.5, 1e-6, 1e-7, 3e-6}), z = c.of({1.0, 1.0, 1e-6, 12.0});
    return fuzz::box({low[0], low[1], low[2], low[0] + c.of({4.0, 12.0, 6.0}), low[1] + y, low[2] + z});
  }
  Json real(double sound) {
    if (!c_.once_in(40)) return sound;
    damage_.any = true;
    return "@" + text_of(extreme_number(c_));
  }
  /// "@text" becomes text.
  static std::string raw_numbers(std::string json) {
    for (std::size_t at = 0; (at = json.find("\"@", at)) != std::string::npos;) {
      json.erase(at, 2);
      json.erase(json.find('"', at), 1);
    }
    return json;
  }

  Json tile(const std::string& uri, const Soup& content, const Cell& cell, double error) {
    place_.write(uri, gltf_of(content));
    Json t = {{"boundingVolume", {{"box", {8, 8, 8, 9, 0, 0, 0, 9, 0, 0, 0, 9}}}}, {"geometricError", real(error)}};
    t["content"]["uri"] = uri;
    for (const double x : cell) t["extras"]["cell"].push_back(real(x));
    return t;
  }

  void add_leaf(Json& root, const Cell& cell) {
    Soup content = cut(scene_, cell);
    if (content.empty()) return add_empty_leaf(root, cell);
    change(content);
    if (content.empty()) content.push_back({});
    const std::string uri = "l" + std::to_string(leaves_++) + ".gltf";
    Json leaf = tile(uri, content, cell, c_.once_in(12) ? wrong(c_.of({1.0, 1e-3, 1e-9, 4e-6})) : kError);
    if (!c_.once_in(40)) leaf["extras"]["leaf"] = true;
    damage_.any = damage_.any || !leaf["extras"].contains("leaf");
    if (c_.once_in(40)) leaf["children"].push_back(tile("r.gltf", box({1, 1, 1, 15, 15, 15}), cell, wrong(0)));
    if (c_.once_in(40)) {
      damage_.any = true;
      for (const Triangle& t : content) damage_.hole = damage_.hole || is_wide(t);
      leaf.erase("content");
    }
    if (c_.once_in(40)) {
      damage_.any = true;
      root["children"].push_back(leaf);
    }
    root["children"].push_back(std::move(leaf));
  }
  /// Adds a leaf for a cell in which the scene has nothing, or none.
  void add_empty_leaf(Json& root, const Cell& cell) {
    if (c_.once_in(2)) return;
    Json leaf = tile("none.gltf", {}, cell, kError);
    leaf.erase("content");
    leaf["extras"]["leaf"] = true;
    root["children"].push_back(std::move(leaf));
  }
  double wrong(double x) {
    damage_.any = true;
    return x;
  }

  void change(Soup& content) {
    if (!c_.once_in(4)) return;
    damage_.any = true;
    Triangle& t = content[c_.below(std::uint32_t(content.size()))];
    switch (c_.below(6)) {
      case 0:
        damage_.hole = damage_.hole || is_wide(t);
        t = content.back();
        content.pop_back();
        break;
      case 1:
        std::swap(t[0], t[1]);
        break;
      case 2:
        t[c_.below(3)][c_.below(3)] = extreme_number(c_);
        break;
      case 3:
        content.push_back(t);
        break;
      default:
        t[c_.below(3)][c_.below(3)] += c_.of({1e-7, 1e-6, 3e-6, 1e-5, 1e-3, 1.0, -1.0});
    }
  }
  /// Returns whether a hole of this shape is seen. A corner at infinity is a damage of its own.
  static bool is_wide(const Triangle& t) {
    Point u, v;
    for (std::size_t i = 0; i < 3; ++i) u[i] = t[1][i] - t[0][i], v[i] = t[2][i] - t[0][i];
    const double area = std::hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]) / 2;
    return area > 0.1 && std::isfinite(area);
  }

  Choices& c_;
  Workplace& place_;
  Soup scene_;
  Damage damage_;
  int leaves_ = 0;
};

}  // namespace

void tileset(const std::uint8_t* data, std::size_t size) {
  Choices c(data, size);
  const std::uint32_t way = roll(data, size, 16);
  Workplace place;
  const Damage damage = Maker(c, place).make();
  const std::string tiles = place.path("tileset.json");
  if (way == 0) {
    (void)place.run("bpinfo", {tiles});
  } else if (way == 1) {
    (void)place.run("bpcheck", {tiles});
  } else if (way == 2) {
    (void)place.run("bpinfo", {tiles, "--image", place.path("x.png"), "--image-size", "48"}, {"x.png"});
  } else {
    const ToolResult verdict = place.run("bpcheck", {place.path("s.obj"), tiles});
    if (!damage.any && !verdict.done()) fail_fuzz("a sound tileset", verdict.output + verdict.messages);
    if (damage.hole && verdict.done()) fail_fuzz("a leaf with a hole", verdict.output + verdict.messages);
  }
}

}  // namespace fuzz
