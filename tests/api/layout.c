/* Prints the size of each struct and the place of each member, for comparison with those of the Python module. */
#include <bp/bp_experimental.h>
#include <stdio.h>

#define SIZE(type) printf(#type " %lu\n", (unsigned long)sizeof(type))
#define MEMBER(type, name) printf(#type "." #name " %lu\n", (unsigned long)offsetof(type, name))

int main(void) {
  SIZE(bp_length);
  SIZE(bp_run);
  MEMBER(bp_run, device);
  MEMBER(bp_run, stop);
  SIZE(bp_arrays);
  MEMBER(bp_arrays, triangle_stride);
  MEMBER(bp_arrays, up);
  SIZE(bp_scene_info);
  MEMBER(bp_scene_info, max);
  SIZE(bp_voxelize_options);
  MEMBER(bp_voxelize_options, up);
  SIZE(bp_close_options);
  MEMBER(bp_close_options, no_scale);
  SIZE(bp_grid_info);
  MEMBER(bp_grid_info, scale);
  MEMBER(bp_grid_info, voxels);
  MEMBER(bp_grid_info, rules);
  SIZE(bp_mesh_options);
  MEMBER(bp_mesh_options, quads);
  SIZE(bp_mesh_view);
  MEMBER(bp_mesh_view, quad_count);
  SIZE(bp_mesh_info);
  MEMBER(bp_mesh_info, enclosed);
  SIZE(bp_check_options);
  MEMBER(bp_check_options, no_distances);
  SIZE(bp_verdict_info);
  MEMBER(bp_verdict_info, proxy_to_scene);
  SIZE(bp_hulls_options);
  MEMBER(bp_hulls_options, corners);
  SIZE(bp_levels_options);
  MEMBER(bp_levels_options, errors);
  MEMBER(bp_levels_options, scale);
  MEMBER(bp_levels_options, enclose);
  SIZE(bp_occluder_options);
  MEMBER(bp_occluder_options, no_scale);
  SIZE(bp_cage_options);
  MEMBER(bp_cage_options, symmetry);
  SIZE(bp_bind_options);
  MEMBER(bp_bind_options, carry_outside);
  return 0;
}
