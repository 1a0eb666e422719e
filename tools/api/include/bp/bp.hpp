// bp.hpp: bp.h for C++17, with objects that free themselves and errors as exceptions. Header only.
//
//   bp::Scene scene(vertices, triangles);                      // std::vector<double>, std::vector<uint32_t>
//   bp::Mesh proxy = bp::Grid(scene).close("1%").mesh(1000);
//   bool proven = bp::Verdict(proxy, 0, scene).holds();
#ifndef BP_BP_HPP
#define BP_BP_HPP

#include <bp/bp.h>

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace bp {
/// The version of this wrapper: programs that include another one can be linked with it.
inline namespace api_0 {

/// A call of the library failed. what() tells the object, the fact and, as a rule, a remedy.
class ApiError : public std::runtime_error {
 public:
  ApiError(bp_status status, const char* message) : std::runtime_error(message), status_(status) {}
  [[nodiscard]] bp_status status() const { return status_; }

 private:
  bp_status status_;
};

inline void throw_unless_ok(bp_status status) {
  if (status != BP_OK) throw ApiError(status, bp_error_message());
}

/// Numbers in somebody's memory, as std::span of C++20.
template <class T>
struct View {
  const T* first = nullptr;
  std::size_t count = 0;
  [[nodiscard]] const T* begin() const { return first; }
  [[nodiscard]] const T* end() const { return first + count; }
  [[nodiscard]] const T* data() const { return first; }
  [[nodiscard]] std::size_t size() const { return count; }
  [[nodiscard]] const T& operator[](std::size_t i) const { return first[i]; }
};

/// Returns options with their defaults.
template <class T, class Defaults>
[[nodiscard]] T with_defaults(Defaults defaults) {
  T options;
  defaults(&options, sizeof options);
  return options;
}
[[nodiscard]] inline bp_run run_options() {
  return with_defaults<bp_run>(bp_run_defaults);
}
[[nodiscard]] inline bp_voxelize_options voxelize_options() {
  return with_defaults<bp_voxelize_options>(bp_voxelize_defaults);
}
[[nodiscard]] inline bp_close_options close_options() {
  return with_defaults<bp_close_options>(bp_close_defaults);
}
[[nodiscard]] inline bp_mesh_options mesh_options() {
  return with_defaults<bp_mesh_options>(bp_mesh_defaults);
}
[[nodiscard]] inline bp_check_options check_options() {
  return with_defaults<bp_check_options>(bp_check_defaults);
}

/// Reads "0.5", "2%" or "20vx".
[[nodiscard]] inline bp_length length(const std::string& text) {
  bp_length out{};
  throw_unless_ok(bp_length_parse(text.c_str(), &out));
  return out;
}

/// A handle of the library, freed with the last copy of this object.
template <class T, void (*Free)(T*)>
class Shared {
 public:
  [[nodiscard]] T* get() const { return handle_.get(); }

 protected:
  void take(T* handle) { handle_ = std::shared_ptr<T>(handle, Free); }

 private:
  std::shared_ptr<T> handle_;
};

class Scene : public Shared<bp_scene, bp_scene_free> {
 public:
  explicit Scene(const bp_arrays& arrays, const char* name = nullptr) {
    bp_scene* out = nullptr;
    throw_unless_ok(bp_scene_from_arrays(&arrays, name, &out));
    take(out);
  }
  /// Copies arrays: x, y, z of each vertex, and three numbers of vertices for each triangle.
  Scene(const std::vector<double>& vertices, const std::vector<std::uint32_t>& triangles)
      : Scene(arrays_of(vertices, triangles)) {}
  /// Names a file, or several: Scene("a.ply"), Scene({"a.ply", "b.ply"}).
  explicit Scene(const std::string& file) : Scene(std::vector<std::string>{file}) {}
  explicit Scene(std::initializer_list<std::string> files) : Scene(std::vector<std::string>(files)) {}
  explicit Scene(const std::vector<std::string>& files, const char* format = nullptr) {
    std::vector<const char*> names;
    for (const std::string& file : files) names.push_back(file.c_str());
    bp_scene* out = nullptr;
    throw_unless_ok(bp_scene_from_files(names.data(), names.size(), format, &out));
    take(out);
  }

 private:
  static bp_arrays arrays_of(const std::vector<double>& vertices, const std::vector<std::uint32_t>& triangles) {
    if (vertices.size() % 3 != 0 || triangles.size() % 3 != 0)
      throw ApiError(BP_BAD_ARGUMENT, "vertices and triangles have three numbers each");
    bp_arrays a = with_defaults<bp_arrays>(bp_arrays_defaults);
    a.vertices = vertices.data();
    a.vertex_count = vertices.size() / 3;
    a.triangles = triangles.data();
    a.triangle_count = triangles.size() / 3;
    return a;
  }
};

class Mesh : public Shared<bp_mesh, bp_mesh_free> {
 public:
  explicit Mesh(bp_mesh* handle) { take(handle); }
  [[nodiscard]] std::size_t count() const { return bp_mesh_count(get()); }
  [[nodiscard]] View<double> vertices(std::size_t index = 0) const {
    const bp_mesh_view v = look(index);
    return {v.vertices, 3 * v.vertex_count};
  }
  [[nodiscard]] View<std::uint32_t> triangles(std::size_t index = 0) const {
    const bp_mesh_view v = look(index);
    return {v.triangles, 3 * v.triangle_count};
  }
  void save(const std::string& path, bool overwrite = false, std::size_t index = 0) const {
    throw_unless_ok(bp_mesh_save(get(), index, path.c_str(), overwrite ? 1 : 0));
  }

 private:
  [[nodiscard]] bp_mesh_view look(std::size_t index) const {
    bp_mesh_view view{};
    throw_unless_ok(bp_mesh_look(get(), index, &view, sizeof view));
    return view;
  }
};

class Grid : public Shared<bp_grid, bp_grid_free> {
 public:
  explicit Grid(bp_grid* handle) { take(handle); }
  /// Voxelizes a scene.
  explicit Grid(const Scene& scene, const bp_voxelize_options& options = voxelize_options(),
                const bp_run& run = run_options()) {
    bp_grid* out = nullptr;
    throw_unless_ok(bp_voxelize(scene.get(), &options, &run, &out));
    take(out);
  }
  [[nodiscard]] Grid close(const bp_close_options& options, const bp_run& run = run_options()) const {
    bp_grid* out = nullptr;
    throw_unless_ok(bp_close(get(), &options, &run, &out));
    return Grid(out);
  }
  [[nodiscard]] Grid close(const std::string& scale) const {
    bp_close_options options = close_options();
    options.scale = length(scale);
    options.no_scale = options.scale.value > 0 ? 0 : 1;
    return close(options);
  }
  [[nodiscard]] Mesh mesh(const bp_mesh_options& options, const bp_run& run = run_options()) const {
    bp_mesh* out = nullptr;
    throw_unless_ok(bp_mesh_make(get(), &options, &run, &out));
    return Mesh(out);
  }
  [[nodiscard]] Mesh mesh(std::uint64_t faces) const {
    bp_mesh_options options = mesh_options();
    options.faces = &faces;
    options.levels = 1;
    return mesh(options);
  }
};

class Verdict : public Shared<bp_verdict, bp_verdict_free> {
 public:
  Verdict(const Mesh& proxy, std::size_t index, const Scene& scene, const bp_check_options& options = check_options(),
          const bp_run& run = run_options()) {
    bp_verdict* out = nullptr;
    throw_unless_ok(bp_check_mesh(proxy.get(), index, scene.get(), &options, &run, &out));
    take(out);
  }
  [[nodiscard]] bp_verdict_info info() const {
    bp_verdict_info info{};
    throw_unless_ok(bp_verdict_read_info(get(), &info, sizeof info));
    return info;
  }
  [[nodiscard]] bool holds() const { return info().answer == BP_PROVEN; }
  [[nodiscard]] std::string reasons() const { return bp_verdict_reasons(get()); }
  [[nodiscard]] std::string text() const { return bp_verdict_text(get()); }
};

}  // namespace api_0
}  // namespace bp
#endif
