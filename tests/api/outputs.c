/* Results by a sink have the bytes of files, and a sink ends a call. Strict C99.
 *   bp_outputs FOLDER */
#include <bp/bp_experimental.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The bytes of files that a sink has got. */
typedef struct taken {
  char names[8][64];
  unsigned char* bytes[8];
  size_t sizes[8], files, most; /* most: bytes after which the sink ends the call */
} taken;

static void need(int holds, const char* what) {
  if (holds) return;
  fprintf(stderr, "FAILED: %s; the last message: %s\n", what, bp_error_message());
  exit(1);
}

static int take(void* user, const char* file, const void* bytes, size_t count) {
  taken* to = (taken*)user;
  const char* name = file == NULL ? "" : file;
  size_t i = 0;
  while (i < to->files && strcmp(to->names[i], name) != 0) ++i;
  need(i < 8 && strlen(name) < 64, "few files, with short names");
  if (i == to->files) {
    strcpy(to->names[i], name);
    ++to->files;
  }
  if (to->sizes[i] + count > to->most) return 1;
  to->bytes[i] = (unsigned char*)realloc(to->bytes[i], to->sizes[i] + count);
  need(to->bytes[i] != NULL, "memory");
  memcpy(to->bytes[i] + to->sizes[i], bytes, count);
  to->sizes[i] += count;
  return 0;
}

static void start(taken* to, size_t most) {
  memset(to, 0, sizeof *to);
  to->most = most;
}

/* Compares file `i` with the one on disk, and forgets it. */
static void compare(taken* to, size_t i, const char* path) {
  FILE* file = fopen(path, "rb");
  size_t k;
  need(file != NULL && i < to->files && to->sizes[i] > 0, path);
  for (k = 0; k < to->sizes[i]; ++k) need(fgetc(file) == to->bytes[i][k], path);
  need(fgetc(file) == EOF, path);
  fclose(file);
  free(to->bytes[i]);
}

static bp_scene* make_scene(void) {
  static const double vertices[18] = {1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1};
  static const uint32_t triangles[24] = {0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5};
  bp_arrays arrays;
  bp_scene* scene = NULL;
  bp_arrays_defaults(&arrays, sizeof arrays);
  arrays.vertices = vertices;
  arrays.vertex_count = 6;
  arrays.triangles = triangles;
  arrays.triangle_count = 8;
  need(bp_scene_from_arrays(&arrays, "octahedron", &scene) == BP_OK, "scene");
  return scene;
}

/* A grid, its field and its closing. */
static bp_grid* check_grids(const bp_scene* scene, const char* path) {
  const char* rules = "{\"base\": 0.05, \"rules\": [{\"at\": [1, 0, 0], \"radius\": 0.2, \"scale\": 0.15}]}";
  const double points[6] = {1, 0, 0, -1, 0, 0};
  double scales[2] = {0, 0};
  bp_voxelize_options voxels;
  bp_grid *plain = NULL, *ruled = NULL, *closed = NULL;
  bp_grid_info info;
  taken sunk;
  bp_voxelize_defaults(&voxels, sizeof voxels);
  voxels.resolution = 48;
  need(bp_voxelize(scene, &voxels, NULL, &plain) == BP_OK, "voxels");
  need(bp_grid_read_info(plain, &info, sizeof info) == BP_OK && info.rules[0] == 0, "a grid without a field");
  need(bp_grid_scales(plain, points, 2, NULL, scales) == BP_BAD_ARGUMENT, "no scales without a field");
  need(bp_field(plain, "{", NULL, &ruled) == BP_BAD_INPUT, "rules that are none");
  need(bp_field(plain, rules, NULL, &ruled) == BP_OK, "field");
  need(bp_grid_read_info(ruled, &info, sizeof info) == BP_OK && strstr(info.rules, "0.15") != NULL, "rules");
  need(!info.has_closing, "a field is no closing");
  need(bp_grid_scales(ruled, points, 2, NULL, scales) == BP_OK && scales[0] == 0.15 && scales[1] == 0.05, "scales");
  need(bp_close(ruled, NULL, NULL, &closed) == BP_OK, "closing by the field");
  need(bp_grid_read_info(closed, &info, sizeof info) == BP_OK && info.has_closing && info.rules[0] == '{', "closing");
  start(&sunk, (size_t)-1);
  need(bp_grid_save(closed, path, 1, NULL) == BP_OK, path);
  need(bp_grid_write(closed, take, &sunk, NULL) == BP_OK && sunk.files == 1 && sunk.names[0][0] == 0, "stream");
  compare(&sunk, 0, path);
  start(&sunk, 0);
  need(bp_grid_write(closed, take, &sunk, NULL) == BP_CANCELLED, "a sink ends a call");
  need(bp_grid_write(closed, NULL, NULL, NULL) == BP_BAD_ARGUMENT, "no sink");
  bp_grid_free(plain);
  bp_grid_free(ruled);
  return closed;
}

static void check_meshes(const bp_grid* grid, const char* folder) {
  static const char* const formats[5] = {"glb", "gltf", "ply", "obj", "stl"};
  const uint64_t faces = 60;
  bp_mesh_options options;
  bp_mesh* mesh = NULL;
  char path[512];
  taken sunk;
  int i;
  bp_mesh_defaults(&options, sizeof options);
  options.faces = &faces;
  options.levels = 1;
  need(bp_mesh_make(grid, &options, NULL, &mesh) == BP_OK, "mesh");
  for (i = 0; i < 5; ++i) {
    start(&sunk, (size_t)-1);
    snprintf(path, sizeof path, "%s/sunk.%s", folder, formats[i]);
    need(bp_mesh_save(mesh, 0, path, 1) == BP_OK, path);
    need(bp_mesh_write(mesh, 0, formats[i], take, &sunk) == BP_OK && sunk.files == 1, formats[i]);
    compare(&sunk, 0, path);
  }
  start(&sunk, (size_t)-1);
  need(bp_mesh_write(mesh, 0, "step", take, &sunk) == BP_BAD_ARGUMENT && sunk.files == 0, "an unknown format");
  need(bp_mesh_write(mesh, 0, "mesh.glb", take, &sunk) == BP_BAD_ARGUMENT && sunk.files == 0, "a name in the place of a format");
  need(bp_mesh_write(mesh, 1, "glb", take, &sunk) == BP_BAD_ARGUMENT && sunk.files == 0, "no such mesh");
  need(bp_levels_write(mesh, "x", take, &sunk) == BP_BAD_ARGUMENT && sunk.files == 0, "a proxy is no levels");
  bp_mesh_free(mesh);
}

static void check_levels(const bp_scene* scene, const char* folder) {
  const uint64_t faces[2] = {60, 12};
  bp_levels_options options;
  bp_mesh* levels = NULL;
  char path[512];
  taken sunk;
  size_t i;
  bp_levels_defaults(&options, sizeof options);
  options.faces = faces;
  options.face_count = 2;
  need(bp_levels(scene, NULL, &options, NULL, &levels) == BP_OK, "levels");
  need(bp_levels_save(levels, folder, "sunk_levels", 1) == BP_OK, folder);
  start(&sunk, (size_t)-1);
  need(bp_levels_write(levels, "sunk_levels", take, &sunk) == BP_OK, "the files of levels");
  need(sunk.files == bp_mesh_count(levels) + 1, "a file for each level, and one with all");
  for (i = 0; i < sunk.files; ++i) {
    snprintf(path, sizeof path, "%s/%s", folder, sunk.names[i]);
    compare(&sunk, i, path);
  }
  bp_mesh_free(levels);
}

int main(int argc, char** argv) {
  char path[512];
  bp_scene* scene = make_scene();
  bp_grid* grid;
  need(argc == 2 && strlen(argv[1]) < 400, "bp_outputs FOLDER");
  snprintf(path, sizeof path, "%s/sunk.bpv", argv[1]);
  grid = check_grids(scene, path);
  check_meshes(grid, argv[1]);
  check_levels(scene, argv[1]);
  bp_grid_free(grid);
  bp_scene_free(scene);
  puts("sinks get the bytes of files");
  return 0;
}
