/* Makes a bounding proxy of two boxes with a gap between them, proves it, and writes it.
 *   cc proxy.c $(pkg-config --cflags --libs bp) -o proxy && ./proxy proxy.glb
 */
#include <bp/bp.h>
#include <stdio.h>

static int fail(const char* what) {
  fprintf(stderr, "%s: %s\n", what, bp_error_message());
  return 1;
}

/* The corners of a box, and its twelve triangles. */
static void put_box(double x, double* vertices, uint32_t* triangles, uint32_t first) {
  static const uint32_t faces[36] = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                     2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
  uint32_t i;
  for (i = 0; i < 8; ++i) {
    vertices[3 * i] = x + (i & 1);
    vertices[3 * i + 1] = (i >> 1) & 1;
    vertices[3 * i + 2] = (i >> 2) & 1;
  }
  for (i = 0; i < 36; ++i) triangles[i] = first + faces[i];
}

int main(int argc, char** argv) {
  double vertices[48];
  uint32_t triangles[72];
  const uint64_t faces = 100;
  bp_arrays arrays;
  bp_voxelize_options voxelize;
  bp_close_options closing;
  bp_mesh_options options;
  bp_scene* scene = NULL;
  bp_mesh* proxy = NULL;
  bp_verdict* verdict = NULL;
  bp_mesh_view view;
  bp_verdict_info info;

  put_box(0, vertices, triangles, 0);
  put_box(1.1, vertices + 24, triangles + 36, 8);
  bp_arrays_defaults(&arrays, sizeof arrays);
  arrays.vertices = vertices;
  arrays.vertex_count = 16;
  arrays.triangles = triangles;
  arrays.triangle_count = 24;
  if (bp_scene_from_arrays(&arrays, "two boxes", &scene) != BP_OK) return fail("scene");

  bp_voxelize_defaults(&voxelize, sizeof voxelize);
  voxelize.resolution = 64;
  bp_close_defaults(&closing, sizeof closing);
  if (bp_length_parse("5%", &closing.scale) != BP_OK) return fail("scale");
  bp_mesh_defaults(&options, sizeof options);
  options.faces = &faces;
  options.levels = 1;
  if (bp_proxy(scene, &voxelize, &closing, &options, NULL, &proxy) != BP_OK) return fail("proxy");

  if (bp_mesh_look(proxy, 0, &view, sizeof view) != BP_OK) return fail("view");
  printf("%lu vertices, %lu triangles\n", (unsigned long)view.vertex_count, (unsigned long)view.triangle_count);
  if (bp_check_mesh(proxy, 0, scene, NULL, NULL, &verdict) != BP_OK) return fail("check");
  if (bp_verdict_read_info(verdict, &info, sizeof info) != BP_OK) return fail("verdict");
  printf("%s", bp_verdict_text(verdict));
  if (argc > 1 && bp_mesh_save(proxy, 0, argv[1], 1) != BP_OK) return fail(argv[1]);

  bp_verdict_free(verdict);
  bp_mesh_free(proxy);
  bp_scene_free(scene);
  return info.answer == BP_PROVEN ? 0 : 1;
}
