#include "io/place/crs_map.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <mutex>
#include <vector>

#include "io/scene/affine.h"
#include "lib/core/error.h"
#include "lib/core/vec3.h"

#ifdef BP_HAVE_PROJ
#include <proj.h>
#endif

namespace bp {

#ifndef BP_HAVE_PROJ

CrsOperation crs_operation(const std::string& crs, const Vec3d&) {
  fail(ErrorCode::failed, "{}: this build has no PROJ, which knows coordinate reference systems; build it with libproj",
       crs);
}

std::shared_ptr<const SceneMap> crs_map(const Placement& placement, const Vec3d& sample) {
  (void)crs_operation(placement.crs, sample);
  return {};
}

#else

namespace {

struct FreeProj {
  void operator()(PJ_CONTEXT* context) const { proj_context_destroy(context); }
  void operator()(PJ* pj) const { proj_destroy(pj); }
};
using ProjContext = std::unique_ptr<PJ_CONTEXT, FreeProj>;
using Proj = std::unique_ptr<PJ, FreeProj>;

ProjContext make_context() {
  ProjContext context(proj_context_create());
  proj_log_level(context.get(), PJ_LOG_NONE);  // messages go through Error
  return context;
}

/// Refuses everything but projected systems and ECEF: lengths in degrees are none. Returns whether heights are part of
/// the system.
bool check_kind(PJ_CONTEXT* context, const std::string& name) {
  Proj crs(proj_create(context, name.c_str()));
  if (!crs || proj_is_crs(crs.get()) == 0)
    fail(ErrorCode::bad_argument, "{}: PROJ knows no such coordinate reference system", name);
  bool has_heights = false;
  for (PJ_TYPE type = proj_get_type(crs.get());; type = proj_get_type(crs.get())) {
    const bool is_compound = type == PJ_TYPE_COMPOUND_CRS;
    if (!is_compound && type != PJ_TYPE_BOUND_CRS) break;
    has_heights = has_heights || is_compound;
    crs.reset(is_compound ? proj_crs_get_sub_crs(context, crs.get(), 0) : proj_get_source_crs(context, crs.get()));
  }
  const PJ_TYPE type = proj_get_type(crs.get());
  if (type != PJ_TYPE_PROJECTED_CRS && type != PJ_TYPE_GEOCENTRIC_CRS)
    fail(ErrorCode::bad_argument,
         "{}: its coordinates are not lengths; transform the scene to a projected system, or to EPSG:4978", name);
  const Proj axes(type == PJ_TYPE_PROJECTED_CRS ? proj_crs_get_coordinate_system(context, crs.get()) : nullptr);
  return has_heights || type == PJ_TYPE_GEOCENTRIC_CRS || (axes && proj_cs_get_axis_count(context, axes.get()) == 3);
}

/// Transforms points in place; those without an image become infinite.
void transform(PJ* operation, std::vector<Vec3d>& points) {
  if (points.empty()) return;
  double* const first = points.front().data();
  constexpr std::size_t kStride = sizeof(Vec3d);
  proj_errno_reset(operation);
  proj_trans_generic(operation, PJ_FWD, first, kStride, points.size(), first + 1, kStride, points.size(), first + 2,
                     kStride, points.size(), nullptr, 0, 0);
}

/// The one operation for a sample.
class Operation {
 public:
  Operation(std::string crs, const Vec3d& sample) : crs_(std::move(crs)), context_(make_context()) {
    facts_.has_heights = check_kind(context_.get(), crs_);
    const Proj found(proj_create_crs_to_crs(context_.get(), crs_.c_str(), "EPSG:4978", nullptr));
    const Proj all(found ? proj_normalize_for_visualization(context_.get(), found.get()) : nullptr);
    if (!all) fail(ErrorCode::bad_argument, "{}: PROJ has no way to ECEF", crs_);
    std::vector<Vec3d> point{sample};
    transform(all.get(), point);
    pj_.reset(proj_trans_get_last_used_operation(all.get()));
    if (!pj_ || !is_finite(point[0])) refuse(sample);
    facts_.sample = globe_place(point[0]);
    facts_.name = proj_pj_info(pj_.get()).description;
    facts_.accuracy = proj_coordoperation_get_accuracy(context_.get(), pj_.get());
    facts_.is_ballpark = proj_coordoperation_has_ballpark_transformation(context_.get(), pj_.get()) != 0;
    look_at_area();
  }

  [[nodiscard]] const CrsOperation& facts() const { return facts_; }

  /// Transforms points on any thread: each takes a copy of the operation while it is at work.
  void run(std::vector<Vec3d>& points) const {
    std::unique_ptr<Copy> copy = take();
    transform(copy->pj.get(), points);
    const std::lock_guard lock(mutex_);
    copies_.push_back(std::move(copy));
  }

  [[noreturn]] void refuse(const Vec3d& p) const {
    fail(ErrorCode::bad_input, "the point ({:.9g}, {:.9g}, {:.9g}) has no place in {}; is this the scene's system?",
         p[0], p[1], p[2], crs_);
  }

 private:
  struct Copy {
    ProjContext context;
    Proj pj;
  };

  [[nodiscard]] std::unique_ptr<Copy> take() const {
    const std::lock_guard lock(mutex_);
    if (!copies_.empty()) {
      std::unique_ptr<Copy> copy = std::move(copies_.back());
      copies_.pop_back();
      return copy;
    }
    auto copy = std::make_unique<Copy>(Copy{make_context(), nullptr});
    copy->pj.reset(proj_clone(copy->context.get(), pj_.get()));
    if (!copy->pj) fail(ErrorCode::failed, "{}: PROJ cannot copy its operation", crs_);
    return copy;
  }

  void look_at_area() {
    constexpr double kBeside = 0.5;  // degrees: areas are coarse
    const Proj crs(proj_create(context_.get(), crs_.c_str()));
    double west = 0, south = 0, east = 0, north = 0;
    const char* name = nullptr;
    if (proj_get_area_of_use(context_.get(), crs.get(), &west, &south, &east, &north, &name) == 0) return;
    if (east < west) east += 360;
    const double lat = facts_.sample.lat,
                 lon = facts_.sample.lon < west - kBeside ? facts_.sample.lon + 360 : facts_.sample.lon;
    if (lon <= east + kBeside && lat >= south - kBeside && lat <= north + kBeside) return;
    facts_.outside = name != nullptr ? name : "another";
  }

  const std::string crs_;
  ProjContext context_;
  Proj pj_;
  CrsOperation facts_;
  mutable std::mutex mutex_;
  mutable std::vector<std::unique_ptr<Copy> > copies_;
};

/// The vertices of triangles, most of them once: a vertex is looked for among those that came shortly before.
class FewPoints {
 public:
  FewPoints() : seen_(kSeen, kNone) {}

  [[nodiscard]] std::uint32_t add(const Vec3d& p) {
    std::uint64_t hash = 0;
    for (const double c : p) hash = (hash ^ std::bit_cast<std::uint64_t>(c)) * 0x9e3779b97f4a7c15;
    std::uint32_t& slot = seen_[hash >> (64 - kBits)];
    if (slot == kNone || points[slot] != p) {
      slot = std::uint32_t(points.size());
      points.push_back(p);
    }
    return slot;
  }

  std::vector<Vec3d> points;

 private:
  static constexpr int kBits = 14;
  static constexpr std::size_t kSeen = std::size_t(1) << kBits;
  static constexpr std::uint32_t kNone = ~std::uint32_t(0);
  std::vector<std::uint32_t> seen_;
};

class CrsMap final : public SceneMap {
 public:
  CrsMap(const Placement& placement, const Vec3d& sample)
      : operation_(placement.crs, sample), frame_(east_north_up(placement.place)), scene_up_(placement.scene_up) {
    constexpr double kStep = 16;  // of the scene's units: curvature and rounding are both below 1e-6 of it
    std::vector<Vec3d> points;
    for (std::size_t i = 0; i < 6; ++i) {
      points.push_back(sample);
      points.back()[i / 2] += i % 2 == 0 ? -kStep : kStep;
    }
    to_local(points);
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3d column = (1 / (2 * kStep)) * (points[2 * i + 1] - points[2 * i]);
      stretch_ = std::max(stretch_, kStretchVaries * length(column));
      for (std::size_t k = 0; k < 3; ++k) turn_.m[k][i] = column[k];
    }
  }

  void move(std::vector<TriangleD>& triangles, std::optional<UpAxis> told) const override {
    const UpAxis up = up_of(told);
    FewPoints few;
    std::vector<std::array<std::uint32_t, 3> > corners(triangles.size());
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      const TriangleD& t = triangles[i];
      if (!is_finite(t[0]) || !is_finite(t[1]) || !is_finite(t[2])) continue;
      for (std::size_t k = 0; k < 3; ++k) corners[i][k] = few.add(turned(t[k], up, UpAxis::z));
    }
    std::vector<Vec3d> local = few.points;
    to_local(local);
    for (std::size_t i = 0; i < local.size(); ++i) {
      if (!is_finite(local[i])) operation_.refuse(few.points[i]);
    }
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      TriangleD& t = triangles[i];
      if (!is_finite(t[0]) || !is_finite(t[1]) || !is_finite(t[2])) continue;
      for (std::size_t k = 0; k < 3; ++k) t[k] = local[corners[i][k]];
    }
  }

  [[nodiscard]] Vec3d normal(const Vec3d& n, std::optional<UpAxis> told) const override {
    return turn_.normal(turned(n, up_of(told), UpAxis::z));
  }
  [[nodiscard]] double stretch() const override { return stretch_; }
  [[nodiscard]] UpAxis up() const override { return UpAxis::z; }

 private:
  static constexpr double kStretchVaries = 1.1;  // of the sample's, anywhere in the system's area

  [[nodiscard]] UpAxis up_of(std::optional<UpAxis> told) const { return scene_up_.value_or(told.value_or(UpAxis::z)); }

  void to_local(std::vector<Vec3d>& points) const {
    operation_.run(points);
    for (Vec3d& p : points) {
      const Vec3d from{p[0] - frame_[12], p[1] - frame_[13], p[2] - frame_[14]};
      for (std::size_t i = 0; i < 3; ++i)
        p[i] = frame_[4 * i] * from[0] + frame_[4 * i + 1] * from[1] + frame_[4 * i + 2] * from[2];
    }
  }

  const Operation operation_;
  const GlobeMatrix frame_;
  const std::optional<UpAxis> scene_up_;
  Affine turn_;
  double stretch_ = 0;
};

}  // namespace

CrsOperation crs_operation(const std::string& crs, const Vec3d& sample) {
  return Operation(crs, sample).facts();
}

std::shared_ptr<const SceneMap> crs_map(const Placement& placement, const Vec3d& sample) {
  return std::make_shared<CrsMap>(placement, sample);
}

#endif

}  // namespace bp
