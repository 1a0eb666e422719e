#include <algorithm>
#include <cmath>
#include <set>

#include "io/gltf/gltf_document.h"
#include "io/scene/raw_source.h"
#include "io/scene/scene_pose.h"

// Animations (glTF 2.0, section 3.11; interpolation: appendix C) and morph targets (3.7.2.2) as a list of moments.

namespace bp {

namespace {

constexpr std::size_t kMostPoses = 100000;

enum class Between { line, step, cubic };

/// Numbers over time: `size` of them at each key, with tangents before and after them if the curve is cubic.
struct Curve {
  std::uint64_t node = 0;
  std::string path;
  Between between = Between::line;
  std::size_t size = 0;
  std::vector<double> times, values;

  [[nodiscard]] const double* key(std::size_t k) const {
    return values.data() + (between == Between::cubic ? 3 * k + 1 : k) * size;
  }
  [[nodiscard]] std::vector<double> at(double time) const;

 private:
  void blend_cubic(std::size_t k, double u, std::vector<double>& out) const;
  void turn(std::size_t k, double u, std::vector<double>& out) const;
};

void make_unit(std::vector<double>& q) {
  double square = 0;
  for (const double x : q) square += x * x;
  for (double& x : q) x /= square > 0 ? std::sqrt(square) : 1;
}

void Curve::blend_cubic(std::size_t k, double u, std::vector<double>& out) const {
  const double step = times[k + 1] - times[k], u2 = u * u, u3 = u2 * u;
  const double *a = key(k), *b = key(k + 1), *after = a + size, *before = b - size;
  for (std::size_t i = 0; i < size; ++i)
    out[i] = (2 * u3 - 3 * u2 + 1) * a[i] + step * (u3 - 2 * u2 + u) * after[i] + (3 * u2 - 2 * u3) * b[i] +
             step * (u3 - u2) * before[i];
  if (path == "rotation") make_unit(out);
}

/// Turns along the shorter arc.
void Curve::turn(std::size_t k, double u, std::vector<double>& out) const {
  constexpr double kLine = 0.9999;  // a cosine: beyond it the arc is as good as a line
  const double *a = key(k), *b = key(k + 1);
  double cosine = 0;
  for (std::size_t i = 0; i < size; ++i) cosine += a[i] * b[i];
  const double sign = cosine < 0 ? -1 : 1, angle = std::acos(std::min(sign * cosine, 1.0)), sine = std::sin(angle);
  const bool line = sign * cosine > kLine;
  const double from = line ? 1 - u : std::sin((1 - u) * angle) / sine, to = line ? u : std::sin(u * angle) / sine;
  for (std::size_t i = 0; i < size; ++i) out[i] = from * a[i] + sign * to * b[i];
  make_unit(out);
}

/// Returns the value at a time; before the first key and after the last one their values.
std::vector<double> Curve::at(double time) const {
  const std::size_t after = std::size_t(std::upper_bound(times.begin(), times.end(), time) - times.begin());
  const std::size_t k = after == 0 ? 0 : after - 1;
  std::vector<double> out(key(k), key(k) + size);
  if (after == 0 || after == times.size() || between == Between::step || time == times[k]) return out;
  const double u = (time - times[k]) / (times[k + 1] - times[k]);
  if (between == Between::cubic) {
    blend_cubic(k, u, out);
  } else if (path == "rotation") {
    turn(k, u, out);
  } else {
    for (std::size_t i = 0; i < size; ++i) out[i] = (1 - u) * key(k)[i] + u * key(k + 1)[i];
  }
  return out;
}

template <std::size_t N>
std::array<double, N> array_of(const std::vector<double>& values) {
  std::array<double, N> out;
  std::copy_n(values.begin(), N, out.begin());
  return out;
}

class PoseFinder {
 public:
  PoseFinder(const SceneFilePtr& file, const SceneOptions& options)
      : doc_(file, options), root_(doc_.root()), options_(options), name_(file->name()) {}

  std::vector<ScenePose> find(std::optional<double> per_second) {
    if (!root_.array("animations").empty()) {
      const std::vector<Curve> curves = curves_of(root_.item("animations", 0));
      if (!curves.empty()) return poses_of(curves, per_second);
    }
    return targets();
  }

 private:
  std::vector<Curve> curves_of(const GltfObject& animation);
  void read_keys(const GltfObject& sampler, std::size_t components, Curve& curve);
  std::vector<double> numbers(std::uint64_t accessor, std::size_t components);
  [[nodiscard]] std::vector<double> times_of(const std::vector<Curve>& curves, std::optional<double> per_second) const;
  [[nodiscard]] std::vector<ScenePose> poses_of(const std::vector<Curve>& curves,
                                                std::optional<double> per_second) const;
  [[nodiscard]] std::vector<ScenePose> targets() const;
  void check_count(double poses) const {
    if (!(poses <= double(kMostPoses)))
      fail(ErrorCode::bad_input, "{}: its animation has {:.0f} poses, and at most {} are read", name_, poses,
           kMostPoses);
  }

  GltfDocument doc_;
  GltfObject root_;
  const SceneOptions& options_;
  const std::string name_;
  std::uint64_t bytes_ = 0;  ///< numbers in memory
};

std::vector<double> PoseFinder::numbers(std::uint64_t number, std::size_t components) {
  const Accessor accessor = doc_.accessor(number, components);
  bytes_ += accessor.count * components * sizeof(double);
  check_document(options_, name_, "its animation", bytes_, options_.document.bytes);
  return read_numbers(doc_.bytes(), accessor);
}

void PoseFinder::read_keys(const GltfObject& sampler, std::size_t components, Curve& curve) {
  const std::string way = sampler.has("interpolation") ? sampler.text("interpolation") : "LINEAR";
  if (way != "LINEAR" && way != "STEP" && way != "CUBICSPLINE") sampler.broken("has the unknown interpolation " + way);
  curve.between = way == "LINEAR" ? Between::line : way == "STEP" ? Between::step : Between::cubic;
  curve.times = numbers(sampler.number("input"), 1);
  curve.values = numbers(sampler.number("output"), components);
  const std::size_t keys = curve.times.size() * (curve.between == Between::cubic ? 3 : 1);
  const auto falls = [](double a, double b) { return !(a < b); };
  const bool rise = std::adjacent_find(curve.times.begin(), curve.times.end(), falls) == curve.times.end();
  if (curve.times.empty() || !rise || !std::isfinite(curve.times.front()) || !std::isfinite(curve.times.back()))
    sampler.broken("has times that do not rise");
  curve.size = curve.values.size() / keys;
  if (curve.size == 0 || curve.values.size() % keys != 0 || (components > 1 && curve.size != components))
    sampler.broken(fmt::format("has {} times and {} values", curve.times.size(), curve.values.size() / components));
}

std::vector<Curve> PoseFinder::curves_of(const GltfObject& animation) {
  std::vector<Curve> curves;
  for (std::size_t i = 0; i < animation.array("channels").size(); ++i) {
    const GltfObject channel = animation.item("channels", i), target = channel.object("target");
    if (!target.has("node")) continue;
    Curve curve;
    curve.node = target.number("node");
    curve.path = target.text("path");
    const bool vector = curve.path == "translation" || curve.path == "scale", turn = curve.path == "rotation";
    if (!vector && !turn && curve.path != "weights") continue;  // the path of an extension
    read_keys(animation.item("samplers", channel.number("sampler")), vector ? 3 : turn ? 4 : 1, curve);
    curves.push_back(std::move(curve));
  }
  return curves;
}

std::vector<double> PoseFinder::times_of(const std::vector<Curve>& curves, std::optional<double> per_second) const {
  std::set<double> keys;
  for (const Curve& c : curves) keys.insert(c.times.begin(), c.times.end());
  check_count(double(keys.size()));
  if (!per_second) return {keys.begin(), keys.end()};
  const double begin = *keys.begin(), steps = std::round((*keys.rbegin() - begin) * *per_second);
  check_count(steps + 1);
  std::vector<double> times;
  for (std::size_t i = 0; i <= std::size_t(steps); ++i) times.push_back(begin + double(i) / *per_second);
  return times;
}

std::vector<ScenePose> PoseFinder::poses_of(const std::vector<Curve>& curves, std::optional<double> per_second) const {
  const std::vector<double> times = times_of(curves, per_second);
  std::uint64_t each = 0;
  for (const Curve& c : curves) each += 200 + c.size * sizeof(double);
  check_document(options_, name_, "the poses of its animation", bytes_ + times.size() * each, options_.document.bytes);
  std::vector<ScenePose> poses;
  for (const double time : times) {
    ScenePose& pose = poses.emplace_back();
    for (const Curve& c : curves) {
      ScenePose::Node& node = pose.nodes[c.node];
      std::vector<double> values = c.at(time);
      if (c.path == "translation") node.translation = array_of<3>(values);
      if (c.path == "scale") node.scale = array_of<3>(values);
      if (c.path == "rotation") node.rotation = array_of<4>(values);
      if (c.path == "weights") node.weights = std::move(values);
    }
  }
  return poses;
}

std::vector<ScenePose> PoseFinder::targets() const {
  std::size_t most = 0;
  bool weighed = false;
  const auto look_at = [&](const GltfObject& object) {
    for (const GltfJson& w : object.array("weights")) weighed |= w.is_number() && w.get<double>() != 0;
  };
  for (std::size_t n = 0; n < root_.array("nodes").size(); ++n) look_at(root_.item("nodes", n));
  for (std::size_t m = 0; m < root_.array("meshes").size(); ++m) {
    const GltfObject mesh = root_.item("meshes", m);
    look_at(mesh);
    for (std::size_t p = 0; p < mesh.array("primitives").size(); ++p)
      most = std::max(most, mesh.item("primitives", p).array("targets").size());
  }
  check_count(double(most));
  std::vector<ScenePose> poses(weighed || most == 0 ? 1 : most);
  for (std::size_t i = 0; i < poses.size() && !weighed && most > 0; ++i) poses[i].target = i;
  return poses;
}

}  // namespace

std::vector<ScenePose> gltf_poses(const SceneFilePtr& file, const SceneOptions& options,
                                  std::optional<double> per_second) {
  return PoseFinder(file, options).find(per_second);
}

namespace {

double largest_of(const std::vector<double>& numbers) {
  double largest = 0;
  for (const double x : numbers) largest = std::max(largest, std::abs(x));
  return largest;
}

}  // namespace

Accessor GltfDocument::morphed(const GltfObject& primitive, const char* name, const Accessor& vectors,
                               const std::vector<double>& weights) {
  const std::size_t targets = std::min(primitive.array("targets").size(), weights.size());
  if (targets == 0) return vectors;
  check_memory("the vertices of a morph target", vectors.count * 3 * 3 * sizeof(double));
  std::vector<double> sums = read_numbers(bytes_, vectors);
  double largest = largest_of(sums);
  for (std::size_t t = 0; t < targets; ++t) {
    const GltfObject target = primitive.item("targets", t);
    if (weights[t] == 0 || !target.has(name)) continue;
    const Accessor changes = accessor(target.number(name), 3);
    if (changes.count != vectors.count)
      target.broken(fmt::format("moves {} of {} vertices", changes.count, vectors.count));
    const std::vector<double> by = read_numbers(bytes_, changes);
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += weights[t] * by[i];
    largest += std::abs(weights[t]) * largest_of(by);
  }
  return keep_vectors(sums, double(targets + 2) * 0x1p-52 * largest);  // each target adds two roundings
}

}  // namespace bp
