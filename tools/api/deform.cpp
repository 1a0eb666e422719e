// Cages, and points in them, as bpdeform binds and moves them.
#include <cmath>
#include <cstring>

#include "io/deform/weight_file.h"
#include "lib/core/parallel.h"
#include "lib/deform/coordinates.h"
#include "tools/api/array_scene.h"
#include "tools/api/call.h"
#include "tools/api/include/bp/bp_experimental.h"
#include "tools/api/mesh.h"
#include "tools/api/structs.h"

/// The coordinates of points, in blocks of `block` points.
struct bp_weights {
  std::unique_ptr<bp::CageCoordinates> coordinates;
  std::vector<bp::Vec3d> cage, points;
  std::vector<bp::WeightBlock> blocks;
  std::size_t block = 0;
};

namespace bp::api {

namespace {

using Place = CoordinateRows::Place;
constexpr std::size_t kMostPoints = 0xffffffff;

/// Returns the cage with its vertices in the caller's order.
IndexedMesh cage_of(const bp_arrays* given) {
  bp_arrays defaults{};
  defaults.triangle_type = BP_UINT32;
  bp_arrays a = take_struct(&needed(given, "cage"), defaults, "bp_arrays");
  a.borrow = 1;
  return ArrayScene(a).mesh_as_given();
}

/// Finds the first of the points that will not do.
void check_places(const std::vector<std::vector<Place>>& places, std::size_t block, bool carry_outside,
                  const std::vector<Vec3d>& points) {
  std::size_t outside = 0, first = 0;
  for (std::size_t b = 0; b < places.size(); ++b) {
    for (std::size_t i = 0; i < places[b].size(); ++i) {
      const std::size_t point = b * block + i;
      if (places[b][i] == Place::nowhere) fail(ErrorCode::bad_input, "point {} is not finite", point);
      if (places[b][i] == Place::outside && outside++ == 0) first = point;
    }
  }
  if (outside == 0 || carry_outside) return;
  const Vec3d& p = points[first];
  fail(ErrorCode::bad_input,
       "points outside the cage: {} of {}, the first is number {} at {:.6g},{:.6g},{:.6g}; use a larger cage, or set "
       "carry_outside",
       outside, points.size(), first, p[0], p[1], p[2]);
}

bp_weights bind(const bp_arrays* cage, const double* points, std::size_t count, const bp_bind_options* given,
                Call& call) {
  const bp_bind_options o = take_struct(given, bp_bind_options{}, "bp_bind_options");
  const auto kind = choice<CoordinateKind>(o.kind, 3, "kind");
  const bool carry = o.carry_outside != 0;
  if (count > 0) (void)needed(points, "points");
  if (count > kMostPoints) fail(ErrorCode::bad_argument, "count: {} points are more than 2^32 - 1", count);
  call.begin("binding");
  bp_weights weights;
  const IndexedMesh mesh = cage_of(cage);
  weights.cage = mesh.vertices;
  weights.coordinates = std::make_unique<CageCoordinates>(make_cage(mesh, "the cage"), kind);
  weights.points.resize(count);
  if (count > 0) std::memcpy(weights.points.data(), points, count * sizeof(Vec3d));
  const std::size_t columns = weights.coordinates->columns();
  weights.block = points_of_block(columns);
  const std::size_t blocks = (count + weights.block - 1) / weights.block;
  weights.blocks.resize(blocks);
  std::vector<std::vector<Place>> places(blocks);
  parallel_for(std::int64_t(blocks), [&](std::int64_t b) {
    const std::size_t first = std::size_t(b) * weights.block, n = std::min(weights.block, count - first);
    WeightBlock& out = weights.blocks[std::size_t(b)];
    out = WeightBlock(n, columns);
    places[std::size_t(b)].resize(n);
    CoordinateRows rows;
    weigh_points(*weights.coordinates, std::span(weights.points).subspan(first, n), carry, rows, out,
                 places[std::size_t(b)]);
  });
  check_places(places, weights.block, carry, weights.points);
  return weights;
}

std::vector<Vec3d> moves_of(const bp_weights& weights, const double* moved) {
  std::vector<Vec3d> moves(weights.cage.size());
  for (std::size_t i = 0; i < moves.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double place = moved[3 * i + k];
      if (!std::isfinite(place)) fail(ErrorCode::bad_input, "vertex {} of the moved cage is not finite", i);
      moves[i][k] = place - weights.cage[i][k];
    }
  }
  return moves;
}

void apply(const bp_weights& weights, const double* moved, double* out) {
  const std::vector<Vec3d> moves = weights.coordinates->moves_of_columns(moves_of(weights, &needed(moved, "moved")));
  if (!weights.points.empty()) (void)needed(out, "the result");
  parallel_for(std::int64_t(weights.blocks.size()), [&](std::int64_t b) {
    const WeightBlock& block = weights.blocks[std::size_t(b)];
    std::vector<Vec3d> shifts(block.points);
    add_moves(block, moves, shifts);
    for (std::size_t i = 0; i < block.points; ++i) {
      const std::size_t point = std::size_t(b) * weights.block + i;
      for (std::size_t k = 0; k < 3; ++k) out[3 * point + k] = weights.points[point][k] + shifts[i][k];
    }
  });
}

}  // namespace

}  // namespace bp::api

using namespace bp::api;

extern "C" {

bp_status bp_cage(const bp_grid* grid, uint64_t faces, const bp_run* run, bp_mesh** out) {
  return guarded_result(run, out, [&](Call& call) {
    bp_mesh_options options{};
    options.size = sizeof options;
    options.faces = &faces;
    options.levels = 1;
    options.mode = BP_MODE_BOUNDING;
    return bp_mesh{mesh(*needed(grid, "grid").grid, &options, call, true), {}};
  });
}

void bp_bind_defaults(bp_bind_options* options, size_t size) {
  put_defaults(options, size, bp_bind_options{});
}

bp_status bp_bind(const bp_arrays* cage, const double* points, size_t count, const bp_bind_options* options,
                  const bp_run* run, bp_weights** out) {
  return guarded_result(run, out, [&](Call& call) { return bind(cage, points, count, options, call); });
}

bp_status bp_weights_apply(const bp_weights* weights, const double* moved, const bp_run* run, double* out) {
  return guarded_call(run, [&](Call& call) {
    call.begin("moving points");
    apply(needed(weights, "weights"), moved, out);
  });
}

size_t bp_weights_cage_count(const bp_weights* weights) {
  return weights == nullptr ? 0 : weights->cage.size();
}

size_t bp_weights_count(const bp_weights* weights) {
  return weights == nullptr ? 0 : weights->points.size();
}

void bp_weights_free(bp_weights* weights) {
  delete weights;
}

}  // extern "C"
