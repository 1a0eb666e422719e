#include "io/scene/raw_source.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "io/scene/instanced_scene.h"
#include "lib/core/error.h"
#include "lib/core/vec3.h"

namespace bp {

bool PolygonSource::next(RawBatch& batch) {
  batch.bad_faces = 0;
  batch.inner_edges.clear();
  return read(batch.triangles, batch.colored ? &batch.colors : nullptr, &batch);
}

bool PolygonSource::read(std::vector<TriangleD>& out, std::vector<TriangleColors>* colors, RawBatch* rest) {
  out.clear();
  if (colors != nullptr) colors->clear();
  while (out.size() < kBatch) {
    if (next_ == end_ && !open_face()) break;
    for (; next_ < end_ && out.size() < kBatch; ++next_) {
      const CutTriangle t = cut_[next_];
      out.push_back(cut_.places(t, [&](std::size_t k) { return vertex(corners_[k]); }));
      if (colors != nullptr)
        colors->push_back({corner_color(corners_[t[0]]), corner_color(corners_[t[1]]), corner_color(corners_[t[2]])});
      if (rest != nullptr) add_rest(*rest, out.size() - 1, t);
    }
  }
  return !out.empty();
}

/// Opens the next good face; returns false at the end.
bool PolygonSource::open_face() {
  for (; next_face(corners_); ++bad_faces_) {
    if (!good_face()) continue;
    cut_.cut(corners_.size(), [&](std::size_t k) { return vertex(corners_[k]); });
    next_ = 0;
    end_ = cut_.triangles();
    return true;
  }
  return false;
}

void PolygonSource::add_rest(RawBatch& rest, std::size_t triangle, const CutTriangle& corners) {
  if (corners_.size() > 3) {
    rest.inner_edges.resize(triangle + 1);
    rest.inner_edges.back() = cut_.inner_edges(next_);
  }
  if (!rest.textured) return;
  TriangleTexture t;
  t.material = face_material();
  t.normals = {corner_normal(corners[0]), corner_normal(corners[1]), corner_normal(corners[2])};
  if (t.material == TriangleTexture::kNoMaterial && t.normals[0] == 0) return;
  if (t.material != TriangleTexture::kNoMaterial)
    t.uv = {corner_uv(corners[0]), corner_uv(corners[1]), corner_uv(corners[2])};
  rest.textures.resize(triangle + 1);
  rest.textures.back() = t;
}

void PolygonSource::rewind() {
  next_ = end_ = 0;
  bad_faces_ = 0;
  rewind_faces();
}

bool PolygonSource::good_face() const {
  if (corners_.size() < 3) return false;
  const std::uint64_t n = vertex_count();
  for (const std::uint64_t corner : corners_) {
    if (corner >= n) return false;
  }
  return true;
}

void normalize(TriangleD& t) {
  for (Vec3d& p : t) {
    for (double& c : p) {
      if (std::abs(c) < 1e-90) c = 0;
    }
  }
}

void drop_signs_of_zeros(TriangleD& t) {
  for (Vec3d& p : t) {
    for (double& c : p) c += 0.0;
  }
}

void check_document(const SceneOptions& options, const std::string& name, const char* what, std::uint64_t bytes,
                    std::uint64_t left, std::uint64_t later) {
  if (options.document.bytes == 0 || bytes <= left) return;
  const std::uint64_t held = options.document.bytes - std::min(options.document.bytes, left);
  throw NeedsMemory(fmt::format("{}: {}", name, what), bytes, left, options.document.limit_for(held + bytes + later),
                    {Remedy::split_scene});
}

std::uint64_t most_described(const SceneOptions& options) {
  return 2 * options.memory_bytes - options.memory_bytes / 8;
}

std::uint64_t limit_of_description(std::uint64_t bytes, const SceneOptions& options) {
  const std::uint64_t most = most_described(options);
  if (options.document.bytes == 0 || bytes <= most) return 0;
  // The document's memory and the vertices' memory grow with the limit.
  const double document = double(options.document.bytes) / double(std::max<std::uint64_t>(1, most));
  return options.document.limit_with(std::uint64_t(std::ceil(double(bytes - most) * document)));
}

/// Leaves next to no memory. Descriptions and vertices keep the proportion of their shares, which
/// limit_of_description() needs. The limit is the one at which the step has so little: half of such a small limit is
/// shared out.
SceneOptions without_memory(SceneOptions options) {
  constexpr std::uint64_t kReader = 16;
  const double documents = double(options.document.bytes) / double(std::max<std::uint64_t>(1, options.memory_bytes));
  options.document.bytes = std::uint64_t(std::max(1.0, std::ceil(documents * double(kReader))));
  const double rest = double(options.document.bytes) / std::max(options.document.share, 1e-9);
  options.document.limit.bytes = 2 * std::uint64_t(std::ceil(rest));
  options.memory_bytes = kReader;
  return options;
}

std::string temp_dir_of(const SceneOptions& options) {
  if (!options.temp_dir.empty()) return options.temp_dir;
  const char* const set = std::getenv("TMPDIR");
  return set != nullptr && *set != 0 ? set : "/tmp";
}

}  // namespace bp
