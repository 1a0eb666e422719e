#include "lib/exact/triangle_intersection.h"
#include "lib/mesh/guard.h"
#include "tests/catch.h"
#include "tests/support/lattice_boxes.h"
#include "tests/support/random_lattice.h"

using namespace bp;
using namespace bp::test;

namespace {

/// A few boxes that lie close to each other, and tetrahedra on some of them: many small changes meet something.
LatticeMesh neighbours() {
  LatticeMesh mesh;
  add_box(mesh, {{0, 0, 0}, {100, 100, 100}});
  add_box(mesh, {{110, 0, 0}, {160, 100, 100}});
  add_box(mesh, {{0, 0, 112}, {100, 40, 150}});
  add_box(mesh, {{40, 110, 20}, {60, 130, 60}});
  add_tetrahedron(mesh, {50, 70, 160}, 105, 30);
  add_tetrahedron(mesh, {-30, 50, 80}, 20, 20);
  return mesh;
}

/// The definition: each new face meets the others, and the faces that stay, in shared corners and edges only.
bool is_free(const HalfEdgeMesh& mesh, const std::vector<NewFace>& faces, const std::vector<FaceId>& replaced) {
  std::vector<LatticeCoord> places(mesh.vertex_capacity());
  for (VertexId v = 0; v < mesh.vertex_capacity(); ++v) places[v] = mesh.position(v);
  std::vector<Triangle> all;
  for (const NewFace& f : faces) {
    for (std::size_t k = 0; k < 3; ++k) places[f.ids[k]] = f.corners[k];
    all.push_back(f.ids);
  }
  for (FaceId f = 0; f < mesh.face_capacity(); ++f) {
    if (mesh.alive(f) && std::find(replaced.begin(), replaced.end(), f) == replaced.end())
      all.push_back({mesh.from(3 * f), mesh.from(3 * f + 1), mesh.from(3 * f + 2)});
  }
  for (std::size_t i = 0; i < faces.size(); ++i) {
    for (std::size_t j = i + 1; j < all.size(); ++j) {
      if (triangles_meet_beyond_shared(places.data(), all[i], all[j])) return false;
    }
  }
  return true;
}

/// The faces around a vertex as they are once it has moved; false if one of them has no area.
bool star_at(const HalfEdgeMesh& mesh, VertexId v, const LatticeCoord& to, std::vector<NewFace>& star,
             std::vector<FaceId>& replaced) {
  star.clear(), replaced.clear();
  mesh.for_each_outgoing(v, [&](HalfEdgeId h) {
    star.push_back(
        {{v, mesh.to(h), mesh.opposite(h)}, {to, mesh.position(mesh.to(h)), mesh.position(mesh.opposite(h))}});
    replaced.push_back(HalfEdgeMesh::face(h));
  });
  return std::none_of(star.begin(), star.end(), [](const NewFace& f) {
    return normal_of(f.corners[0], f.corners[1], f.corners[2]) == LatticeCoord{};
  });
}

bool only_grows(const HalfEdgeMesh& mesh, const std::vector<FaceId>& replaced, const LatticeCoord& to) {
  return std::all_of(replaced.begin(), replaced.end(), [&](FaceId f) {
    return orient3d(mesh.corner(f, 0), mesh.corner(f, 1), mesh.corner(f, 2), to) >= 0;
  });
}

struct Answers {
  int yes = 0, no = 0;
  void add(bool answer) { (answer ? yes : no) += 1; }
};

}  // namespace

TEST_CASE("the guard allows a moved vertex exactly where nothing meets", "[quick][meshing]") {
  const HalfEdgeMesh mesh(neighbours());
  const FaceTree tree(mesh);
  Guard guard(mesh, tree);
  RandomLattice random(GENERATE(1u, 2u, 3u));
  std::vector<NewFace> star;
  std::vector<FaceId> replaced;
  Answers answers;
  for (int i = 0; i < 3000; ++i) {
    const auto v = VertexId(random.between(0, mesh.vertex_capacity() - 1));
    const std::int64_t far = random.between(0, 3) == 0 ? 150 : 15;
    if (!star_at(mesh, v, mesh.position(v) + random.point(-far, far), star, replaced)) continue;
    const bool free = is_free(mesh, star, replaced);
    CAPTURE(i, v, free);
    REQUIRE(guard.star_is_free(star, replaced) == free);
    answers.add(free);
  }
  CHECK(answers.yes > 500);
  CHECK(answers.no > 500);
}

TEST_CASE("the guard allows a star that grows exactly where nothing meets", "[quick][meshing]") {
  const HalfEdgeMesh mesh(neighbours());
  const FaceTree tree(mesh);
  Guard guard(mesh, tree);
  RandomLattice random(GENERATE(4u, 5u, 6u));
  std::vector<NewFace> star;
  std::vector<FaceId> replaced;
  Answers answers;
  for (int i = 0; i < 20000; ++i) {
    const auto v = VertexId(random.between(0, mesh.vertex_capacity() - 1));
    const std::int64_t far = random.between(0, 2) == 0 ? 150 : 20;
    const LatticeCoord to = mesh.position(v) + random.point(-far, far);
    if (!star_at(mesh, v, to, star, replaced) || !only_grows(mesh, replaced, to)) continue;
    std::vector<LatticeCoord> normals;
    LatticeBox box{mesh.position(v), mesh.position(v)};
    for (const FaceId f : replaced) {
      normals.push_back(normal_of(mesh.corner(f, 0), mesh.corner(f, 1), mesh.corner(f, 2)));
      for (int k = 0; k < 3; ++k) box.add(mesh.corner(f, k));
    }
    const bool free = is_free(mesh, star, replaced);
    CAPTURE(i, v, free);
    const bool first = guard.grown_star_is_free(star, replaced, {normals, box});
    if (!first) REQUIRE_FALSE(free);
    REQUIRE((first && guard.rest_is_free(star)) == free);
    answers.add(free);
  }
  CHECK(answers.yes > 200);
  CHECK(answers.no > 200);
}

TEST_CASE("the guard allows a flipped edge exactly where nothing meets", "[quick][meshing]") {
  LatticeMesh moved = neighbours();
  RandomLattice random(GENERATE(7u, 8u, 9u));
  for (LatticeCoord& p : moved.vertices) p = p + random.point(-4, 4);  // so that quads are not flat
  const HalfEdgeMesh mesh(moved);
  const FaceTree tree(mesh);
  Guard guard(mesh, tree);
  Answers answers;
  for (HalfEdgeId h = 0; h < 3 * mesh.face_capacity(); ++h) {
    if (mesh.edge(h) != h || !mesh.can_flip(h)) continue;
    const HalfEdgeId t = mesh.twin(h);
    const VertexId a = mesh.opposite(h), b = mesh.opposite(t);
    const auto face = [&](VertexId x, VertexId y, VertexId z) {
      return NewFace{{x, y, z}, {mesh.position(x), mesh.position(y), mesh.position(z)}};
    };
    const std::vector<NewFace> faces{face(b, a, mesh.from(h)), face(a, b, mesh.to(h))};
    const bool flat = std::any_of(faces.begin(), faces.end(), [](const NewFace& f) {
      return normal_of(f.corners[0], f.corners[1], f.corners[2]) == LatticeCoord{};
    });
    if (flat) continue;
    const std::vector<FaceId> replaced{HalfEdgeMesh::face(h), HalfEdgeMesh::face(t)};
    const bool free = is_free(mesh, faces, replaced);
    CAPTURE(h, free);
    REQUIRE(guard.faces_are_free(faces, replaced) == free);
    answers.add(free);
  }
  CHECK(answers.yes > 10);
}
