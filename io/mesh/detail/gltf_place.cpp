#include "io/mesh/detail/gltf_place.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "io/mesh/detail/mesh_writers.h"
#include "lib/core/error.h"

namespace bp {

namespace {

struct Extent {
  LatticeCoord lo, hi;
  explicit Extent(const LatticeMesh& mesh) : lo(mesh.vertices.front()), hi(lo) {
    for (const LatticeCoord v : mesh.vertices) {
      for (int i = 0; i < 3; ++i) {
        lo[i] = std::min(lo[i], v[i]);
        hi[i] = std::max(hi[i], v[i]);
      }
    }
  }
};

/// Returns the lowest set bit of a number, as a number; infinite for 0.
double last_bit(double x) {
  if (x == 0) return HUGE_VAL;
  int exponent = 0;
  const auto mantissa = std::uint64_t(std::ldexp(std::frexp(std::abs(x), &exponent), 53));
  return std::ldexp(1.0, exponent - 53 + std::countr_zero(mantissa));
}

/// Returns whether a float holds the number with all bits. Denormal floats are not taken: programs may set them to
/// zero.
bool is_plain_float(double x) {
  return x == 0 || (double(float(x)) == x && std::isnormal(float(x)));
}

/// Returns the number with the fewest bits from which both ends are at most `reach` away; it is near their middle.
/// Empty if none of these is a multiple of `step`.
std::optional<double> few_bits_near(double lo, double hi, double reach, double step) {
  int exponent = 0;
  (void)std::frexp(std::max(std::abs(lo), std::abs(hi)), &exponent);
  for (double unit = std::ldexp(1.0, exponent + 1); unit >= step; unit /= 2) {
    const double x = std::nearbyint((lo / 2 + hi / 2) / unit) * unit;
    if (hi - x <= reach && x - lo <= reach) return x + 0.0;  // -0 becomes 0
  }
  return {};
}

template <class Test>
bool all_vertices(std::span<const LatticeMesh* const> meshes, const Vec3d& origin, const Test& test) {
  return std::all_of(meshes.begin(), meshes.end(), [&](const LatticeMesh* mesh) {
    return std::all_of(mesh->vertices.begin(), mesh->vertices.end(),
                       [&](LatticeCoord v) { return test(moved_exactly(mesh->frame, mesh->frame.world(v), origin)); });
  });
}

/// Returns an offset whose subtraction leaves floats and is exact: coordinates and offset are multiples of the last bit
/// of the lattice, and the difference is at most 2^24 times this bit. It lies within two sizes of the meshes, so that a
/// node turns about a near point.
std::optional<Vec3d> likely_offset(std::span<const LatticeMesh* const> meshes, const Vec3d& origin) {
  constexpr double kSizes = 2;
  Bounds3d bounds;
  double step = HUGE_VAL;
  for (const LatticeMesh* mesh : meshes) {
    const Extent extent(*mesh);
    bounds.add(moved_exactly(mesh->frame, mesh->frame.world(extent.lo), origin));
    bounds.add(moved_exactly(mesh->frame, mesh->frame.world(extent.hi), origin));
    step = std::min(step, last_bit(mesh->frame.voxel / kLatticePerVoxel));
  }
  Vec3d offset;
  for (std::size_t i = 0; i < 3; ++i) {
    const double least = std::min(step, last_bit(origin[i]));
    const double reach = std::min(double(kFloatInteger) * least, kSizes * bounds.longest_side());
    const auto x = few_bits_near(bounds.min[i], bounds.max[i], reach, least);
    if (!x) return {};
    offset[i] = *x;
  }
  return offset;
}

LatticeCoord centre_of(const LatticeMesh& mesh, const std::string& file) {
  const Extent extent(mesh);
  LatticeCoord centre;
  for (int i = 0; i < 3; ++i) {
    const std::int64_t lo = extent.lo[i], hi = extent.hi[i];
    centre[i] = lo + (hi - lo) / 2;
    if (hi - centre[i] <= kFloatInteger && centre[i] - lo <= kFloatInteger) continue;
    fail(ErrorCode::bad_argument, {Remedy::ply_format, Remedy::larger_voxels},
         "{}: the mesh spans {} voxels, and glTF's 32-bit floats hold 2^19 of them exactly", file,
         (hi - lo) / kLatticePerVoxel);
  }
  return centre;
}

}  // namespace

std::optional<Vec3d> gltf_offset(std::span<const LatticeMesh* const> meshes, const Vec3d& origin) {
  const auto fits = [&](const Vec3d& offset) {
    return all_vertices(meshes, origin, [&](const Vec3d& p) {
      return is_plain_float(p[0] - offset[0]) && is_plain_float(p[1] - offset[1]) && is_plain_float(p[2] - offset[2]);
    });
  };
  if (fits({})) return Vec3d{};
  const std::optional<Vec3d> offset = likely_offset(meshes, origin);
  return offset && fits(*offset) ? offset : std::nullopt;
}

GltfPlace::GltfPlace(const LatticeMesh& mesh, const Vec3d& origin, const std::optional<Vec3d>& offset,
                     const std::string& file)
    : frame_(mesh.frame), origin_(origin), offset_(offset), centre_(offset ? LatticeCoord{} : centre_of(mesh, file)) {}

std::array<float, 3> GltfPlace::operator()(LatticeCoord v) const {
  Vec3d p;
  if (offset_) {
    p = moved_exactly(frame_, frame_.world(v), origin_);
    for (std::size_t i = 0; i < 3; ++i) p[i] -= (*offset_)[i];
  } else {
    const LatticeCoord d = v - centre_;
    p = {double(d.x), double(d.y), double(d.z)};
  }
  const Vec3d turned = to_y_up(frame_.up)(p);
  return {float(turned[0]), float(turned[1]), float(turned[2])};
}

void GltfPlace::place(GltfOutJson& node) const {
  const Vec3d at = offset_ ? *offset_ : moved_exactly(frame_, frame_.world(centre_), origin_);
  if (at != Vec3d{}) node["translation"] = to_y_up(frame_.up)(at);
  if (offset_) return;
  const double step = frame_.voxel / kLatticePerVoxel;
  node["scale"] = GltfOutJson::array({step, step, step});
}

}  // namespace bp
