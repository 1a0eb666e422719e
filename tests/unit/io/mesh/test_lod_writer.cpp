#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <random>

#include "io/gltf/meshopt_codec.h"
#include "io/mesh/lod_writer.h"
#include "lib/core/vec3.h"
#include "tests/catch.h"
#include "tests/unit/io/mesh/soup.h"
#include "tests/unit/io/scene/scene_files.h"

using namespace bp;
using namespace bp::test;

namespace {

using Json = nlohmann::json;

GridFrame frame_at(const Vec3d& place, double voxel, UpAxis up) {
  Bounds3d bounds;
  bounds.add(place);
  bounds.add({place[0] + 50, place[1] + 50, place[2] + 50});
  return make_frame(bounds, voxel, up);
}

LatticeMesh random_level(const GridFrame& frame, std::int64_t reach, unsigned seed) {
  LatticeMesh mesh;
  mesh.frame = frame;
  mesh.provenance = {{"bplod", "0.1.0", "levels=3", "00ff"}};
  std::mt19937_64 random(seed);
  std::uniform_int_distribution<std::int64_t> pick(-reach, reach);
  for (int i = 0; i < 300; ++i) mesh.vertices.push_back({pick(random), pick(random), pick(random)});
  for (std::uint32_t i = 0; i + 2 < 300; ++i) mesh.triangles.push_back({i, (7 * i + 1) % 300, i + 2});
  return mesh;
}

Json json_of(const std::string& path) {
  const std::string bytes = bytes_of_file(path);
  std::uint32_t size = 0;
  std::memcpy(&size, bytes.data() + 12, 4);
  return Json::parse(bytes.substr(20, size));
}

/// Returns the numbers of an accessor in a file without compression.
template <class Number>
std::vector<Number> numbers(const std::string& path, std::size_t accessor) {
  const Json doc = json_of(path), &a = doc["accessors"][accessor],
             &view = doc["bufferViews"][a["bufferView"].get<int>()];
  const std::map<std::string, std::size_t> sizes{{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}};
  std::vector<Number> all(a["count"].get<std::size_t>() * sizes.at(a["type"].get<std::string>()));
  const std::string bytes = bytes_of_file(path);
  std::uint32_t json_size = 0;
  std::memcpy(&json_size, bytes.data() + 12, 4);
  std::memcpy(all.data(), bytes.data() + 28 + json_size + view.value("byteOffset", 0), all.size() * sizeof all[0]);
  return all;
}

template <class Write>
std::string written(const TempDir& dir, const Write& write) {
  OutputFile out(dir.path("x.glb"), true);
  write(out);
  out.commit();
  return dir.path("x.glb");
}

}  // namespace

TEST_CASE("levels read back are the meshes less their origin, which the file tells", "[quick][io][lod]") {
  const UpAxis up = GENERATE(UpAxis::y, UpAxis::z);
  const LatticeMesh mesh = random_level(frame_at({6801760.25, -455564.7, 31.3}, 0.37, up), 64 * 100, 5);
  const Vec3d origin{6801760, -455500, 0};
  const TempDir dir;
  const NamedMesh named{"far", &mesh};
  const bool parts = GENERATE(false, true);
  const std::string file = written(dir, [&](OutputFile& out) {
    parts ? write_parts_glb({&named, 1}, out, {origin}) : write_lod_glb({&named, 1}, {}, out, {origin});
  });
  CHECK(canonical(soup(read_mesh(file))) == canonical(soup(mesh, origin)));
  CHECK(json_of(file)["asset"]["extras"]["origin"] == Json{6801760.0, -455500.0, 0.0});
  const Json translation = json_of(file)["nodes"][0]["translation"];
  for (const Json& x : translation) CHECK(std::abs(x.get<double>()) < 500);
  const auto refuse = [&](const Vec3d& odd) {
    CHECK_THROWS_AS(written(dir, [&](OutputFile& out) { write_lod_glb({&named, 1}, {}, out, {odd}); }), Error);
  };
  refuse({6801760.1, -455564.7, 1e-9});
}

TEST_CASE("a tile read back is the mesh, to the bit, relative to its origin", "[quick][io][lod]") {
  const UpAxis up = UpAxis(GENERATE(range(0, 6)));
  const std::int64_t reach = GENERATE(100, 32767, 40000, 1 << 23);
  const Vec3d place = GENERATE(Vec3d{0, 0, 0}, Vec3d{4.9e5, 5.4e6, 12.5});
  CAPTURE(reach, place[0]);
  const LatticeMesh mesh = random_level(frame_at(place, 0.3, up), reach, 5);
  const Vec3d origin = mesh.frame.world({0, 0, 0});
  const TempDir dir;
  const std::string path = written(dir, [&](OutputFile& out) {
    out.write(tile_glb({"tile", &mesh}, lattice_point(mesh.frame, origin)));
  });
  std::vector<TriangleD> expected = soup(mesh, origin);
  for (TriangleD& t : expected)
    for (Vec3d& p : t) p = to_y_up(up)(p);
  CHECK(canonical(soup(read_mesh(path))) == canonical(expected));

  const Json doc = json_of(path);
  CHECK(doc["accessors"][0]["componentType"] == (reach <= 32767 ? 5122 : 5126));
  CHECK(doc["extensionsRequired"].size() == 2);
  CHECK(doc["accessors"][0]["componentType"] == (reach <= 32767 ? 5122 : 5126));
  CHECK(!doc["nodes"][0].contains("translation"));
  CHECK(bytes_of_file(path).size() < 20000);
}

TEST_CASE("compressed levels have the same triangles, and are smaller", "[quick][io][lod]") {
  const TempDir dir;
  const LatticeMesh mesh = random_level(frame_at({1000, -3, 7}, 0.37, UpAxis::z), 20000, 5);
  const NamedMesh named{"a", &mesh};
  const auto write = [&](Compression compression) {
    LeafLooks looks;
    looks.compression = compression;
    return written(dir, [&](OutputFile& out) { write_lod_glb({&named, 1}, {}, out, {}, looks); });
  };
  const std::size_t plain = bytes_of_file(write(Compression::none)).size();
  const std::string path = write(Compression::meshopt);
  CHECK(canonical(soup(read_mesh(path))) == canonical(soup(mesh)));
  CHECK(bytes_of_file(path).size() < plain * 2 / 3);  // random corners; those of a surface take a third
  const Json doc = json_of(path);
  CHECK(doc["extensionsRequired"] == Json{"EXT_meshopt_compression", "KHR_mesh_quantization"});
}

TEST_CASE("colours and normals of vertices come back, turned with the mesh, and change no position",
          "[quick][io][lod]") {
  const UpAxis up = UpAxis(GENERATE(range(0, 6)));
  const bool compressed = GENERATE(false, true);
  const TempDir dir;
  LatticeMesh mesh = random_level(frame_at({0, 0, 0}, 0.5, up), 100000, 3);
  const auto write = [&] {
    const NamedMesh named{"a", &mesh};
    return written(dir, [&](OutputFile& out) {
      compressed ? out.write(tile_glb(named, {})) : write_lod_glb({&named, 1}, {}, out);
    });
  };
  const auto plain = canonical(soup(read_mesh(write())));
  if (!compressed) CHECK(plain == canonical(soup(mesh)));
  const auto color_of = [](std::uint32_t v) {
    return color_from_linear({v % 256 / 255.0, (v + 100) % 256 / 255.0, 1});
  };
  for (const auto& t : mesh.triangles) mesh.colors.push_back({color_of(t[0]), color_of(t[1]), color_of(t[2])});
  const std::string path = write();
  CHECK(canonical(soup(read_mesh(path))) == plain);
  const Json doc = json_of(path);
  const Json attributes = doc["meshes"][0]["primitives"][0]["attributes"];
  const Json normals = doc["accessors"][attributes["NORMAL"].get<std::size_t>()];
  CHECK(normals["count"] == doc["accessors"][0]["count"]);
  CHECK(normals["componentType"] == (compressed ? 5120 : 5126));

  SceneOptions options;
  options.colors = true;
  const auto source = open_scene(path, options);
  std::map<Vec3d, LinearColor> found;
  std::vector<TriangleD> batch;
  std::vector<TriangleColors> colors;
  while (source->read_colored(batch, colors)) {
    for (std::size_t i = 0; i < batch.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k) found[batch[i][k]] = colors[i][k];
  }
  CHECK(source->has_colors());
  CHECK(found.size() == mesh.vertices.size());
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    Vec3d p = mesh.frame.world(mesh.vertices[i]);
    if (compressed) {
      const Vec3d origin = mesh.frame.world({});
      for (std::size_t k = 0; k < 3; ++k) p[k] -= origin[k];
      p = to_y_up(up)(p);
    }
    CHECK(found[p] == color_of(std::uint32_t(i)));
  }
}

TEST_CASE("octahedral normals come back within 1.1 degrees", "[quick][io][lod]") {
  std::vector<std::array<float, 3>> normals{{0, 0, 1}, {0, 0, -1}, {0, -1, 0}, {1, 0, 0}};
  std::mt19937 random(7);
  std::normal_distribution<float> any;
  for (int i = 0; i < 500; ++i) {
    std::array<float, 3> n{any(random), any(random), any(random)};
    const float length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (float& x : n) x /= length;
    normals.push_back(n);
  }
  const std::string packed = encode_attributes(octahedral(normals), 4);
  std::vector<std::byte> out;
  CHECK(decode_meshopt({MeshoptMode::attributes, MeshoptFilter::octahedral, normals.size(), 4},
                       std::as_bytes(std::span(packed.data(), packed.size())), out)
            .empty());
  double least = 1;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    double along = 0, length = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto x = double(std::int8_t(out[4 * i + k]));
      along += x * double(normals[i][k]);
      length += x * x;
    }
    least = std::min(least, along / std::sqrt(length));
  }
  CHECK(std::acos(least) * 180 / 3.14159265 < 1.1);
}

TEST_CASE("a tile away from its lattice, or too wide for floats, is refused", "[quick][io][lod]") {
  const TempDir dir;
  LatticeMesh mesh = random_level(frame_at({0, 0, 0}, 0.5, UpAxis::y), 100, 1);
  const auto write = [&](const Vec3d& origin) {
    return written(dir, [&](OutputFile& out) {
      out.write(tile_glb({"tile", &mesh}, lattice_point(mesh.frame, origin)));
    });
  };
  CHECK_THROWS_AS(write({0.001, 0, 0}), Error);
  mesh.vertices[3].y = (1 << 24) + 1;
  CHECK_THROWS_AS(write({0, 0, 0}), Error);
  CHECK(!std::filesystem::exists(dir.path("x.glb")));
}

TEST_CASE("a file of levels shows the finest, and names the others", "[quick][io][lod]") {
  const UpAxis up = UpAxis(GENERATE(range(0, 6)));
  const TempDir dir;
  const LatticeMesh fine = random_level(frame_at({7e5, -3, 12}, 0.3, up), 3000, 5);
  const LatticeMesh coarse = random_level(frame_at({7e5, -3, 12}, 0.6, up), 700, 6);
  const std::vector<NamedMesh> levels{{"a_LOD0", &fine}, {"a_LOD1", &coarse}};
  const std::vector<double> coverage{0.25, 0};
  const std::string path = written(dir, [&](OutputFile& out) { write_lod_glb(levels, coverage, out); });
  CHECK(canonical(soup(read_mesh(path))) == canonical(soup(fine)));
  const std::vector<IndexedMesh> read = read_levels(path);
  REQUIRE(read.size() == 2);
  CHECK(canonical(soup(read[0])) == canonical(soup(fine)));
  CHECK(canonical(soup(read[1])) == canonical(soup(coarse)));
  Json doc = json_of(path);
  CHECK(doc["scenes"][0]["nodes"] == Json{0});
  CHECK(doc["nodes"][0]["extensions"]["MSFT_lod"]["ids"] == Json{1});
  CHECK(doc["nodes"][0]["extras"]["MSFT_screencoverage"] == Json{0.25, 0.0});
  CHECK(doc["nodes"][1]["name"] == "a_LOD1");
  CHECK(doc["extensionsUsed"] == Json{"MSFT_lod"});
  CHECK(!doc.contains("extensionsRequired"));
}

TEST_CASE("parts of a file are all in its scene", "[quick][io][lod]") {
  const TempDir dir;
  const LatticeMesh a = random_level(frame_at({0, 0, 0}, 0.5, UpAxis::z), 3000, 5), b = random_level(a.frame, 50, 6);
  const std::vector<NamedMesh> parts{{"UCX_a_00", &a}, {"UCX_a_01", &b}};
  const std::string path = written(dir, [&](OutputFile& out) { write_parts_glb(parts, out); });
  std::vector<TriangleD> both = soup(a);
  for (const TriangleD& t : soup(b)) both.push_back(t);
  CHECK(canonical(soup(read_mesh(path))) == canonical(both));
}

TEST_CASE("a damaged compressed view is an error or other numbers, never a crash", "[quick][io][lod]") {
  const TempDir dir;
  const LatticeMesh mesh = random_level(frame_at({0, 0, 0}, 0.5, UpAxis::y), 3000, 9);
  const std::string path = written(dir, [&](OutputFile& out) { out.write(tile_glb({"tile", &mesh}, {})); });
  const std::string good = bytes_of_file(path);
  const std::size_t data = good.find("BIN") + 4;
  std::mt19937 random(3);
  int complaints = 0;
  for (int i = 0; i < 60; ++i) {
    std::string bad = good;
    bad[data + random() % (bad.size() - data)] = char(random());
    complaints += !complaint_of(dir.file("bad.glb", bad)).empty();
  }
  CHECK(complaints > 0);
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string bad = good;
    bad.replace(bad.find(from), from.size(), to);
    return complaint_of(dir.file("bad.glb", bad));
  };
  CHECK_THAT(with("\"mode\":\"ATTRIBUTES\"", "\"mode\":\"ATTRIBUTE?\""), Contains("mode"));
  const std::string count = fmt::format("\"count\":{},\"mode\"", json_of(path)["accessors"][0]["count"].get<int>());
  REQUIRE(good.find(count) != std::string::npos);
  CHECK_THAT(with(count, "\"count\":999,\"mode\""), Contains("damaged"));
}

TEST_CASE("what a compressed view promises is bounded by its bytes", "[quick][io][lod]") {
  std::vector<std::byte> bytes(100), out;
  CHECK_THAT(decode_meshopt({MeshoptMode::attributes, MeshoptFilter::none, std::uint64_t(1) << 40, 16}, bytes, out),
             Contains("promise"));
  CHECK_THAT(decode_meshopt({MeshoptMode::attributes, MeshoptFilter::none, 10, 6}, bytes, out), Contains("stride"));
  CHECK_THAT(decode_meshopt({MeshoptMode::triangles, MeshoptFilter::none, 10, 4}, bytes, out), Contains("multiple"));
  CHECK_THAT(decode_meshopt({MeshoptMode::triangles, MeshoptFilter::octahedral, 9, 4}, bytes, out), Contains("filter"));
  CHECK(out.empty());
  // The most compressible vertices there are still fit the bound.
  const std::string zeros(std::size_t(256) * 10000, '\0');
  const std::string packed = encode_attributes(zeros, 256);
  CHECK(decode_meshopt({MeshoptMode::attributes, MeshoptFilter::none, 10000, 256},
                       std::as_bytes(std::span(packed.data(), packed.size())), out)
            .empty());
  CHECK(out.size() == zeros.size());
}

TEST_CASE("the screen coverage of a level is where its error is a pixel", "[quick][io][lod]") {
  CHECK(coverage_at_one_pixel(100, 0) == 1);
  CHECK(coverage_at_one_pixel(100, 100.0 / 1e5) == 1);
  const double half = coverage_at_one_pixel(100, 100.0 / 540);  // half of the height
  CHECK(half > 0.110);
  CHECK(half < 0.111);
}

TEST_CASE("a texture splits vertices by charts and moves none", "[quick][io]") {
  const TempDir dir;
  LatticeMesh mesh = random_level(frame_at({100, 200, 300}, 0.5, UpAxis::z), 20000, 6);
  const std::vector<TriangleD> before = canonical(soup(mesh));
  auto texture = std::make_shared<MeshTexture>();
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const std::uint32_t chart = i % 7;
    texture->chart.push_back(chart);
    MeshTexture::Corners& uv = texture->uv.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) uv[k] = {float(mesh.triangles[i][k]) / 300, float(chart) / 7};
  }
  texture->image = "an image";
  texture->type = "image/jpeg";
  mesh.texture = texture;
  LatticeMesh plain = mesh;
  plain.texture = nullptr;
  const std::string path = dir.path("x.glb");
  OutputFile out(path, true);
  write_lod_glb(std::vector<NamedMesh>{{"textured", &mesh}, {"plain", &plain}}, std::vector<double>{0.5, 0}, out);
  out.commit();
  for (const IndexedMesh& level : read_levels(path)) CHECK(canonical(soup(level)) == before);
  const std::string bytes = bytes_of_file(path);
  std::uint32_t size = 0;
  std::memcpy(&size, bytes.data() + 12, 4);
  const Json doc = Json::parse(bytes.substr(20, size));
  CHECK(doc["materials"].size() == 2);
  const Json &first = doc["meshes"][0]["primitives"][0], &second = doc["meshes"][1]["primitives"][0];
  CHECK(first["material"] != second["material"]);
  CHECK(first["attributes"].contains("TEXCOORD_0"));
  CHECK_FALSE(second["attributes"].contains("TEXCOORD_0"));
  CHECK(doc["materials"][first["material"].get<std::size_t>()]["pbrMetallicRoughness"].contains("baseColorTexture"));
  CHECK_FALSE(
      doc["materials"][second["material"].get<std::size_t>()]["pbrMetallicRoughness"].contains("baseColorTexture"));
  const Json& view = doc["bufferViews"][doc["images"][0]["bufferView"].get<std::size_t>()];
  CHECK(bytes.substr(20 + size + 8 + view["byteOffset"].get<std::size_t>(), view["byteLength"].get<std::size_t>()) ==
        "an image");

  const LatticeCoord origin{0, 0, 0};
  const std::string tile = tile_glb({"tile", &mesh}, origin), plain_tile = tile_glb({"tile", &plain}, origin);
  CHECK(canonical(soup(read_mesh(dir.file("t.glb", tile)))) ==
        canonical(soup(read_mesh(dir.file("p.glb", plain_tile)))));
}

TEST_CASE("tangents in a file point where u rises on the triangles that have them", "[quick][io]") {
  constexpr std::uint32_t kSide = 20;
  const TempDir dir;
  LatticeMesh mesh;
  mesh.frame = frame_at({100, 200, 300}, 0.5, UpAxis::y);
  auto texture = std::make_shared<MeshTexture>();
  for (std::uint32_t i = 0; i < kSide * kSide; ++i) mesh.vertices.push_back({64 * (i % kSide), 64 * (i / kSide), 0});
  for (std::uint32_t i = 0; i + kSide < kSide * kSide; ++i) {
    if (i % kSide + 1 == kSide) continue;
    mesh.triangles.push_back({i, i + 1, i + kSide});
    mesh.triangles.push_back({i + 1, i + kSide + 1, i + kSide});
  }
  std::shuffle(mesh.triangles.begin(), mesh.triangles.end(), std::mt19937(7));
  for (const auto& t : mesh.triangles) {
    const std::uint32_t chart = 2 * (t[0] % kSide / 10) + t[0] / kSide / 10;  // each turned or mirrored in its way
    texture->chart.push_back(chart);
    MeshTexture::Corners& uv = texture->uv.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      const float x = float(t[k] % kSide) / kSide, y = float(t[k] / kSide) / kSide;
      const std::array<std::array<float, 2>, 4> ways{{{x, y}, {y, x}, {1 - x, y}, {x, 1 - y}}};
      uv[k] = ways[chart];
    }
  }
  texture->image = texture->normal.bytes = "an image";
  texture->type = texture->normal.type = "image/jpeg";
  mesh.texture = texture;
  const NamedMesh named{"level", &mesh};
  const std::string path = written(dir, [&](OutputFile& out) { write_lod_glb({&named, 1}, {}, out); });
  const Json primitive = json_of(path)["meshes"][0]["primitives"][0], &has = primitive["attributes"];
  const auto triangles = numbers<std::uint16_t>(path, primitive["indices"]);
  const auto places = numbers<float>(path, has["POSITION"]), tangents = numbers<float>(path, has["TANGENT"]),
             uv = numbers<float>(path, has["TEXCOORD_0"]);
  for (std::size_t i = 0; i < triangles.size(); i += 3) {
    const std::size_t a = triangles[i];
    const auto edge = [&](std::size_t k) {  // in the plane, and in the image
      const std::size_t b = triangles[i + k];
      return std::array<float, 4>{places[3 * b] - places[3 * a], places[3 * b + 1] - places[3 * a + 1],
                                  uv[2 * b] - uv[2 * a], uv[2 * b + 1] - uv[2 * a + 1]};
    };
    const auto e = edge(1), f = edge(2);
    const float area = e[2] * f[3] - e[3] * f[2];
    Vec3d rises{double(f[3] * e[0] - e[3] * f[0]) / double(area), double(f[3] * e[1] - e[3] * f[1]) / double(area), 0};
    rises = (1 / length(rises)) * rises;
    CHECK(rises[0] * double(tangents[4 * a]) + rises[1] * double(tangents[4 * a + 1]) > 0.999);
    CHECK(tangents[4 * a + 3] == (area > 0 ? -1 : 1));  // v goes down
  }
}
