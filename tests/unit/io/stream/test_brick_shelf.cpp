#include <atomic>
#include <filesystem>
#include <map>
#include <random>
#include <thread>

#include "io/store/brick_codec.h"
#include "io/stream/brick_shelf.h"
#include "lib/core/error.h"
#include "tests/catch.h"

using namespace bp;

namespace {

const std::string kTemp = std::filesystem::temp_directory_path().string();

/// Kind 0: noise (does not compress), 1: a box, 2: one voxel, 3: full, 4: empty.
BrickBits bits_of(int kind, std::uint32_t seed) {
  std::mt19937_64 random(seed);
  BrickBits bits{};
  switch (kind) {
    case 0:
      for (std::uint64_t& w : bits) w = random();
      break;
    case 1:
      for (std::size_t i = 0; i < kBrickWords; ++i) bits[i] = (i / 64 > random() % 4 + 20 && i % 64 < 30) ? 0xfff0 : 0;
      bits[4095] = 1;
      break;
    case 2:
      bits[random() % kBrickWords] = std::uint64_t(1) << (random() % 64);
      break;
    case 3:
      bits.fill(~std::uint64_t(0));
      break;
    default:
      break;
  }
  return bits;
}

int holding(const BrickShelf& shelf, const std::map<BrickCoord, BrickBits>& expected) {
  int good = 0;
  BrickBits got;
  for (const auto& [coord, bits] : expected) {
    const BrickFill fill = shelf.get(coord, got);
    good += got == bits && fill == classify(bits) && shelf.fill(coord) == fill;
  }
  return good;
}

}  // namespace

TEST_CASE("the planes of a brick are columns of eight voxels", "[quick][io]") {
  BrickBits bits{}, back;
  bits[5 * 64 + 9] = std::uint64_t(0xa5) << 24;  // voxels 24..31 of the row y = 9, z = 5
  std::vector<std::byte> planes(detail::kBrickBytes);
  detail::to_planes(bits, planes.data());
  for (std::size_t i = 0; i < planes.size(); ++i) {
    if (planes[i] != std::byte(i == 3 * 4096 + 5 * 64 + 9 ? 0xa5 : 0)) FAIL_CHECK("byte " << i);
  }
  const BrickBits noise = bits_of(0, 1);
  detail::to_planes(noise, planes.data());
  detail::from_planes(planes.data(), back);
  CHECK(back == noise);
}

TEST_CASE("a shelf gives back what was put, whatever its budget", "[quick][io]") {
  const std::uint64_t budget = GENERATE(0u, 1u, 5000u, 100000u, 400000u, 1u << 28);
  CAPTURE(budget);
  const ShelfPool pool(budget, kTemp);
  const std::unique_ptr<BrickShelf> shelf = pool.make();
  std::map<BrickCoord, BrickBits> expected;
  std::mt19937 random(3);
  for (int i = 0; i < 300; ++i) {
    const BrickCoord c{int(random() % 5) - 2, int(random() % 5) - 2, int(random() % 3)};
    if (random() % 5 == 0) {
      shelf->drop(c);
      expected.erase(c);
      continue;
    }
    const int kind = int(random() % 5);
    const BrickBits bits = bits_of(kind, random());
    shelf->put(c, classify(bits), bits);
    expected.erase(c);
    if (kind != 4) expected[c] = bits;
    if (i % 50 == 0) CHECK(holding(*shelf, expected) == int(expected.size()));
  }
  CHECK(holding(*shelf, expected) == int(expected.size()));
  std::vector<BrickCoord> coords;
  for (const auto& [c, bits] : expected) coords.push_back(c);
  CHECK(shelf->coords() == coords);
  BrickBits none;
  CHECK(shelf->get({77, 0, 0}, none) == BrickFill::empty);
  CHECK(none == BrickBits{});
  const std::uint64_t index = 75 * 80 + 75 * 33 * 4;  // never refused
  CHECK(pool.use().peak_memory_bytes <= budget + index);
  CHECK((pool.use().peak_scratch_bytes > 0) == (budget < 1000000));
}

TEST_CASE("an emptied shelf leaves nothing in its pool", "[quick][io]") {
  const ShelfPool pool(200000, kTemp);
  {
    const std::unique_ptr<BrickShelf> a = pool.make(), b = pool.make();
    for (int i = 0; i < 40; ++i) {
      a->put({i, 0, 0}, BrickFill::mixed, bits_of(i % 2, std::uint32_t(i)));
      b->put({i, 0, 0}, BrickFill::mixed, bits_of(i % 2, std::uint32_t(i)));
    }
    for (int i = 0; i < 40; ++i) a->drop({i, 0, 0});
    CHECK(a->coords().empty());
    CHECK(b->coords().size() == 40);
  }
  CHECK(pool.use().memory_bytes == 0);
  CHECK(pool.use().scratch_bytes == 0);
  CHECK(pool.use().peak_memory_bytes > 100000);
}

TEST_CASE("free space in the scratch file is reused", "[quick][io]") {
  const ShelfPool pool(0, kTemp);
  const std::unique_ptr<BrickShelf> shelf = pool.make();
  for (int i = 0; i < 400; ++i) {
    shelf->put({i, 0, 0}, BrickFill::mixed, bits_of(i % 3, std::uint32_t(i)));
    if (i >= 10) shelf->drop({i - 10, 0, 0});
  }
  CHECK(pool.use().peak_scratch_bytes <= 11 * 33 * 1024);
  BrickBits got;
  for (int i = 390; i < 400; ++i) {
    CHECK(shelf->get({i, 0, 0}, got) == BrickFill::mixed);
    CHECK(got == bits_of(i % 3, std::uint32_t(i)));
  }
}

TEST_CASE("full bricks cost an index entry and nothing else", "[quick][io]") {
  const ShelfPool pool(1 << 20, kTemp);
  const std::unique_ptr<BrickShelf> shelf = pool.make();
  const BrickBits nothing{};  // the bits of a full brick are not looked at
  for (int i = 0; i < 1000; ++i) shelf->put({i, 1, 2}, BrickFill::full, nothing);
  CHECK(pool.use().memory_bytes <= 100000);
  CHECK(pool.use().peak_scratch_bytes == 0);
  BrickBits got;
  CHECK(shelf->get({999, 1, 2}, got) == BrickFill::full);
  CHECK(got == bits_of(3, 0));
}

TEST_CASE("bricks that lie raw are compressed before any goes to disk", "[quick][io]") {
  std::vector<std::byte> planes(detail::kBrickBytes), packed;
  detail::to_planes(bits_of(1, 0), planes.data());
  detail::compress(planes, detail::kDefaultLevel, false, packed);
  // Room for all 1500 compressed bricks and their index, but not beside a half that lies raw.
  const std::uint64_t budget = 1500 * (packed.size() + 80) * 5 / 4;
  REQUIRE(budget / 2 > 64 * detail::kBrickBytes / 8);
  const ShelfPool pool(budget, kTemp);
  const std::unique_ptr<BrickShelf> shelf = pool.make();
  std::map<BrickCoord, BrickBits> expected;
  for (int i = 0; i < 1500; ++i) {
    expected[{i, 0, 0}] = bits_of(1, std::uint32_t(i % 20));
    shelf->put({i, 0, 0}, BrickFill::mixed, expected[{i, 0, 0}]);
  }
  CHECK(pool.use().memory_bytes <= budget);
  CHECK(pool.use().peak_scratch_bytes == 0);
  CHECK(holding(*shelf, expected) == 1500);
}

TEST_CASE("many threads share shelves under a tiny budget", "[quick][io]") {
  const std::uint64_t budget = GENERATE(0u, 150000u, 1500000u);
  const ShelfPool pool(budget, kTemp);
  const std::unique_ptr<BrickShelf> a = pool.make(), b = pool.make();
  std::atomic<int> wrong{0};
  const auto work = [&](int t) {
    BrickBits got;
    for (int round = 0; round < 3; ++round) {
      for (int i = 0; i < 20; ++i) {
        BrickShelf& shelf = i % 2 ? *a : *b;
        const BrickBits bits = bits_of((i + round) % 5, std::uint32_t(100 * t + i + round));
        shelf.put({t, i, round}, classify(bits), bits);
        if (shelf.get({t, i, round}, got) != classify(bits) || got != bits) ++wrong;
        if (i % 3 == 0) shelf.drop({t, i, round});
        if (i % 3 == 0 && shelf.fill({t, i, round}) != BrickFill::empty) ++wrong;
        (void)shelf.get({(t + 1) % 8, i, round}, got);  // a neighbour may be at work on it
      }
    }
  };
  std::vector<std::thread> threads;
  for (int t = 0; t < 8; ++t) threads.emplace_back(work, t);
  for (std::thread& t : threads) t.join();
  CHECK(wrong == 0);
  BrickBits got;
  for (const BrickCoord c : a->coords()) {
    const BrickBits bits = bits_of((c.y + c.z) % 5, std::uint32_t(100 * c.x + c.y + c.z));
    CHECK((a->get(c, got) == classify(bits) && got == bits));
  }
}

TEST_CASE("voxels stored on a shelf load again in any box", "[quick][io]") {
  const std::unique_ptr<BrickShelf> shelf = make_shelf(100000, kTemp);
  BitBox all({{-64, -64, 0}, {128, 64, 128}});
  std::mt19937 random(5);
  for (int i = 0; i < 5000; ++i) all.set({int(random() % 192) - 64, int(random() % 128) - 64, int(random() % 100)});
  store_voxels(all, *shelf);
  BitBox part({{-40, -30, 20}, {70, 33, 99}});
  load_voxels(*shelf, part);
  BitBox expected(part.box());
  copy_voxels(all, expected);
  CHECK(part == expected);
}

TEST_CASE("more bricks than the index has room for are refused, and bricks that go make room", "[quick][io]") {
  const std::uint64_t budget = GENERATE(0u, 100000u);
  const ShelfPool pool(budget, kTemp);
  const std::unique_ptr<BrickShelf> shelf = pool.make();
  const auto room = std::int32_t((budget + (4 << 20)) / 80);
  const BrickBits full = bits_of(1, 0);
  for (std::int32_t i = 0; i < room; ++i) shelf->put({i, 0, 0}, BrickFill::full, full);
  try {
    shelf->put({room, 0, 0}, BrickFill::full, full);
    FAIL("no error");
  } catch (const Error& e) {
    CHECK(e.code() == ErrorCode::out_of_resource);
    CHECK(std::string(e.what()).find("the index of " + std::to_string(room) + " bricks") != std::string::npos);
  }
  CHECK(shelf->fill({room, 0, 0}) == BrickFill::empty);
  shelf->put({0, 0, 0}, BrickFill::full, full);  // one that is there takes no other entry
  shelf->drop({7, 0, 0});
  shelf->put({room, 0, 0}, BrickFill::full, full);
  CHECK(pool.use().memory_bytes == std::uint64_t(room) * 80);
}

TEST_CASE("a scratch directory that does not exist is named", "[quick][io]") {
  const std::unique_ptr<BrickShelf> shelf = make_shelf(0, "/nowhere/at/all");
  try {
    shelf->put({0, 0, 0}, BrickFill::mixed, bits_of(2, 0));
    FAIL("no error");
  } catch (const Error& e) {
    CHECK(e.code() == ErrorCode::out_of_resource);
    CHECK(std::string(e.what()).find("/nowhere/at/all") != std::string::npos);
  }
  CHECK(shelf->fill({0, 0, 0}) == BrickFill::empty);
}
