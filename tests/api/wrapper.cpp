// bp.hpp and bp_experimental.hpp do what the functions of C do. Strict C++17.
//   bp_wrapper FOLDER
#include <bp/bp_experimental.hpp>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <iterator>

namespace {

void need(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "FAILED: %s\n", what);
  std::exit(1);
}

template <class Body>
void need_status(bp_status status, const char* what, const Body& body) {
  try {
    body();
  } catch (const bp::ApiError& e) {
    return need(e.status() == status && e.what()[0] != 0, what);
  }
  need(false, what);
}

bp::Bytes bytes_of_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return bp::Bytes(std::istreambuf_iterator<char>(file), {});
}

/// Two boxes with a gap.
bp::Scene boxes() {
  const std::vector<std::uint32_t> box{0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                       2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
  std::vector<double> vertices;
  std::vector<std::uint32_t> triangles;
  for (unsigned b = 0; b < 2; ++b) {
    for (unsigned i = 0; i < 8; ++i)
      vertices.insert(vertices.end(), {1.1 * b + (i & 1), double(i >> 1 & 1), double(i >> 2 & 1)});
    for (const std::uint32_t v : box) triangles.push_back(v + 8 * b);
  }
  return bp::Scene(vertices, triangles);
}

bp::Grid voxels_of(const bp::Scene& scene, const bp_run& run = bp::run_options()) {
  bp_voxelize_options options = bp::voxelize_options();
  options.resolution = 48;
  return bp::Grid(scene, options, run);
}

void check_field(const bp::Scene& scene, const std::string& folder) {
  const bp::Grid grid = voxels_of(scene).field(R"({"base": 0.05, "rules": [{"at": [0, 0, 0], "scale": 0.2}]})");
  const std::vector<double> scales = grid.scales({0, 0, 0, 2.1, 1, 1});
  need(scales.size() == 2 && scales[0] == 0.2 && scales[1] == 0.05, "the scales of a field");
  const bp::Grid closed = grid.close();
  closed.save(folder + "/wrapped.bpv", true);
  need(closed.bytes() == bytes_of_file(folder + "/wrapped.bpv"), "the bytes of a stream");
  const bp::Grid again = bp::Grid::load(folder + "/wrapped.bpv");
  need(std::string(again.info().rules) == closed.info().rules, "the field of a stream");
  const bp::Mesh mesh = again.mesh(60);
  mesh.save(folder + "/wrapped.obj", true);
  need(mesh.bytes("obj") == bytes_of_file(folder + "/wrapped.obj"), "the bytes of a mesh");
  need_status(BP_BAD_ARGUMENT, "an unknown format", [&] { (void)mesh.bytes("step"); });
  need_status(BP_BAD_ARGUMENT, "half a point", [&] { (void)grid.scales({1, 2}); });
}

void check_runs(const bp::Scene& scene) {
  int told = 0, notes = 0;
  bp::Run run([&](const bp::Progress& p) { return p.pass != nullptr && ++told < 0; },
              [&](const std::string& text) { notes += text.empty() ? 0 : 1; });
  run.options.threads = 2;
  const bp::Grid grid = voxels_of(scene, run);
  need(told > 0, "progress is told");
  const std::uint64_t too_few = 1;
  bp_mesh_options options = bp::mesh_options();
  options.faces = &too_few;
  options.levels = 1;
  (void)grid.mesh(options, run);
  need(notes > 0, "notes are told");
  const bp::Run ended([](const bp::Progress&) { return true; });
  need_status(BP_CANCELLED, "progress ends a call", [&] { (void)voxels_of(scene, ended); });
  const bp::Run thrown([](const bp::Progress&) -> bool { throw 1; });
  bool caught = false;
  try {
    (void)voxels_of(scene, thrown);
  } catch (int) {
    caught = true;
  }
  need(caught, "an exception of progress ends a call, and comes out of it");
  need_status(BP_CANCELLED, "progress ends a proof",
              [&] { (void)bp::Verdict(grid.mesh(60), 0, scene, bp::check_options(), ended); });
  int heard = 0;  // a call that tells one step is reminded, until an answer ends it
  const bp::Run patient([&](const bp::Progress&) { return ++heard > 2; });
  std::string rules = R"({"base": 0.05, "rules": [)";
  for (int i = 0; i < 500; ++i) rules += R"({"at": [0, 0, 0], "radius": 3, "scale": 0.2},)";
  const bp::Grid slow = grid.field(rules + R"({"at": [1, 1, 1], "scale": 0.1}]})");
  const std::vector<double> points(9000000, 0.5);
  need_status(BP_CANCELLED, "a reminder ends a call", [&] { (void)slow.scales(points, patient); });
  need(heard == 3, "nothing is told after the answer that ends a call");
  const bp::Stop stop;
  const bp::Run stopped(stop);
  stop.set();
  need_status(BP_CANCELLED, "a stop ends a call", [&] { (void)voxels_of(scene, stopped); });
  stop.clear();
  (void)voxels_of(scene, stopped);
}

void check_numbers(const bp::Scene& scene) {
  const bp::Mesh mesh = bp::proxy(scene, 100);
  need(bp::Verdict(mesh, scene).holds() && bp::Verdict(mesh).holds(), "a proxy in one call");
  need(bp::Verdict(mesh.arrays(), scene).json().find("\"encloses\"") != std::string::npos, "a proof of arrays");
  need(scene.info().triangles == 24 && !bp::version().empty(), "counts of a scene");
  const std::vector<float> vertices(mesh.vertices().begin(), mesh.vertices().end());
  const std::vector<int> triangles(mesh.triangles().begin(), mesh.triangles().end());
  need(bp::Scene(vertices, triangles).info().triangles == triangles.size() / 3, "float and int");
  need(bp::Scene(mesh.vertices(), mesh.triangles()).info().triangles == triangles.size() / 3, "views");
  const bp::Grid grid = voxels_of(scene);
  std::uint64_t set = 0;
  for (const auto& coord : grid.bricks(BP_SOLID)) {
    std::uint64_t in_brick = 0, in_box = 0;
    for (std::uint64_t word : grid.brick(BP_SOLID, coord)) {
      for (; word != 0; word &= word - 1) ++in_brick;
    }
    const bp::Bytes box = grid.read(BP_SOLID, {64 * coord[0], 64 * coord[1], 64 * coord[2]}, {64, 64, 64});
    for (const unsigned char voxel : box) in_box += voxel;
    need(in_brick == in_box, "bricks and boxes of voxels");
    set += in_brick;
  }
  need(set == grid.info().voxels[BP_SOLID], "all bricks");
  need(grid.read(BP_SOLID, {0, 0, 0}, {0, 1, 1}).empty(), "an empty box");
  need(bp::cage(grid.close("4%"), 100).quads().size() > 0, "quads of a cage");
}

void check_shapes(const bp::Scene& scene, const std::string& folder) {
  need(bp::levels(scene, {80}).count() >= 1, "one number of faces");
  const bp::Mesh levels = bp::levels(scene, {80, 24});
  need(levels.count() >= 1 && levels.triangles().size() <= 3 * 80, "levels");
  bp::save_levels(levels, folder, "wrapped", true);
  const auto files = bp::level_files(levels, "wrapped");
  need(files.size() == levels.count() + 1, "the files of levels");
  for (const auto& [name, bytes] : files) need(bytes == bytes_of_file(folder + "/" + name), name.c_str());
  const bp::Mesh proxy = voxels_of(scene).close("2%").mesh(100);
  bp_hulls_options few = bp::hulls_options();
  few.hulls = 4;
  need(bp::hulls(proxy, few).count() >= 1, "hulls");
  bp_voxelize_options coarse = bp::voxelize_options();
  coarse.resolution = 48;
  bp_check_options within = bp::check_options();
  within.inside = 1;
  need(bp::Verdict(bp::occluder(scene, bp::occluder_options(), coarse), 0, scene, within).holds(), "an occluder");
  bp_cage_options of_cage = bp::cage_options();
  of_cage.faces = 100;
  need(bp::Verdict(bp::cage(scene, of_cage, coarse), scene).holds(), "a cage of a scene");
  need(bp::cage(voxels_of(scene).close("4%"), 100).triangles().size() <= 300, "a cage of a grid");
}

void check_weights(const bp::Scene& scene) {
  const bp::Mesh cage = voxels_of(scene).close("4%").mesh(60);
  const std::vector<double> points{0.5, 0.5, 0.5, 1.6, 0.2, 0.9};
  const bp::Weights weights(cage, points);
  std::vector<double> moved(cage.vertices().begin(), cage.vertices().end());
  need(weights.count() == 2 && weights.apply(moved) == points, "points that rest");
  for (std::size_t i = 0; i < moved.size(); i += 3) moved[i] += 1;
  const std::vector<double> out = weights.apply(moved);
  for (std::size_t i = 0; i < out.size(); ++i) {
    const double off = out[i] - points[i] - (i % 3 == 0 ? 1 : 0);
    need(off < 1e-5 && off > -1e-5, "points that follow their cage");
  }
  need_status(BP_BAD_ARGUMENT, "another cage", [&] { (void)weights.apply(points); });
  need_status(BP_BAD_INPUT, "a point outside", [&] { (void)bp::Weights(cage, {99, 0, 0}); });
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  try {
    const bp::Scene scene = boxes();
    check_field(scene, argv[1]);
    check_runs(scene);
    check_numbers(scene);
    check_shapes(scene, argv[1]);
    check_weights(scene);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "FAILED: %s\n", e.what());
    return 1;
  }
  std::puts("the wrappers do what the functions do");
}
