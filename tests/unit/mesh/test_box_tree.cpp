#include <numeric>
#include <random>

#include "lib/mesh/box_tree.h"
#include "tests/catch.h"

using namespace bp;

namespace {

class RandomBoxes {
 public:
  explicit RandomBoxes(unsigned seed) : random_(seed) {}

  /// Mostly small; some long, some flat, some far beyond 2^31 units.
  LatticeBox next() {
    LatticeCoord low, size;
    for (int i = 0; i < 3; ++i) {
      low[i] = between(-5000, 5000);
      size[i] = between(0, between(0, 9) == 0 ? 4000 : 60);
    }
    if (between(0, 99) == 0) low.x += std::int64_t(1) << between(30, 40);
    return {low, low + size};
  }
  std::int64_t between(std::int64_t low, std::int64_t high) {
    return std::uniform_int_distribution<std::int64_t>(low, high)(random_);
  }

 private:
  std::mt19937 random_;
};

std::vector<std::uint32_t> found(const BoxTree& tree, const LatticeBox& box) {
  std::vector<std::uint32_t> items;
  tree.query(box, [&](std::uint32_t item) {
    items.push_back(item);
    return true;
  });
  std::sort(items.begin(), items.end());
  return items;
}

}  // namespace

TEST_CASE("the tree of boxes finds what meets a box, and nothing else, as boxes change and go", "[quick][meshing]") {
  const int count = GENERATE(0, 1, 8, 9, 64, 65, 700, 5000);
  RandomBoxes random(unsigned(count) + 1);
  std::vector<LatticeBox> boxes;
  for (int i = 0; i < 2 * count; ++i) boxes.push_back(random.next());
  std::vector<std::uint32_t> items;  // every other one
  for (std::uint32_t i = 0; i < boxes.size(); i += 2) items.push_back(i);
  BoxTree tree;
  tree.build(boxes, items);
  CHECK(tree.size() == items.size());
  for (int round = 0; round < 60; ++round) {
    const LatticeBox box = random.next();
    std::vector<std::uint32_t> expected;
    for (const std::uint32_t i : items) {
      if (boxes[i].meets(box)) expected.push_back(i);
    }
    CAPTURE(count, round);
    REQUIRE(found(tree, box) == expected);
    if (items.empty()) continue;
    const std::uint32_t changed = items[std::size_t(random.between(0, std::int64_t(items.size()) - 1))];
    boxes[changed] = random.next();
    tree.update(changed, boxes[changed]);
    const auto gone = items.begin() + random.between(0, std::int64_t(items.size()) - 1);
    if (round % 2 != 0) continue;
    tree.remove(*gone);
    items.erase(gone);
  }
}

TEST_CASE("a query of the tree of boxes stops when told to", "[quick][meshing]") {
  std::vector<LatticeBox> boxes;
  for (std::int64_t x = 0; x < 300; ++x) boxes.push_back({{x, 0, 0}, {x, 1, 1}});
  std::vector<std::uint32_t> items(boxes.size());
  std::iota(items.begin(), items.end(), 0u);
  BoxTree tree;
  tree.build(boxes, items);
  int visits = 0;
  CHECK_FALSE(tree.query({{0, 0, 0}, {400, 1, 1}}, [&](std::uint32_t) { return ++visits < 7; }));
  CHECK(visits == 7);
}

TEST_CASE("a query of the tree of boxes with a plane leaves out boxes on its inner side only, and most of those",
          "[quick][meshing]") {
  RandomBoxes random(4);
  const bool far_ones = GENERATE(false, true);  // clamped ones: then it leaves out none
  std::vector<LatticeBox> boxes;
  while (boxes.size() < 3000) {
    boxes.push_back(random.next());
    if (!far_ones && boxes.back().max.x > 100000) boxes.pop_back();
  }
  std::vector<std::uint32_t> items(boxes.size());
  std::iota(items.begin(), items.end(), 0u);
  BoxTree tree;
  tree.build(boxes, items);
  std::size_t inside = 0, left_out = 0;
  for (int round = 0; round < 200; ++round) {
    LatticeBox box = random.next();
    box.add(box.min + LatticeCoord{3000, 3000, 3000});
    const BoxTree::Plane plane{{random.between(-5000, 5000), random.between(-5000, 5000), random.between(-5000, 5000)},
                               {double(random.between(-9, 9)), double(random.between(-9, 9)), 1}};
    std::vector<char> seen(boxes.size(), 0);
    CHECK(tree.query_groups(box, plane, [&](std::uint32_t first, std::uint32_t hits) {
      for (std::uint32_t k = 0; k < 8; ++k) {
        if ((hits >> k) & 1) seen[tree.order()[first + k]] = 1;
      }
      return true;
    }));
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      double farthest = 0;  // small integers: exact
      for (int axis = 0; axis < 3; ++axis) {
        const double n = plane.normal[std::size_t(axis)];
        farthest += n * double((n > 0 ? boxes[i].max[axis] : boxes[i].min[axis]) - plane.point[axis]);
      }
      if (!boxes[i].meets(box)) {
        REQUIRE(!seen[i]);
      } else if (farthest >= 0) {
        REQUIRE(seen[i]);
      } else {
        ++inside;
        left_out += !seen[i];
      }
    }
  }
  CHECK(inside > 1000);
  CHECK(double(left_out) > (far_ones ? -1 : 0.9) * double(inside));
}

TEST_CASE("groups gathered around a box answer queries within it in the same order as the tree", "[quick][meshing]") {
  const int count = GENERATE(0, 5, 9, 300, 2000, 5000);
  RandomBoxes random(unsigned(count) + 7);
  std::vector<LatticeBox> boxes;
  while (int(boxes.size()) < count) boxes.push_back(random.next());
  std::vector<std::uint32_t> items(boxes.size());
  std::iota(items.begin(), items.end(), 0u);
  BoxTree tree;
  tree.build(boxes, items);
  BoxTree::Nearby nearby;
  int complete = 0;
  for (int round = 0; round < 200; ++round) {
    const LatticeBox inner = random.next();
    tree.gather(inner.grown(round % 3 == 0 ? 9000 : 200), nearby);
    if (!nearby.complete()) continue;
    ++complete;
    const BoxTree::Plane plane{inner.min, {double(random.between(-9, 9)), double(random.between(-9, 9)), 1}};
    std::vector<std::pair<std::uint32_t, std::uint32_t>> from_tree, from_groups;
    const auto note = [](auto& list) {
      return [&list](std::uint32_t first, std::uint32_t hits) {
        list.emplace_back(first, hits);
        return list.size() < 20;
      };
    };
    const bool all = tree.query_groups(inner, plane, note(from_tree));
    CHECK(tree.query_groups(nearby, inner, plane, note(from_groups)) == all);
    CHECK(from_groups == from_tree);
  }
  if (count <= 8) {
    CHECK(complete == 0);  // there are no groups of groups
  } else if (count <= 2000) {
    CHECK(complete == 200);
  } else {
    CHECK(complete < 200);
  }
}
