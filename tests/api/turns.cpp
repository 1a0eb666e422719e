// Calls libbp with random arrays and options, most of which make no sense. Every call must end with a result or with a
// message, and the memory must return. Sanitizers see what a caller does not.
//   bp_turns [TURNS [SEED [THREADS]]]      default: 300 1 1; each thread makes so many turns. Prints how many calls
//   were
//                                          done and refused, and the memory in use
#include <bp/bp_experimental.h>
#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <memory>
#include <numeric>
#include <random>
#include <string>
#include <thread>
#include <vector>

namespace {

using Bytes = std::vector<unsigned char>;

class Turns {
 public:
  explicit Turns(unsigned seed) : random_(seed), later_(seed) {}

  void turn() {
    make_scene();
    bp_scene* scene = nullptr;
    if (done(bp_scene_from_arrays(odd(30) ? nullptr : &arrays_, nullptr, &scene))) {
      from_scene(scene);
      bp_scene_info info;
      done(bp_scene_read_info(scene, run(), &info, odd(20) ? 4 : sizeof info));
    }
    bp_verdict* verdict = nullptr;
    bp_check_options options = checking();
    if (done(bp_check(&arrays_, odd(2) ? scene : nullptr, &options, run(), &verdict))) ask(verdict);
    bp_scene_free(scene);
    bind(arrays_);
  }

  unsigned long made = 0, refused = 0;

 private:
  [[nodiscard]] unsigned below(unsigned n) { return unsigned(random_() % n); }
  [[nodiscard]] bool odd(unsigned n) { return below(n) == 0; }  // one time in n
  [[nodiscard]] double number() {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    const double strange[] = {NAN, kInfinity, -kInfinity, 1e308, -1e308, 1e-320, -0.0, 1e18, 4e38};
    if (odd(400)) return strange[below(std::size(strange))];
    return double(below(2001)) / 1000 - 1;
  }

  bool done(bp_status status) {
    if (status == BP_OK) {
      ++made;
      return true;
    }
    ++refused;
    const std::string message = bp_error_message();
    const bool known = status >= BP_FAILED && status <= BP_CANCELLED;
    if (!known || message.size() < 12 || message.find("unexpected") != std::string::npos) {
      std::fprintf(stderr, "status %d: '%s'\n", int(status), message.c_str());
      std::exit(1);
    }
    return false;
  }

  /// Fills rows of three numbers, `stride` bytes apart, in just as many bytes as the library may read.
  template <class T, class Value>
  Bytes rows(std::size_t count, std::size_t stride, const Value& value) {
    Bytes bytes(count == 0 ? 0 : (count - 1) * stride + 3 * sizeof(T));
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        const T x = value();
        std::memcpy(bytes.data() + i * stride + k * sizeof(T), &x, sizeof x);
      }
    }
    return bytes;
  }

  void make_scene() {
    bp_arrays_defaults(&arrays_, sizeof arrays_);
    const std::size_t vertices = below(24), triangles = below(24);
    const auto stride = [&](std::size_t item) {
      const std::size_t wide[] = {3 * item, 3 * item, 3 * item, 3 * item + 1, 4 * item, 3 * item + 64};
      return wide[below(std::size(wide))];
    };
    const bool single = odd(2);
    arrays_.vertex_type = single ? BP_FLOAT32 : BP_FLOAT64;
    arrays_.vertex_stride = stride(single ? 4 : 8);
    vertices_ = single ? rows<float>(vertices, arrays_.vertex_stride, [&] { return float(number()); })
                       : rows<double>(vertices, arrays_.vertex_stride, [&] { return number(); });
    const auto index = [&]() -> std::int64_t {
      if (odd(300)) return std::int64_t(random_());
      return vertices == 0 ? below(3) : below(unsigned(vertices));
    };
    arrays_.triangle_type = std::int32_t(BP_UINT32 + below(4));
    const bool wide = arrays_.triangle_type >= BP_UINT64;
    arrays_.triangle_stride = stride(wide ? 8 : 4);
    triangles_ = wide ? rows<std::int64_t>(triangles, arrays_.triangle_stride, index)
                      : rows<std::int32_t>(triangles, arrays_.triangle_stride, [&] { return std::int32_t(index()); });
    arrays_.vertices = vertices_.data(), arrays_.vertex_count = vertices;
    arrays_.triangles = triangles_.data(), arrays_.triangle_count = triangles;
    arrays_.borrow = std::int32_t(below(2));
    arrays_.up = std::int32_t(below(odd(20) ? 100 : 7));
    if (odd(12)) spoil();
  }

  /// Breaks the description of the arrays.
  void spoil() {
    switch (below(8)) {
      case 0:
        arrays_.vertex_type = std::int32_t(random_());
        break;
      case 1:
        arrays_.triangle_type = std::int32_t(random_());
        break;
      case 2:
        arrays_.vertex_stride = 1 + below(11);
        break;
      case 3:
        arrays_.triangle_stride = 1 + below(11);
        break;
      case 4:
        arrays_.vertices = nullptr;
        break;
      case 5:
        arrays_.triangles = nullptr;
        break;
      case 6:
        arrays_.size = below(200);
        break;
      default:
        arrays_.vertex_count = std::size_t(1) << 33;
    }
  }

  bp_length length(double most, std::int32_t unit) {
    if (odd(40)) return {number(), std::int32_t(below(9))};
    return {most * below(1000) / 1000, unit};
  }

  const bp_run* run() {
    bp_run_defaults(&run_, sizeof run_);
    run_.threads = std::int32_t(1 + below(3));
    if (odd(80)) run_.threads = -1;
    if (odd(80)) run_.memory = below(1 << 30);
    if (odd(100)) run_.device = "tpu";
    if (odd(100)) run_.temp = "/no/such/folder";
    if (odd(200)) run_.size = 7;
    return &run_;
  }

  bp_voxelize_options voxels() {
    bp_voxelize_options o;
    bp_voxelize_defaults(&o, sizeof o);
    o.resolution = 6 + below(16);
    o.fill = std::int32_t(below(odd(20) ? 9 : 3));
    if (odd(60)) o.voxel = length(5, BP_PERCENT);
    if (odd(60)) o.resolution = std::int64_t(random_());
    return o;
  }

  bp_check_options checking() {
    bp_check_options o;
    bp_check_defaults(&o, sizeof o);
    o.inside = std::int32_t(odd(5)), o.convex = std::int32_t(odd(5)), o.no_distances = std::int32_t(odd(2));
    if (odd(5)) o.margin = length(3, BP_PERCENT);
    return o;
  }

  void ask(bp_verdict* verdict) {
    bp_verdict_info info;
    done(bp_verdict_read_info(verdict, &info, sizeof info));
    if (std::strlen(bp_verdict_text(verdict)) == 0 || std::strlen(bp_verdict_json(verdict)) == 0) std::exit(1);
    bp_verdict_free(verdict);
  }

  void ask(bp_mesh* mesh, const bp_scene* scene) {
    for (std::size_t i = 0; i < bp_mesh_count(mesh); ++i) {
      bp_mesh_view view;
      bp_mesh_info info;
      done(bp_mesh_look(mesh, i, &view, sizeof view));
      done(bp_mesh_read_info(mesh, i, &info, sizeof info));
      for (std::size_t k = 0; k < 3 * view.triangle_count; ++k)
        if (view.triangles[k] >= view.vertex_count) std::exit(1);
    }
    bp_check_options options = checking();
    bp_verdict* verdict = nullptr;
    if (done(bp_check_mesh(mesh, below(3), scene, &options, run(), &verdict))) ask(verdict);
    bp_hulls_options of_hulls;
    bp_hulls_defaults(&of_hulls, sizeof of_hulls);
    of_hulls.hulls = below(6);
    if (odd(10)) of_hulls.corners = below(70);
    bp_mesh* hulls = nullptr;
    if (odd(4) && done(bp_hulls(mesh, 0, &of_hulls, run(), &hulls))) bp_mesh_free(hulls);
    if (odd(4)) done(bp_levels_save(mesh, "/proc/no such folder", odd(9) ? nullptr : "x", 1));
    if (odd(4)) done(bp_mesh_save(mesh, 0, "/proc/no such folder/x.glb", 1));
    const char* const formats[] = {"glb", "gltf", "ply", "obj", "stl", "step", "", nullptr};
    if (also(3)) done(bp_mesh_write(mesh, 0, formats[later_() % (also(5) ? 8 : 5)], also(20) ? nullptr : sink, this));
    if (also(3)) done(bp_levels_write(mesh, also(9) ? "a/b" : "x", sink, this));
    bp_mesh_free(mesh);
  }

  void from_scene(const bp_scene* scene) {
    const bp_voxelize_options of_voxels = voxels();
    std::uint64_t faces[] = {4 + below(100), 4 + below(40)};
    bp_mesh* mesh = nullptr;
    switch (below(6)) {
      case 0: {
        bp_levels_options o;
        bp_levels_defaults(&o, sizeof o);
        const bp_length errors[] = {length(9, BP_PERCENT), length(20, BP_PERCENT)};
        if (odd(2)) o.faces = faces, o.face_count = 1 + below(2);
        if (odd(4)) o.errors = errors, o.error_count = 1 + below(2);
        o.levels = odd(9) ? below(40) : below(4);
        o.mode = std::int32_t(below(odd(9) ? 9 : 3));
        o.enclose = std::int32_t(odd(4) ? below(6) : 0);
        if (odd(3)) o.scale = length(8, BP_PERCENT);
        if (done(bp_levels(scene, &of_voxels, &o, run(), &mesh))) ask(mesh, scene);
        break;
      }
      case 1: {
        bp_occluder_options o;
        bp_occluder_defaults(&o, sizeof o);
        o.faces = below(90);
        if (odd(2)) o.scale = length(9, BP_PERCENT);
        o.no_scale = std::int32_t(odd(3));
        if (done(bp_occluder(scene, &of_voxels, &o, run(), &mesh))) ask(mesh, scene);
        break;
      }
      case 2: {
        bp_cage_options o;
        bp_cage_defaults(&o, sizeof o);
        o.faces = below(200);
        if (odd(2)) o.margin = length(9, BP_PERCENT);
        o.symmetry = std::int32_t(below(odd(9) ? 99 : 5));
        if (done(bp_scene_cage(scene, &of_voxels, &o, run(), &mesh))) ask(mesh, scene);
        break;
      }
      default:
        from_grid(scene, of_voxels, faces);
    }
  }

  [[nodiscard]] bool also(unsigned n) { return later_() % n == 0; }

  /// Takes some bytes, and then may refuse more.
  static int sink(void* user, const char*, const void* bytes, std::size_t count) {
    Turns& self = *static_cast<Turns*>(user);
    const unsigned char* const first = static_cast<const unsigned char*>(bytes);
    self.taken_ = std::accumulate(first, first + count, self.taken_);
    return self.also(9) ? 1 : 0;
  }

  /// Gives the grid a scale field, asks for the scales, and closes by them.
  void with_field(const bp_grid* grid) {
    const char* const rules[] = {R"({"base": "3%"})",
                                 R"({"base": "2%", "rules": [{"at": [0, 0, 0], "radius": 0.3, "scale": "9%"}]})",
                                 R"({"base": "2%", "orientation": "auto"})",
                                 R"({"base": "3%", "rules": [{"gap": "5%"}]})",
                                 R"({"base": 1e300})",
                                 "[",
                                 nullptr};
    bp_grid *ruled = nullptr, *closed = nullptr;
    if (!done(bp_field(grid, rules[later_() % (also(9) ? 7 : 4)], &run_, &ruled))) return;
    double points[6] = {0, 0.5, 0, 1, 0, also(20) ? 1e200 : 0}, scales[2];
    done(bp_grid_scales(also(9) ? grid : ruled, points, 2, &run_, scales));
    if (done(bp_close(ruled, nullptr, &run_, &closed)))
      done(bp_grid_write(closed, also(20) ? nullptr : sink, this, &run_));
    bp_grid_free(ruled);
    bp_grid_free(closed);
  }

  void from_grid(const bp_scene* scene, const bp_voxelize_options& of_voxels, const std::uint64_t* faces) {
    bp_grid *grid = nullptr, *closed = nullptr;
    if (!done(bp_voxelize(scene, &of_voxels, run(), &grid))) return;
    if (also(2)) with_field(grid);
    bp_close_options closing;
    bp_close_defaults(&closing, sizeof closing);
    closing.scale = length(12, BP_PERCENT);
    closing.element = std::int32_t(below(odd(20) ? 9 : 2));
    closing.keep_cavities = std::int32_t(odd(4));
    if (odd(20)) closing.rules = odd(2) ? "{\"base\": \"3%\"}" : "{\"base\": [";
    if (done(bp_close(grid, &closing, run(), &closed))) {
      bp_grid_info info;
      done(bp_grid_read_info(closed, &info, sizeof info));
      const std::int32_t min[] = {std::int32_t(below(9)) - 4, 0, 0}, extent[] = {std::int32_t(below(20)) - 1, 7, 5};
      Bytes box(std::size_t(std::max(extent[0], 0)) * 35 + 1);
      done(bp_grid_read(closed, bp_layer(below(3)), min, extent, box.data()));
      bp_mesh_options o;
      bp_mesh_defaults(&o, sizeof o);
      o.faces = odd(9) ? nullptr : faces;
      o.levels = below(3);
      o.mode = std::int32_t(below(odd(20) ? 9 : 4));
      o.quads = std::int32_t(odd(5));
      bp_mesh* mesh = nullptr;
      if (done(bp_mesh_make(closed, &o, run(), &mesh))) ask(mesh, scene);
      if (odd(4) && done(bp_cage(closed, below(100), run(), &mesh))) ask(mesh, scene);
    }
    bp_grid_free(closed);
    bp_grid_free(grid);
  }

  void bind(const bp_arrays& cage) {
    std::vector<double> points(3 * below(9));
    for (double& x : points) x = number();
    bp_bind_options o;
    bp_bind_defaults(&o, sizeof o);
    o.kind = std::int32_t(below(odd(20) ? 9 : 3));
    o.carry_outside = std::int32_t(odd(2));
    bp_weights* weights = nullptr;
    if (!done(bp_bind(&cage, points.data(), points.size() / 3, &o, run(), &weights))) return;
    std::vector<double> moved(3 * cage.vertex_count, 0.5);
    done(bp_weights_apply(weights, moved.data(), run(), points.data()));
    bp_weights_free(weights);
  }

  std::mt19937_64 random_;
  std::mt19937_64 later_;  // of calls that came later, so that seeds which found a fault go on finding it
  bp_arrays arrays_{};
  bp_run run_{};
  Bytes vertices_, triangles_;
  unsigned taken_ = 0;  // the sum of all bytes that the sink got
};

/// Returns the bytes that are allocated; 0 under a sanitizer, whose allocator does not tell, and which looks itself.
std::size_t bytes_in_use() {
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
}

}  // namespace

int main(int argc, char** argv) {
  const auto number = [&](int i, int otherwise) { return argc > i ? std::atoi(argv[i]) : otherwise; };
  const int turns = number(1, 300), seed = number(2, 1), threads = number(3, 1);
  constexpr std::size_t kMayStay = std::size_t(4) << 20;  // of threads and pools of oneTBB; settles within 1000 turns
  std::vector<std::unique_ptr<Turns>> all;
  for (int i = 0; i < threads; ++i) all.push_back(std::make_unique<Turns>(unsigned(seed + i)));
  const auto make = [&](int count) {
    std::vector<std::thread> at_once;
    for (auto& calls : all) {
      at_once.emplace_back([&calls, count] {
        for (int i = 0; i < count; ++i) calls->turn();
      });
    }
    for (std::thread& thread : at_once) thread.join();
  };
  make(turns / 5);
  const std::size_t before = bytes_in_use();
  make(turns - turns / 5);
  const std::size_t after = bytes_in_use();
  unsigned long made = 0, refused = 0;
  for (const auto& calls : all) made += calls->made, refused += calls->refused;
  std::printf("%d turns on %d threads: %lu calls done, %lu refused; bytes in use: %zu after a fifth, %zu at the end\n",
              turns, threads, made, refused, before, after);
  const bool returns = after <= before + kMayStay;
  if (!returns) std::printf("FAILED: memory does not return\n");
  return returns && made > 0 && refused > 0 ? 0 : 1;
}
