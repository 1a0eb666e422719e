#include <numeric>
#include <random>

#include "lib/meshing/box_tree.h"
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

TEST_CASE("a query of the tree of boxes stops when told to, and leaves out what is not to be kept",
          "[quick][meshing]") {
  std::vector<LatticeBox> boxes;
  for (std::int64_t x = 0; x < 300; ++x) boxes.push_back({{x, 0, 0}, {x, 1, 1}});
  std::vector<std::uint32_t> items(boxes.size());
  std::iota(items.begin(), items.end(), 0u);
  BoxTree tree;
  tree.build(boxes, items);
  int visits = 0;
  CHECK_FALSE(tree.query({{0, 0, 0}, {400, 1, 1}}, [&](std::uint32_t) { return ++visits < 7; }));
  CHECK(visits == 7);
  visits = 0;
  const auto right = [](const LatticeBox& b) { return b.max.x >= 250; };
  CHECK(tree.query({{0, 0, 0}, {400, 1, 1}}, right, [&](std::uint32_t item) {
    ++visits;
    return item >= 250;
  }));
  CHECK(visits == 50);
}
