#include <set>

#include "lib/core/grid_frame.h"
#include "lib/pass/voxelize/detail/surface_chunks.h"
#include "lib/store/packing.h"
#include "lib/store/result_key.h"
#include "tests/catch.h"
#include "tests/support/each_member.h"

namespace bp::test {

namespace {

struct Inner {
  std::array<std::int64_t, 3> place{};
  UpAxis axis = UpAxis::y;
  friend bool operator==(const Inner&, const Inner&) = default;
};

struct Sample {
  bool flag = false;
  std::uint8_t small = 1;
  double number = 2;
  std::string text = "text";
  std::vector<std::string> list{"a", "bc"};
  std::vector<Inner> inner{{}, {{1, 2, 3}, UpAxis::z}};
  Inner last;
  friend bool operator==(const Sample&, const Sample&) = default;
};

ResultKey key_of(const Sample& s) {
  return KeyHash("test").add(s).key();
}

}  // namespace

TEST_CASE("a key depends on every member of a struct", "[quick][cache]") {
  Sample sample;
  std::set<ResultKey> keys{key_of(sample)};
  change_each_member(sample.flag, [&] { keys.insert(key_of(sample)); });
  change_each_member(sample.small, [&] { keys.insert(key_of(sample)); });
  change_each_member(sample.number, [&] { keys.insert(key_of(sample)); });
  change_each_member(sample.text, [&] { keys.insert(key_of(sample)); });
  for (std::string& s : sample.list) change_each_member(s, [&] { keys.insert(key_of(sample)); });
  for (Inner& i : sample.inner) change_each_member(i, [&] { keys.insert(key_of(sample)); });
  change_each_member(sample.last, [&] { keys.insert(key_of(sample)); });
  CHECK(keys.size() == 1 + 4 + 2 + 3 * 4);
  CHECK(keys.count(key_of(Sample{})) == 1);
}

TEST_CASE("a key depends on how values are shared among lists and texts", "[quick][cache]") {
  using Lists = std::vector<std::vector<int>>;
  CHECK(KeyHash("a").add(Lists{{1}, {2}}).key() != KeyHash("a").add(Lists{{1, 2}, {}}).key());
  CHECK(KeyHash("a").add(std::optional<int>(0)).key() != KeyHash("a").add(std::optional<int>()).key());
  CHECK(KeyHash("a").add(1, 2.0, "x").key() == KeyHash("a").add(1).add(2.0).add(std::string("x")).key());
}

TEST_CASE("a chunk's key depends on its triangles and on every member of the frame", "[quick][cache]") {
  ChunkCutter::Chunk chunk{5, {{1, 2}}};
  GridFrame frame;
  std::set<ResultKey> keys{chunk_key(chunk, frame)};
  change_each_member(chunk, [&] { keys.insert(chunk_key(chunk, frame)); });
  change_each_member(frame, [&] { keys.insert(chunk_key(chunk, frame)); });
  CHECK(keys.size() == 1 + 3 + 5);
}

TEST_CASE("what was packed comes back, and fewer bytes are refused", "[quick][cache]") {
  Sample sample;
  sample.number = -0.5;
  sample.last = {{7, -8, 9}, UpAxis::x};
  std::string bytes;
  pack(bytes, sample);
  std::string_view in = bytes;
  Sample back;
  CHECK(unpack(in, back));
  CHECK(in.empty());
  CHECK(back == sample);
  for (std::size_t n = 0; n < bytes.size(); ++n) {
    std::string_view part = std::string_view(bytes).substr(0, n);
    CAPTURE(n);
    CHECK_FALSE(unpack(part, back));
  }
  std::string_view huge("\xff\xff\xff\xff\xff\xff\xff\x7f", 8);  // a length without its elements
  std::vector<Inner> none;
  CHECK_FALSE(unpack(huge, none));
}

}  // namespace bp::test
