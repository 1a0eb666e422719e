// bp.hpp: bp.h for C++17, with objects that free themselves and errors as exceptions. Header only.
//
//   bp::Scene scene(vertices, triangles);                      // std::vector<double> or float, std::vector<uint32_t>
//   bp::Mesh proxy = bp::Grid(scene).close("1%").mesh(1000);
//   bool proven = bp::Verdict(proxy, scene).holds();
//
// bp_experimental.hpp wraps the parts that may change with any version: levels, hulls, occluders, cages.
#ifndef BP_BP_HPP
#define BP_BP_HPP

#include <bp/bp.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <initializer_list>
#include <map>
#include <memory>
#include <mutex>
#include <new>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
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

template <class T>
[[nodiscard]] View<T> view(const std::vector<T>& numbers) {
  return {numbers.data(), numbers.size()};
}

/// Returns the bp_type of a number: float, double, or a whole one of 32 or 64 bits.
template <class T>
[[nodiscard]] constexpr bp_type type_of() {
  static_assert(std::is_same_v<T, float> || std::is_same_v<T, double> ||
                    (std::is_integral_v<T> && (sizeof(T) == 4 || sizeof(T) == 8)),
                "the library takes float, double, and whole numbers of 32 and 64 bits");
  if constexpr (std::is_floating_point_v<T>) {
    return std::is_same_v<T, float> ? BP_FLOAT32 : BP_FLOAT64;
  } else if constexpr (sizeof(T) == 4) {
    return std::is_signed_v<T> ? BP_INT32 : BP_UINT32;
  } else {
    return std::is_signed_v<T> ? BP_INT64 : BP_UINT64;
  }
}

/// Returns the version of the library that runs.
[[nodiscard]] inline std::string version() {
  return bp_version();
}

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

/// Returns the number of points whose x, y, z an array holds.
[[nodiscard]] inline std::size_t count_of_points(const std::vector<double>& points) {
  if (points.size() % 3 != 0) throw ApiError(BP_BAD_ARGUMENT, "points have three numbers each");
  return points.size() / 3;
}

/// Reads "0.5", "2%" or "20vx".
[[nodiscard]] inline bp_length length(const std::string& text) {
  bp_length out{};
  throw_unless_ok(bp_length_parse(text.c_str(), &out));
  return out;
}

using Bytes = std::vector<unsigned char>;

/// Returns what a function of the library hands to a sink: write(sink, user) is called once. Bytes of files by their
/// names; of a single result by "".
template <class Write>
[[nodiscard]] std::map<std::string, Bytes> files_of(const Write& write) {
  struct Taken {
    std::map<std::string, Bytes> files;
    bool full = false;
  } taken;
  const bp_sink_fn sink = [](void* user, const char* file, const void* data, std::size_t count) {
    Taken& to = *static_cast<Taken*>(user);
    try {
      const unsigned char* const first = static_cast<const unsigned char*>(data);
      Bytes& bytes = to.files[file == nullptr ? "" : file];
      bytes.insert(bytes.end(), first, first + count);
    } catch (...) {
      to.full = true;
    }
    return to.full ? 1 : 0;
  };
  const bp_status status = write(sink, &taken);
  if (taken.full) throw std::bad_alloc();
  throw_unless_ok(status);
  return std::move(taken.files);
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

/// Ends calls early, from any thread: those whose bp_run has it.
class Stop : public Shared<bp_stop, bp_stop_free> {
 public:
  Stop() {
    take(bp_stop_new());
    if (get() == nullptr) throw std::bad_alloc();
  }
  void set() const { bp_stop_set(get()); }
  void clear() const { bp_stop_clear(get()); }
};

/// What a call does. `total` is 0 if it is not known.
struct Progress {
  const char* pass;
  const char* unit;
  std::uint64_t done, total;
};

/// How calls run, in place of a bp_run, with functions of C++:
///   bp::Run run([](const bp::Progress& p) { return user_gave_up(p); });
///   run.options.threads = 4;
///   bp::Grid grid(scene, bp::voxelize_options(), run);
/// The functions are called on any thread, by one thread at a time.
class Run {
 public:
  /// Returns true to end the call. An exception ends it, too, and comes out of the call.
  using OnProgress = std::function<bool(const Progress&)>;
  using OnNote = std::function<void(const std::string&)>;  ///< an exception is dropped
  explicit Run(OnProgress progress = nullptr, OnNote note = nullptr)
      : progress_(std::move(progress)), note_(std::move(note)) {
    options.user = this;
    if (progress_) options.progress = tell;
    if (note_) options.note = note_down;
  }
  explicit Run(const Stop& stop) : Run() { stop_by(stop); }
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  /// Calls end when `stop` is set.
  void stop_by(const Stop& stop) {
    stop_ = stop;
    options.stop = stop_.get();
  }
  operator const bp_run&() const { return options; }

  /// Throws what the function of `run`, if it is of this class, threw in the call that ended with `status`; else an
  /// ApiError unless the status is BP_OK.
  static void throw_unless_ok(bp_status status, const bp_run& run) {
    const std::exception_ptr thrown = run.progress == tell ? static_cast<Run*>(run.user)->take_thrown() : nullptr;
    if (status == BP_CANCELLED && thrown) std::rethrow_exception(thrown);
    bp::throw_unless_ok(status);
  }

  bp_run options = run_options();  ///< progress, note, user and stop belong to this object

 private:
  static int tell(void* user, const char* pass, const char* unit, std::uint64_t done, std::uint64_t total) {
    try {
      return static_cast<Run*>(user)->progress_({pass, unit, done, total}) ? 1 : 0;
    } catch (...) {
      Run& run = *static_cast<Run*>(user);
      const std::lock_guard<std::mutex> lock(run.mutex_);
      run.thrown_ = std::current_exception();
      return 1;
    }
  }
  std::exception_ptr take_thrown() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return std::exchange(thrown_, nullptr);
  }
  static void note_down(void* user, const char* text) {
    try {
      static_cast<Run*>(user)->note_(text);
    } catch (...) {  // the call has done its work
    }
  }
  OnProgress progress_;
  OnNote note_;
  Stop stop_;
  std::mutex mutex_;
  std::exception_ptr thrown_;  // by progress_; of several calls that share this object, one throws it
};

inline void throw_unless_ok(bp_status status, const bp_run& run) {
  Run::throw_unless_ok(status, run);
}

class Scene : public Shared<bp_scene, bp_scene_free> {
 public:
  explicit Scene(const bp_arrays& arrays, const char* name = nullptr) {
    bp_scene* out = nullptr;
    throw_unless_ok(bp_scene_from_arrays(&arrays, name, &out));
    take(out);
  }
  /// Copies arrays: x, y, z of each vertex, and three numbers of vertices for each triangle.
  template <class Number, class Index>
  Scene(View<Number> vertices, View<Index> triangles) : Scene(arrays_of(vertices, triangles)) {}
  Scene(const std::vector<double>& vertices, const std::vector<std::uint32_t>& triangles)
      : Scene(view(vertices), view(triangles)) {}
  template <class Number, class Index>
  Scene(const std::vector<Number>& vertices, const std::vector<Index>& triangles)
      : Scene(view(vertices), view(triangles)) {}
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

  /// Reads the whole scene, and counts.
  [[nodiscard]] bp_scene_info info(const bp_run& run = run_options()) const {
    bp_scene_info info{};
    throw_unless_ok(bp_scene_read_info(get(), &run, &info, sizeof info), run);
    return info;
  }

 private:
  template <class Number, class Index>
  static bp_arrays arrays_of(View<Number> vertices, View<Index> triangles) {
    if (vertices.size() % 3 != 0 || triangles.size() % 3 != 0)
      throw ApiError(BP_BAD_ARGUMENT, "vertices and triangles have three numbers each");
    bp_arrays a = with_defaults<bp_arrays>(bp_arrays_defaults);
    a.vertices = vertices.data();
    a.vertex_count = vertices.size() / 3;
    a.vertex_type = type_of<Number>();
    a.triangles = triangles.data();
    a.triangle_count = triangles.size() / 3;
    a.triangle_type = type_of<Index>();
    return a;
  }
};

class Mesh : public Shared<bp_mesh, bp_mesh_free> {
 public:
  explicit Mesh(bp_mesh* handle) { take(handle); }
  /// Reads a file of a mesh, all of its levels.
  [[nodiscard]] static Mesh load(const std::string& path, const bp_run& run = run_options()) {
    bp_mesh* out = nullptr;
    throw_unless_ok(bp_mesh_load(path.c_str(), &run, &out), run);
    return Mesh(out);
  }
  [[nodiscard]] std::size_t count() const { return bp_mesh_count(get()); }
  [[nodiscard]] View<double> vertices(std::size_t index = 0) const {
    const bp_mesh_view v = look(index);
    return {v.vertices, 3 * v.vertex_count};
  }
  [[nodiscard]] View<std::uint32_t> triangles(std::size_t index = 0) const {
    const bp_mesh_view v = look(index);
    return {v.triangles, 3 * v.triangle_count};
  }
  /// Returns two numbers of triangles for each quad.
  [[nodiscard]] View<std::uint32_t> quads(std::size_t index = 0) const {
    const bp_mesh_view v = look(index);
    return {v.quads, 2 * v.quad_count};
  }
  [[nodiscard]] bp_mesh_info info(std::size_t index = 0) const {
    bp_mesh_info info{};
    throw_unless_ok(bp_mesh_read_info(get(), index, &info, sizeof info));
    return info;
  }
  void save(const std::string& path, bool overwrite = false, std::size_t index = 0) const {
    throw_unless_ok(bp_mesh_save(get(), index, path.c_str(), overwrite ? 1 : 0));
  }
  /// Returns the bytes of a file of that format: "glb", "gltf", "ply", "obj" or "stl".
  [[nodiscard]] Bytes bytes(const std::string& format, std::size_t index = 0) const {
    return files_of(
        [&](bp_sink_fn sink, void* user) { return bp_mesh_write(get(), index, format.c_str(), sink, user); })[""];
  }
  /// Returns the mesh as arrays, which belong to this object.
  [[nodiscard]] bp_arrays arrays(std::size_t index = 0) const {
    const bp_mesh_view v = look(index);
    bp_arrays a = with_defaults<bp_arrays>(bp_arrays_defaults);
    a.vertices = v.vertices;
    a.vertex_count = v.vertex_count;
    a.triangles = v.triangles;
    a.triangle_count = v.triangle_count;
    return a;
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
    throw_unless_ok(bp_voxelize(scene.get(), &options, &run, &out), run);
    take(out);
  }
  /// Reads a stream of voxels of bpvox, bpclose or save().
  [[nodiscard]] static Grid load(const std::string& path, const bp_run& run = run_options()) {
    bp_grid* out = nullptr;
    throw_unless_ok(bp_grid_load(path.c_str(), &run, &out), run);
    return Grid(out);
  }
  void save(const std::string& path, bool overwrite = false, const bp_run& run = run_options()) const {
    throw_unless_ok(bp_grid_save(get(), path.c_str(), overwrite ? 1 : 0, &run), run);
  }
  /// Returns the bytes of that file.
  [[nodiscard]] Bytes bytes(const bp_run& run = run_options()) const {
    return files_of([&](bp_sink_fn sink, void* user) { return bp_grid_write(get(), sink, user, &run); })[""];
  }
  /// Adds a scale field, of rules as JSON.
  [[nodiscard]] Grid field(const std::string& rules, const bp_run& run = run_options()) const {
    bp_grid* out = nullptr;
    throw_unless_ok(bp_field(get(), rules.c_str(), &run, &out), run);
    return Grid(out);
  }
  /// Returns the scales at points: x, y, z of each.
  [[nodiscard]] std::vector<double> scales(const std::vector<double>& points, const bp_run& run = run_options()) const {
    std::vector<double> out(count_of_points(points));
    throw_unless_ok(bp_grid_scales(get(), points.data(), out.size(), &run, out.data()), run);
    return out;
  }
  [[nodiscard]] Grid close(const bp_close_options& options = close_options(), const bp_run& run = run_options()) const {
    bp_grid* out = nullptr;
    throw_unless_ok(bp_close(get(), &options, &run, &out), run);
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
    throw_unless_ok(bp_mesh_make(get(), &options, &run, &out), run);
    return Mesh(out);
  }
  [[nodiscard]] Mesh mesh(std::uint64_t faces) const { return mesh(std::vector<std::uint64_t>{faces}); }
  /// Makes levels of so many triangles, falling: each encloses the one before.
  [[nodiscard]] Mesh mesh(const std::vector<std::uint64_t>& faces) const {
    bp_mesh_options options = mesh_options();
    options.faces = faces.data();
    options.levels = faces.size();
    return mesh(options);
  }
  [[nodiscard]] bp_grid_info info() const {
    bp_grid_info info{};
    throw_unless_ok(bp_grid_read_info(get(), &info, sizeof info));
    return info;
  }
  /// Returns voxels, one byte each: voxel min + (i, j, k) is [(k * extent[1] + j) * extent[0] + i].
  [[nodiscard]] Bytes read(bp_layer layer, const std::array<std::int32_t, 3>& min,
                           const std::array<std::int32_t, 3>& extent) const {
    std::size_t count = 1;
    for (const std::int32_t n : extent) {
      if (n > 0 && count > PTRDIFF_MAX / std::size_t(n)) throw ApiError(BP_BAD_ARGUMENT, "the box has too many voxels");
      count *= n > 0 ? std::size_t(n) : 0;
    }
    Bytes out(count + 1);  // the library asks for a place, for none, too
    throw_unless_ok(bp_grid_read(get(), layer, min.data(), extent.data(), out.data()));
    out.pop_back();
    return out;
  }
  /// Returns the bricks of a layer that are not empty.
  [[nodiscard]] std::vector<std::array<std::int32_t, 3>> bricks(bp_layer layer) const {
    std::size_t count = 0;
    throw_unless_ok(bp_grid_bricks(get(), layer, nullptr, 0, &count));
    std::vector<std::array<std::int32_t, 3>> out(count);
    if (count > 0) throw_unless_ok(bp_grid_bricks(get(), layer, out.front().data(), count, &count));
    return out;
  }
  /// Returns the bits of a brick: 4096 words, x fastest.
  [[nodiscard]] std::vector<std::uint64_t> brick(bp_layer layer, const std::array<std::int32_t, 3>& coord) const {
    std::vector<std::uint64_t> bits(4096);
    throw_unless_ok(bp_grid_brick(get(), layer, coord.data(), bits.data()));
    return bits;
  }
};

/// Voxelizes, closes and meshes.
[[nodiscard]] inline Mesh proxy(const Scene& scene, const bp_mesh_options& mesh,
                                const bp_close_options& close = close_options(),
                                const bp_voxelize_options& voxelize = voxelize_options(),
                                const bp_run& run = run_options()) {
  bp_mesh* out = nullptr;
  throw_unless_ok(bp_proxy(scene.get(), &voxelize, &close, &mesh, &run, &out), run);
  return Mesh(out);
}
[[nodiscard]] inline Mesh proxy(const Scene& scene, std::uint64_t faces) {
  bp_mesh_options options = mesh_options();
  options.faces = &faces;
  options.levels = 1;
  return proxy(scene, options);
}

/// The exact answer about a proxy: alone, or around a scene.
class Verdict : public Shared<bp_verdict, bp_verdict_free> {
 public:
  Verdict(const Mesh& proxy, std::size_t index, const Scene& scene, const bp_check_options& options = check_options(),
          const bp_run& run = run_options()) {
    check(proxy, index, scene.get(), options, run);
  }
  Verdict(const Mesh& proxy, const Scene& scene) : Verdict(proxy, 0, scene) {}
  explicit Verdict(const Mesh& proxy, std::size_t index = 0, const bp_check_options& options = check_options(),
                   const bp_run& run = run_options()) {
    check(proxy, index, nullptr, options, run);
  }
  Verdict(const bp_arrays& proxy, const Scene& scene, const bp_check_options& options = check_options(),
          const bp_run& run = run_options()) {
    check(proxy, scene.get(), options, run);
  }
  explicit Verdict(const bp_arrays& proxy, const bp_check_options& options = check_options(),
                   const bp_run& run = run_options()) {
    check(proxy, nullptr, options, run);
  }
  [[nodiscard]] bp_verdict_info info() const {
    bp_verdict_info info{};
    throw_unless_ok(bp_verdict_read_info(get(), &info, sizeof info));
    return info;
  }
  [[nodiscard]] bool holds() const { return info().answer == BP_PROVEN; }
  [[nodiscard]] std::string reasons() const { return bp_verdict_reasons(get()); }
  [[nodiscard]] std::string text() const { return bp_verdict_text(get()); }
  [[nodiscard]] std::string json() const { return bp_verdict_json(get()); }

 private:
  void check(const Mesh& proxy, std::size_t index, const bp_scene* scene, const bp_check_options& options,
             const bp_run& run) {
    bp_verdict* out = nullptr;
    throw_unless_ok(bp_check_mesh(proxy.get(), index, scene, &options, &run, &out), run);
    take(out);
  }
  void check(const bp_arrays& proxy, const bp_scene* scene, const bp_check_options& options, const bp_run& run) {
    bp_verdict* out = nullptr;
    throw_unless_ok(bp_check(&proxy, scene, &options, &run, &out), run);
    take(out);
  }
};

}  // namespace api_0
}  // namespace bp
#endif
