#include <random>

#include "io/store/scratch.h"
#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "tests/catch.h"

using namespace bp;

TEST_CASE("chunks come back as they were, from memory and from scratch", "[quick][io]") {
  const std::uint64_t memory = GENERATE(as<std::uint64_t>{}, 0, 20000, 1 << 30);
  const auto store = make_scratch(memory, ".");
  std::mt19937 rng(1);
  std::vector<std::vector<std::byte>> chunks(200);
  for (std::size_t i = 0; i < chunks.size(); ++i) {
    chunks[i].resize(rng() % 5000);
    for (auto& b : chunks[i]) b = std::byte(rng() % (1 + i));
  }
  std::vector<Scratch::Handle> handles(chunks.size());
  parallel_for(200, [&](std::int64_t i) { handles[std::size_t(i)] = store->put(chunks[std::size_t(i)]); });
  for (std::size_t i = 0; i < chunks.size(); i += 3) store->drop(handles[i]);
  std::vector<std::byte> back;
  for (std::size_t i = 0; i < chunks.size(); ++i) {
    if (i % 3 == 0) continue;
    store->get(handles[i], back);
    REQUIRE(back == chunks[i]);
  }
  CHECK((store->scratch_bytes() > 0) == (memory < 100000));
  const std::uint64_t index = 133 * 100;  // of those that are left
  CHECK(store->memory_bytes() >= index);
  CHECK((store->memory_bytes() > index) == (memory > 0));
  CHECK(store->memory_bytes() <= memory + index);  // which chunks came first is chance; the index is never refused
  for (std::size_t i = 0; i < chunks.size(); ++i) store->drop(handles[i]);
  CHECK(store->memory_bytes() == 0);
}

TEST_CASE("a store whose directory is missing fails when it needs it", "[quick][io]") {
  const auto store = make_scratch(200, "./no-such-directory");
  const std::vector<std::byte> small(50), large(1000000);
  CHECK_NOTHROW(store->put(small));
  std::vector<std::byte> noise(5000);
  std::mt19937 rng(1);
  for (auto& b : noise) b = std::byte(rng());
  CHECK_THROWS_AS(store->put(noise), Error);
}
