#include "io/gltf/detail/gltf_skin.h"

#include <algorithm>
#include <cmath>

namespace bp {

namespace {

constexpr std::size_t kEach = 4;  // joints of a vertex in one pair of attributes
// Distance of the sum of a vertex' weights from 1: eight bytes, each rounded by half a step.
constexpr double kMostOffOne = 1.0 / 64;

void add(Affine& sum, double weight, const Affine& joint) {
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      RoundedSum number{sum.m[i][j], sum.off(i, j)};
      number.add_product(weight, 0, joint.m[i][j], joint.off(i, j));
      sum.m[i][j] = number.value;
      sum.off.set(i, j, number.bound());
    }
  }
}

/// Throws Unfit unless inverse bind matrix `k` is affine. Exporters round its last row.
void check_affine(const GltfObject& skin, const std::vector<double>& inverses, std::size_t k) {
  constexpr double kMostOff = 1e-5;
  constexpr std::array<double, 4> kLastRow{0, 0, 0, 1};
  for (std::size_t j = 0; j < 4 && !inverses.empty(); ++j) {
    if (!(std::abs(inverses[k * kMatrixNumbers + 4 * j + 3] - kLastRow[j]) <= kMostOff))
      skin.unfit("has an inverse bind matrix whose last row is not 0 0 0 1");
  }
}

}  // namespace

GltfSkin::GltfSkin(GltfDocument& doc, const GltfObject& skin, const std::vector<std::optional<Affine>>& places)
    : doc_(doc) {
  const std::size_t count = skin.array("joints").size();
  if (count == 0) skin.broken("has no joints");
  std::vector<double> inverses;  // sixteen numbers a joint, by columns
  if (skin.has("inverseBindMatrices")) {
    inverses = doc.numbers(skin.number("inverseBindMatrices"), kMatrixNumbers, "the joints of a skin");
    if (inverses.size() < count * kMatrixNumbers)
      skin.broken(fmt::format("has {} joints and {} matrices", count, inverses.size() / kMatrixNumbers));
  }
  for (std::size_t k = 0; k < count; ++k) {
    check_affine(skin, inverses, k);
    const std::uint64_t node = skin.index("joints", k);
    if (node >= places.size() || !places[node]) skin.broken(fmt::format("has the joint {} outside the scene", node));
    Affine bound;
    for (std::size_t i = 0; i < 3 && !inverses.empty(); ++i) {
      for (std::size_t j = 0; j < 4; ++j) bound.m[i][j] = inverses[k * kMatrixNumbers + 4 * j + i];
    }
    joints_.push_back(*places[node] * bound);
  }
}

std::vector<GltfSkin::Shares> GltfSkin::shares_of(const GltfObject& attributes, std::uint64_t vertices) const {
  std::vector<std::pair<std::string, std::string>> sets;
  for (;;) {
    std::pair names(fmt::format("JOINTS_{}", sets.size()), fmt::format("WEIGHTS_{}", sets.size()));
    if (!attributes.has(names.first.c_str()) || !attributes.has(names.second.c_str())) break;
    sets.push_back(std::move(names));
  }
  if (sets.empty()) attributes.broken("belong to a skin, and name no joints");
  doc_.check_memory("the joints and weights of vertices",
                    vertices * (2 * kEach * sets.size() + 2 * 3) * sizeof(double));
  std::vector<Shares> all;
  for (const auto& [joints, weights] : sets) all.push_back(read_shares(attributes, joints, weights, vertices));
  return all;
}

GltfSkin::Shares GltfSkin::read_shares(const GltfObject& attributes, const std::string& joints,
                                       const std::string& weights, std::uint64_t vertices) const {
  const Accessor numbers = doc_.accessor(attributes.number(joints.c_str()), kEach),
                 parts = doc_.accessor(attributes.number(weights.c_str()), kEach);
  if (numbers.type != ComponentType::u8 && numbers.type != ComponentType::u16)
    attributes.broken(fmt::format("have {} that are not unsigned integers of 8 or 16 bits", joints));
  if (numbers.normalized) attributes.unfit(fmt::format("have {} that are normalized", joints));
  if (numbers.count != vertices || parts.count != vertices) attributes.broken("have different counts");
  Shares shares{doc_.numbers(numbers, "the joints of vertices"), doc_.numbers(parts, "the weights of vertices")};
  for (const double joint : shares.joints) {
    if (joint >= double(joints_.size())) attributes.broken(fmt::format("name the joint {}", joint));
  }
  return shares;
}

Affine GltfSkin::blend(const std::vector<Shares>& shares, std::uint64_t vertex) const {
  Affine sum;
  sum.m = {};
  double all = 0;
  for (const Shares& s : shares) {
    for (std::uint64_t i = kEach * vertex; i < kEach * (vertex + 1); ++i) {
      if (s.weights[i] == 0) continue;
      add(sum, s.weights[i], joints_[std::size_t(s.joints[i])]);
      all += s.weights[i];
    }
  }
  if (all == 0) return joints_[std::size_t(shares[0].joints[kEach * vertex])];
  for (auto& row : sum.m) {
    for (double& x : row) x /= all;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 4; ++j) sum.off.set(i, j, sum.off(i, j) / all);
  }
  sum.blur(0x1p-48);  // rounding of a sum of at most 16 weights, and of the division
  return sum;
}

bool GltfSkin::are_whole(const GltfObject& attributes, std::uint64_t vertices) const {
  const std::vector<Shares> shares = shares_of(attributes, vertices);
  for (std::size_t set = 1; set < shares.size(); ++set) {  // many programs read the first one only
    const std::vector<double>& weights = shares[set].weights;
    if (std::any_of(weights.begin(), weights.end(), [](double weight) { return weight != 0; })) return false;
  }
  for (std::uint64_t v = 0; v < vertices; ++v) {
    double all = 0;
    for (const Shares& s : shares)
      for (std::uint64_t i = kEach * v; i < kEach * (v + 1); ++i) all += s.weights[i];
    if (!(std::abs(all - 1) <= kMostOffOne)) return false;
  }
  return true;
}

template <class Move>
Accessor GltfSkin::moved(const GltfObject& attributes, const Accessor& vectors, const Move& move) const {
  const std::vector<Shares> shares = shares_of(attributes, vectors.count);
  std::vector<double> numbers = doc_.numbers(vectors, "the vertices of a skin");
  double off = 0;
  for (std::uint64_t v = 0; v < vectors.count; ++v) {
    double* const p = &numbers[3 * v];
    const PlacedPoint to = move(blend(shares, v), Vec3d{p[0], p[1], p[2]});
    off = std::max(off, to.off);
    std::copy(to.point.begin(), to.point.end(), p);
  }
  return doc_.keep_vectors(numbers, off);
}

Accessor GltfSkin::points(const GltfObject& attributes, const Accessor& positions) const {
  return moved(attributes, positions, [&](const Affine& joints, const Vec3d& p) {
    const double largest = std::max({std::abs(p[0]), std::abs(p[1]), std::abs(p[2])});
    return joints.place(p, positions.off + (positions.normalized ? 0x1p-53 * largest : 0));
  });
}

Accessor GltfSkin::normals(const GltfObject& attributes, const Accessor& normals) const {
  return moved(attributes, normals, [](const Affine& joints, const Vec3d& n) {
    return PlacedPoint{joints.normal(n), 0};
  });
}

}  // namespace bp
