#include <array>
#include <cmath>

#include "io/scene/scene_pose.h"
#include "io/scene/texture_table.h"
#include "tests/catch.h"
#include "tests/reference/random_closing.h"
#include "tests/unit/io/scene/gltf_document.h"
#include "tools/cli/names.h"

using namespace bp;
using namespace bp::test;

namespace {

using Places = std::vector<Vec3d>;
using Matrix = std::array<double, 16>;  // by columns

/// The joints of the quad's four corners: two for each, with their shares.
struct Shares {
  std::vector<std::uint8_t> joints;
  std::vector<float> weights;
};

/// Node 0 is the quad, moved away; nodes 1 and 2 are its joints, one below the other.
Document skinned_quad(const Shares& shares, const std::vector<float>& inverses) {
  Document d;
  d.node({{"mesh", d.quad_mesh()}, {"skin", 0}, {"translation", {100, 0, 0}}});
  d.node({{"children", {2}}, {"translation", {0, 0, 1}}});
  d.node({{"translation", {0, 2, 0}}});
  d.json["scenes"][0]["nodes"] = {0, 1};
  Json& attributes = d.json["meshes"][0]["primitives"][0]["attributes"];
  attributes["JOINTS_0"] = d.array(shares.joints, kU8, "VEC4", 4);
  attributes["WEIGHTS_0"] = d.array(shares.weights, kF32, "VEC4", 4);
  d.json["skins"] = Json::array({{{"joints", {1, 2}}}});
  if (!inverses.empty()) d.json["skins"][0]["inverseBindMatrices"] = d.array(inverses, kF32, "MAT4", 2);
  return d;
}

/// The first corner is joint 0's, the second joint 1's, the third half and half, and the fourth has no weight.
Shares halves() {
  return {{0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0}, {1, 0, 0, 0, 1, 0, 0, 0, 0.5, 0.5, 0, 0, 0, 0, 0, 0}};
}

Places corners_of(const Document& d, const SceneOptions& options = {}) {
  const TempDir dir;
  const IndexedMesh mesh = read_mesh(dir.file("skinned.glb", d.glb()), options);
  REQUIRE(mesh.triangles.size() == 2);
  const auto [a, b, c] = mesh.triangles[0];
  return {mesh.vertices[a], mesh.vertices[b], mesh.vertices[c], mesh.vertices[mesh.triangles[1][2]]};
}

std::string complaint_of(const Document& d) {
  try {
    (void)corners_of(d);
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

/// p by columns: the specification's formula, one joint at a time.
Vec3d by_matrix(const Matrix& m, const Vec3d& p) {
  Vec3d out;
  for (std::size_t i = 0; i < 3; ++i) out[i] = m[i] * p[0] + m[4 + i] * p[1] + m[8 + i] * p[2] + m[12 + i];
  return out;
}

}  // namespace

TEST_CASE("joints place the vertices of a skin, and its own node does not", "[quick][io]") {
  // Joint 0 stands at (0, 0, 1), joint 1 at (0, 2, 1).
  CHECK(corners_of(skinned_quad(halves(), {})) == Places{{0, 0, 1}, {1, 2, 1}, {1, 2, 1}, {0, 3, 1}});
}

TEST_CASE("weights of a skin need not sum to 1, and may be many", "[quick][io]") {
  Shares shares = halves();
  for (float& w : shares.weights) w *= 3;
  Document d = skinned_quad(shares, {});
  CHECK(corners_of(d) == corners_of(skinned_quad(halves(), {})));
  // Adds the same shares for the other joint: then all corners are half and half.
  Json& attributes = d.json["meshes"][0]["primitives"][0]["attributes"];
  attributes["JOINTS_1"] = d.array<std::uint16_t>({1, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0}, kU16, "VEC4", 4);
  attributes["WEIGHTS_1"] = d.array<float>({3, 0, 0, 0, 3, 0, 0, 0, 3, 3, 0, 0, 1, 1, 0, 0}, kF32, "VEC4", 4);
  CHECK(corners_of(d) == Places{{0, 1, 1}, {1, 1, 1}, {1, 2, 1}, {0, 2, 1}});
}

TEST_CASE("what programs place in different ways is counted", "[quick][io]") {
  const TempDir dir;
  const auto unfollowed = [&](const Document& d) { return read_mesh(dir.file("a.glb", d.glb())).unfollowed; };
  Shares shares = halves();
  CHECK(unfollowed(skinned_quad(shares, {})).skins == 1);  // a corner without weight
  shares.weights[12] = 1;
  CHECK(unfollowed(skinned_quad(shares, {})).skins == 0);
  shares.weights[12] = 0.9F;
  CHECK(unfollowed(skinned_quad(shares, {})).skins == 1);
  shares.weights[12] = 1;
  Document two = skinned_quad(shares, {});
  auto& attributes = two.json["meshes"][0]["primitives"][0]["attributes"];
  attributes["JOINTS_1"] = attributes["JOINTS_0"];
  attributes["WEIGHTS_1"] = two.array<float>(std::vector<float>(16, 0.F), kF32, "VEC4", 4);
  CHECK(unfollowed(two).skins == 0);  // a second set that is padding
  attributes["WEIGHTS_1"] = attributes["WEIGHTS_0"];
  CHECK(unfollowed(two).skins == 1);
  Document d;
  d.node({{"mesh", d.quad_mesh()}, {"rotation", {0, 0, 0.7071, 0.7071}}});
  CHECK_FALSE(unfollowed(d).moves());
  d.json["nodes"][0]["rotation"] = {0, 0, 1, 1};
  CHECK(unfollowed(d).transforms == 1);
  d.json["nodes"][0].erase("rotation");
  const int turns = d.array<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0}, kF32, "VEC4", 3);
  d.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["ROTATION"] = turns;
  CHECK(unfollowed(d).transforms == 3);  // and the extension is not required
  d.json["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
  CHECK(unfollowed(d).transforms == 2);
  d.json["nodes"][0].erase("extensions");
  for (const double shear : {0.5, 0.0003, 0.0001}) {
    d.json["nodes"][0]["matrix"] = {1, 0, 0, 0, shear, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    CHECK(unfollowed(d).transforms == (shear > 0.0002 ? 1 : 0));  // matrices of four digits are no sheared ones
  }
}

TEST_CASE("a skin of any matrices moves its vertices as the formula of the specification", "[quick][io]") {
  reference::Random random(4);
  std::vector<float> inverses;
  Shares shares;
  for (int i = 0; i < 32; ++i) inverses.push_back(i % 4 == 3 ? float(i % 16 == 15) : float(random.between(-50, 50)));
  for (int i = 0; i < 16; ++i) {
    shares.joints.push_back(std::uint8_t(random.between(0, 1)));
    shares.weights.push_back(float(random.between(1, 16)));
  }
  const Document d = skinned_quad(shares, inverses);
  const Places corners = corners_of(d);
  for (std::size_t v = 0; v < 4; ++v) {
    Vec3d sum{};
    double all = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t joint = shares.joints[4 * v + k];
      Matrix inverse;
      std::copy_n(inverses.begin() + std::ptrdiff_t(16 * joint), 16, inverse.begin());
      const Vec3d at = joint == 0 ? Vec3d{0, 0, 1} : Vec3d{0, 2, 1}, p = by_matrix(inverse, kQuad[v]);
      for (std::size_t i = 0; i < 3; ++i) sum[i] += double(shares.weights[4 * v + k]) * (p[i] + at[i]);
      all += double(shares.weights[4 * v + k]);
    }
    for (std::size_t i = 0; i < 3; ++i) CHECK(std::abs(corners[v][i] - sum[i] / all) < 1e-12);
  }
}

TEST_CASE("joints turn the normals of a skin, and stretching tilts them", "[quick][io]") {
  Document d = skinned_quad(
      {{0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}, {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}}, {});
  const float h = std::sqrt(0.5F);
  d.json["nodes"][1] = {{"rotation", {0, h, 0, h}}};  // z goes to x
  d.json["nodes"][2] = {{"scale", {2, 1, 1}}};
  d.json["scenes"][0]["nodes"] = {0, 1, 2};
  d.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = d.floats(Places(4, Vec3d{0.6, 0, 0.8}));
  const TempDir dir;
  SceneOptions options;
  options.surface = true;
  options.textures = std::make_shared<TextureTable>();
  const auto source = open_scenes({dir.file("skinned.glb", d.glb())}, options);
  std::vector<TriangleD> triangles;
  std::vector<TriangleColors> colors;
  std::vector<TriangleTexture> textures;
  REQUIRE(source->read_textured(triangles, colors, textures));
  REQUIRE(textures.size() == 2);
  const auto near = [](std::uint32_t packed, const Vec3d& n) {
    const auto u = unpack_normal(packed);
    for (std::size_t i = 0; i < 3; ++i) CHECK(std::abs(double(u[i]) - n[i]) < 1e-3);
  };
  near(textures[0].normals[0], {0.8, 0, -0.6});
  const double l = std::hypot(0.3, 0.8);
  near(textures[0].normals[1], {0.3 / l, 0, 0.8 / l});
}

TEST_CASE("animated joints move the vertices of their skin", "[quick][io]") {
  Document d = skinned_quad(halves(), {});
  const int times = d.array<float>({0, 1}, kF32, "SCALAR", 2), places = d.floats({{0, 0, 1}, {5, 0, 1}});
  d.json["animations"] =
      Json::array({{{"samplers", {{{"input", times}, {"output", places}}}},
                    {"channels", {{{"sampler", 0}, {"target", {{"node", 1}, {"path", "translation"}}}}}}}});
  const TempDir dir;
  const std::string path = dir.file("skinned.glb", d.glb());
  const std::vector<ScenePose> poses = read_poses(path, {});
  REQUIRE(poses.size() == 2);
  SceneOptions options;
  options.pose = std::make_shared<const ScenePose>(poses[1]);
  CHECK(corners_of(d, options) == Places{{5, 0, 1}, {6, 2, 1}, {6, 2, 1}, {5, 3, 1}});
}

TEST_CASE("a scene stands as the weights of its morph targets show", "[quick][io]") {
  Document d;
  d.node({{"mesh", d.quad_mesh()}});
  const int up = d.floats(Places(4, Vec3d{0, 0, 1})), along = d.floats(Places(4, Vec3d{2, 0, 0}));
  d.json["meshes"][0]["primitives"][0]["targets"] = Json::array({{{"POSITION", up}}, {{"POSITION", along}}});
  CHECK(corners_of(d)[0] == Vec3d{0, 0, 0});
  d.json["meshes"][0]["weights"] = {0.5, 0.25};
  CHECK(corners_of(d)[0] == Vec3d{0.5, 0, 0.5});
  d.json["nodes"][0]["weights"] = {0, 1};
  CHECK(corners_of(d)[0] == Vec3d{2, 0, 0});
  ScenePose base;
  base.base = true;
  SceneOptions options;
  options.pose = std::make_shared<const ScenePose>(base);
  CHECK(corners_of(d, options)[0] == Vec3d{0, 0, 0});
}

TEST_CASE("broken skins are refused by name", "[quick][io]") {
  const auto complaint = [](const auto& change) {
    Document d = skinned_quad(halves(), {});
    change(d);
    return complaint_of(d);
  };
  CHECK_THAT(complaint([](Document& d) {
               d.json["skins"][0]["joints"] = {1, 7};
             }),
             Contains("skins[0] has the joint 7 outside the scene"));
  CHECK_THAT(complaint([](Document& d) { d.json["scenes"][0]["nodes"] = {0}; }), Contains("the joint 1 outside"));
  CHECK_THAT(complaint([](Document& d) { d.json["skins"][0]["joints"] = Json::array(); }), Contains("has no joints"));
  CHECK_THAT(complaint([](Document& d) { d.json["skins"][0]["joints"] = {1}; }), Contains("name the joint 1"));
  CHECK_THAT(complaint([](Document& d) {
               d.json["skins"][0]["inverseBindMatrices"] = d.array(std::vector<float>(16, 1), kF32, "MAT4", 1);
             }),
             Contains("has 2 joints and 1 matrices"));
  CHECK_THAT(complaint([](Document& d) {
               d.json["meshes"][0]["primitives"][0]["attributes"]["JOINTS_0"] =
                   d.array(std::vector<float>(16, std::nanf("")), kF32, "VEC4", 4);
             }),
             Contains("JOINTS_0 that are not unsigned integers"));
  CHECK_THAT(complaint([](Document& d) {
               d.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] = d.quad();
             }),
             Contains("has a skin and stands in many places"));
  CHECK_THAT(complaint([](Document& d) { d.json["meshes"][0]["primitives"][0]["attributes"].erase("WEIGHTS_0"); }),
             Contains("name no joints"));
}

TEST_CASE("many sets of joints count together against the memory for documents", "[quick][io]") {
  Document d = skinned_quad(halves(), {});
  Json& attributes = d.json["meshes"][0]["primitives"][0]["attributes"];
  for (int set = 1; set < 2000; ++set) {
    attributes["JOINTS_" + std::to_string(set)] = attributes["JOINTS_0"];
    attributes["WEIGHTS_" + std::to_string(set)] = attributes["WEIGHTS_0"];
  }
  SceneOptions options;
  options.document = MemoryShare{std::uint64_t(64) << 20};
  CHECK(corners_of(d, options).size() == 4);
  options.document = MemoryShare{std::uint64_t(2000) * 8 * 8 * 4 - 1};
  CHECK_THROWS_AS(corners_of(d, options), Error);
}

TEST_CASE("meshes that have moved the same way are kept once", "[quick][io]") {
  Document d = skinned_quad(halves(), {});
  for (int i = 0; i < 5000; ++i) d.json["scenes"][0]["nodes"].push_back(d.node({{"mesh", 0}, {"skin", 0}}));
  const TempDir dir;
  const IndexedMesh mesh = read_mesh(dir.file("skinned.glb", d.glb()));
  CHECK(mesh.triangles.size() == 2 * 5001);
}

TEST_CASE("meshes with a skin or morph targets are counted, since no copy of them bends", "[quick][io]") {
  const TempDir dir;
  Document d = skinned_quad(halves(), {});
  CHECK(counts_of(dir.file("skin.glb", d.glb())).posed == 1);
  CHECK_THAT(skipped(counts_of(dir.path("skin.glb"))),
             Contains("1 mesh loses its skin or morph targets, and stays as the file shows it"));
}
