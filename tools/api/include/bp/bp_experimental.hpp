// bp_experimental.hpp: bp_experimental.h for C++17, as bp.hpp wraps bp.h. These parts may change with any version.
//
//   bp::Mesh levels = bp::levels(scene, {1000, 250});          // vertices(0), vertices(1)
//   bp::Weights weights(bp::cage(scene), points);              // x, y, z of each point
#ifndef BP_BP_EXPERIMENTAL_HPP
#define BP_BP_EXPERIMENTAL_HPP

#include <bp/bp_experimental.h>

#include <bp/bp.hpp>

namespace bp {
inline namespace api_0 {

[[nodiscard]] inline bp_hulls_options hulls_options() {
  return with_defaults<bp_hulls_options>(bp_hulls_defaults);
}
[[nodiscard]] inline bp_levels_options levels_options() {
  return with_defaults<bp_levels_options>(bp_levels_defaults);
}
[[nodiscard]] inline bp_occluder_options occluder_options() {
  return with_defaults<bp_occluder_options>(bp_occluder_defaults);
}
[[nodiscard]] inline bp_cage_options cage_options() {
  return with_defaults<bp_cage_options>(bp_cage_defaults);
}
[[nodiscard]] inline bp_bind_options bind_options() {
  return with_defaults<bp_bind_options>(bp_bind_defaults);
}

/// Covers a proxy with convex hulls.
[[nodiscard]] inline Mesh hulls(const Mesh& proxy, const bp_hulls_options& options = hulls_options(),
                                const bp_run& run = run_options(), std::size_t index = 0) {
  bp_mesh* out = nullptr;
  throw_unless_ok(bp_hulls(proxy.get(), index, &options, &run, &out), run);
  return Mesh(out);
}

/// Makes levels of detail of a scene.
[[nodiscard]] inline Mesh levels(const Scene& scene, const bp_levels_options& options = levels_options(),
                                 const bp_voxelize_options& voxelize = voxelize_options(),
                                 const bp_run& run = run_options()) {
  bp_mesh* out = nullptr;
  throw_unless_ok(bp_levels(scene.get(), &voxelize, &options, &run, &out), run);
  return Mesh(out);
}
/// Makes levels of so many triangles, falling.
[[nodiscard]] inline Mesh levels(const Scene& scene, const std::vector<std::uint64_t>& faces) {
  bp_levels_options options = levels_options();
  options.faces = faces.data();
  options.face_count = faces.size();
  return levels(scene, options);
}
[[nodiscard]] inline Mesh levels(const Scene& scene, std::initializer_list<std::uint64_t> faces) {
  return levels(scene, std::vector<std::uint64_t>(faces));
}

/// Makes a mesh strictly inside what the scene hides.
[[nodiscard]] inline Mesh occluder(const Scene& scene, const bp_occluder_options& options = occluder_options(),
                                   const bp_voxelize_options& voxelize = voxelize_options(),
                                   const bp_run& run = run_options()) {
  bp_mesh* out = nullptr;
  throw_unless_ok(bp_occluder(scene.get(), &voxelize, &options, &run, &out), run);
  return Mesh(out);
}

/// Makes a cage of quads and triangles around a scene, with a margin.
[[nodiscard]] inline Mesh cage(const Scene& scene, const bp_cage_options& options = cage_options(),
                               const bp_voxelize_options& voxelize = voxelize_options(),
                               const bp_run& run = run_options()) {
  bp_mesh* out = nullptr;
  throw_unless_ok(bp_scene_cage(scene.get(), &voxelize, &options, &run, &out), run);
  return Mesh(out);
}
/// Makes a cage of quads around the scene of a closed grid: at most so many triangles.
[[nodiscard]] inline Mesh cage(const Grid& grid, std::uint64_t faces, const bp_run& run = run_options()) {
  bp_mesh* out = nullptr;
  throw_unless_ok(bp_cage(grid.get(), faces, &run, &out), run);
  return Mesh(out);
}

/// Writes what levels(), occluder() or cage() of a scene returned, with the names and bytes of bplod.
inline void save_levels(const Mesh& meshes, const std::string& folder, const std::string& name = "scene",
                        bool overwrite = false) {
  throw_unless_ok(bp_levels_save(meshes.get(), folder.c_str(), name.c_str(), overwrite ? 1 : 0));
}
/// Returns these files by their names.
[[nodiscard]] inline std::map<std::string, Bytes> level_files(const Mesh& meshes, const std::string& name = "scene") {
  return files_of([&](bp_sink_fn sink, void* user) { return bp_levels_write(meshes.get(), name.c_str(), sink, user); });
}

/// Points that are bound to a cage.
class Weights : public Shared<bp_weights, bp_weights_free> {
 public:
  /// Binds points: x, y, z of each. The cage may be any proxy.
  Weights(const Mesh& cage, const std::vector<double>& points, const bp_bind_options& options = bind_options(),
          const bp_run& run = run_options(), std::size_t index = 0)
      : Weights(cage.arrays(index), points, options, run) {}
  Weights(const bp_arrays& cage, const std::vector<double>& points, const bp_bind_options& options = bind_options(),
          const bp_run& run = run_options()) {
    bp_weights* out = nullptr;
    throw_unless_ok(bp_bind(&cage, points.data(), count_of_points(points), &options, &run, &out), run);
    take(out);
  }
  [[nodiscard]] std::size_t count() const { return bp_weights_count(get()); }
  /// Returns the points' places when the cage's vertices lie at `moved`: x, y, z of each, in their order.
  [[nodiscard]] std::vector<double> apply(const std::vector<double>& moved, const bp_run& run = run_options()) const {
    if (count_of_points(moved) != bp_weights_cage_count(get()))
      throw ApiError(BP_BAD_ARGUMENT, "moved: its number of points is not that of the cage's vertices");
    std::vector<double> out(3 * count());
    throw_unless_ok(bp_weights_apply(get(), moved.data(), &run, out.data()), run);
    return out;
  }
};

}  // namespace api_0
}  // namespace bp
#endif
