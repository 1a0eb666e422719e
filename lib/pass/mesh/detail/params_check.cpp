#include "lib/pass/mesh/detail/params_check.h"

#include "lib/core/error.h"

namespace bp {

void check_params(const MeshParams& params) {
  for (std::size_t i = 1; i < params.faces.size(); ++i) {
    if (params.faces[i] < params.faces[i - 1]) continue;
    fail(ErrorCode::bad_argument, "{} faces after {}: each level must have fewer than the one before", params.faces[i],
         params.faces[i - 1]);
  }
  if (params.mode == MeshMode::inside && params.enclose == Enclose::scene)
    fail(ErrorCode::bad_argument, {Remedy::enclose_closing, Remedy::enclose_input},
         "a proxy inside a scene is kept there by voxels, not by triangles");
  if (params.mode == MeshMode::fit && params.enclose == Enclose::input)
    fail(ErrorCode::bad_argument, {Remedy::enclose_closing},
         "a fit is drawn to the closing or to scene files, not to the voxels of the input");
  if (params.mode == MeshMode::fit && params.volume_ratio != 0)
    fail(ErrorCode::bad_argument, {Remedy::no_volume}, "a fit encloses nothing, and has no limit on its volume");
  if (!(params.error_world >= 0)) fail(ErrorCode::bad_argument, "an error of {} is below 0", params.error_world);
  if (!(params.volume_ratio >= 0))
    fail(ErrorCode::bad_argument, "a volume ratio of {} is below 0", params.volume_ratio);
  if (!(params.edge_factor >= 0))
    fail(ErrorCode::bad_argument, "an edge length of {} times the scale is below 0", params.edge_factor);
  if (params.least_part < 0 || params.least_part > 1)
    fail(ErrorCode::bad_argument, "the least part is a share of the largest, from 0 to 1, not {}", params.least_part);
  if (params.mode != MeshMode::inside && params.least_part != 0)
    fail(ErrorCode::bad_argument, "only a proxy inside a scene may leave parts out");
  if (params.mode == MeshMode::inside && params.volume_ratio > 1)
    fail(ErrorCode::bad_argument, "a volume ratio of {} is above 1, and what lies inside is no larger",
         params.volume_ratio);
  if (params.mode == MeshMode::bounding && params.volume_ratio != 0 && params.volume_ratio < 1)
    fail(ErrorCode::bad_argument, "a volume ratio of {} is below 1, and a proxy is no smaller than what it encloses",
         params.volume_ratio);
}

void check_fill(const MeshParams& params, const StreamHeader& header) {
  const bool inside = header.fill == FillMode::inside;
  if (params.mode == MeshMode::inside && !inside) {
    fail(ErrorCode::bad_input, {Remedy::fill_inside},
         "the voxels are those that the scene touches, and a proxy inside needs those of its inside");
  }
  if (params.mode == MeshMode::inside || !inside) return;
  fail(ErrorCode::bad_input, {Remedy::mode_inside}, "the stream holds the inside of the scene only");
}

}  // namespace bp
