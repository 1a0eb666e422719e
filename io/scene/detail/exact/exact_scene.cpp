#include "io/scene/detail/exact/exact_scene.h"

#include <assimp/mesh.h>
#include <assimp/scene.h>

#include <charconv>
#include <cmath>

namespace bp {

namespace {

// The relative difference that float32 explains: importers round, and compute in float32: 2^-24 of a number each time.
constexpr double kExplained = 0x1p-18;

bool is_near(double exact, float rounded, double size) {
  if (!std::isfinite(rounded)) return !std::isfinite(exact) || std::abs(exact) > 1e38;
  return std::abs(exact - double(rounded)) <= kExplained * size;
}

double size_of(const Vec3d& p) {
  return std::max({std::abs(p[0]), std::abs(p[1]), std::abs(p[2])});
}

bool fits(const ExactMesh& exact, const aiMesh& mesh) {
  if (exact.positions.size() != mesh.mNumVertices) return false;
  for (std::size_t i = 0; i < exact.positions.size(); ++i) {
    const Vec3d& p = exact.positions[i];
    const aiVector3D& q = mesh.mVertices[i];
    const double size = size_of(p);
    if (!is_near(p[0], q.x, size) || !is_near(p[1], q.y, size) || !is_near(p[2], q.z, size)) return false;
  }
  return true;
}

}  // namespace

const ExactMesh* exact_mesh(const ExactScene& scene, const aiMesh& mesh, std::size_t i) {
  if (i < scene.meshes.size() && scene.meshes[i].name.empty())
    return fits(scene.meshes[i], mesh) ? &scene.meshes[i] : nullptr;
  const ExactMesh* found = nullptr;
  for (const ExactMesh& exact : scene.meshes) {
    if (exact.name.empty() || exact.name != mesh.mName.C_Str() || !fits(exact, mesh)) continue;
    if (found != nullptr && found->positions != exact.positions) return nullptr;
    found = &exact;
  }
  return found;
}

bool is_rounded(const ExactNode& exact, const aiNode& node) {
  const aiMatrix4x4& m = node.mTransformation;
  const std::array<std::array<float, 4>, 3> rounded{
      {{m.a1, m.a2, m.a3, m.a4}, {m.b1, m.b2, m.b3, m.b4}, {m.c1, m.c2, m.c3, m.c4}}};
  double largest = exact.largest, farthest = exact.farthest;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) largest = std::max(largest, std::abs(exact.transform.m[i][j]));
    farthest = std::max(farthest, std::abs(exact.transform.m[i][3]));
  }
  bool near = exact.children.size() == node.mNumChildren;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 4; ++j)
      near = near && is_near(exact.transform.m[i][j], rounded[i][j], j == 3 ? farthest : largest);
  }
  return near;
}

std::optional<std::vector<double>> only_numbers_in(std::string_view text) {
  std::vector<double> numbers;
  const char *at = text.data(), *const end = at + text.size();
  const auto is_blank = [](char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; };
  for (;;) {
    while (at != end && is_blank(*at)) ++at;
    if (at == end) return numbers;
    if (*at == '+') ++at;
    double value = 0;
    const auto [next, fault] = std::from_chars(at, end, value);
    if (fault == std::errc::result_out_of_range && next != at)
      value = 0;  // tiny, or too large: then nothing fits
    else if (fault != std::errc())
      return {};
    numbers.push_back(value);
    at = next;
    if (at != end && !is_blank(*at)) return {};
  }
}

}  // namespace bp
