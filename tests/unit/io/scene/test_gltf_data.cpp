// Data of glTF that contradict themselves.
#include "io/gltf/meshopt_codec.h"
#include "tests/catch.h"
#include "tests/unit/io/scene/gltf_document.h"

using namespace bp;
using namespace bp::test;

TEST_CASE("numbers of sparse glTF accessors must rise and name elements", "[quick][io]") {
  const TempDir dir;
  for (const auto& [first, second] : {std::pair{3, 1}, {1, 1}, {1, 4}, {65535, 65535}}) {
    Document d;
    const std::string numbers = raw(std::uint16_t(first)) + raw(std::uint16_t(second)), values(24, '\0');
    const int quad = d.quad();
    d.json["accessors"][std::size_t(quad)]["sparse"] = {
        {"count", 2},
        {"indices", {{"bufferView", d.view(numbers)}, {"componentType", kU16}}},
        {"values", {{"bufferView", d.view(values)}}}};
    d.node({{"mesh", d.mesh(quad, -1, 6)}});
    CHECK_THAT(complaint_of(dir.file("sparse.glb", d.glb())), Contains("must rise"));
  }
}

TEST_CASE("glTF data that are there twice are compared", "[quick][io]") {
  const TempDir dir;
  const auto differing = [&](const std::string& plain, const std::vector<TriangleD>& packed, bool required) {
    Document d;
    std::string floats;
    for (const TriangleD& t : packed)
      for (const Vec3d& p : t)
        for (const double c : p) floats += raw(float(c));
    const std::string bytes = encode_attributes(floats, 12);
    const int view = d.view(plain.empty() ? floats : plain, 12), data = d.view(bytes);
    const Json where = d.json["bufferViews"][std::size_t(data)];
    d.json["bufferViews"][std::size_t(view)]["extensions"]["EXT_meshopt_compression"] = {
        {"buffer", 0},
        {"byteOffset", where.value("byteOffset", 0)},
        {"byteLength", bytes.size()},
        {"count", 3 * packed.size()},
        {"byteStride", 12},
        {"mode", "ATTRIBUTES"}};
    if (required) d.json["extensionsRequired"] = {"EXT_meshopt_compression"};
    const int positions =
        d.accessor({{"bufferView", view}, {"componentType", kF32}, {"count", 3 * packed.size()}, {"type", "VEC3"}});
    d.node({{"mesh", d.mesh(positions)}});
    const std::string path = dir.file("twice.glb", d.glb());
    CHECK(read_all(path) == packed);
    CHECK(read_mesh(path).differing == counts_of(path).differing);
    return counts_of(path).differing;
  };
  const std::string zeros(2 * 36, '\0');
  CHECK(differing("", kQuadFan, false) == 0);
  CHECK(differing(zeros, kQuadFan, false) == 1);
  CHECK(differing(zeros, kQuadFan, true) == 0);  // nobody may read the plain ones
}
