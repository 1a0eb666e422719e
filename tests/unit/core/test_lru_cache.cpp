#include <atomic>

#include "lib/core/lru_cache.h"
#include "lib/core/parallel.h"
#include "tests/catch.h"

namespace bp {

namespace {

struct Number {
  std::uint32_t value;
  [[nodiscard]] static std::uint64_t bytes() { return 10; }
};

/// Counts what is made.
struct Maker {
  LruCache<Number>& cache;
  std::atomic<int> made{0};
  std::shared_ptr<const Number> get(std::uint32_t key) {
    return cache.get(key, [&] {
      ++made;
      return std::make_shared<const Number>(Number{key});
    });
  }
};

}  // namespace

TEST_CASE("the values that were wanted longest ago make room", "[quick][core]") {
  LruCache<Number> cache(30, 10);
  Maker maker{cache};
  for (const std::uint32_t key : {0u, 1u, 2u}) CHECK(maker.get(key)->value == key);
  (void)maker.get(0);
  const auto held = maker.get(1);
  CHECK(maker.made == 3);
  (void)maker.get(3);  // in place of 2
  (void)maker.get(0), (void)maker.get(1);
  CHECK(maker.made == 4);
  (void)maker.get(2), (void)maker.get(4), (void)maker.get(5);
  CHECK(maker.made == 7);
  CHECK(maker.get(1)->value == 1);  // once more
  CHECK(maker.made == 8);
  CHECK(held->value == 1);
}

TEST_CASE("a value that is too large alone is kept until the next, and no value is kept as well", "[quick][core]") {
  LruCache<Number> cache(5, 3);
  Maker maker{cache};
  (void)maker.get(0), (void)maker.get(0);
  CHECK(maker.made == 1);
  (void)maker.get(1), (void)maker.get(0);
  CHECK(maker.made == 3);
  int asked = 0;
  for (int i = 0; i < 2; ++i) {
    CHECK(cache.get(2, [&] { return ++asked, std::shared_ptr<const Number>(); }) == nullptr);
  }
  CHECK(asked == 1);
}

TEST_CASE("threads share values, and each is made once while it is there", "[quick][core]") {
  constexpr std::uint32_t kKeys = 64;
  for (const std::uint64_t most : {std::uint64_t(10) * kKeys, std::uint64_t(100)}) {
    LruCache<Number> cache(most, kKeys);
    Maker maker{cache};
    std::atomic<int> wrong{0};
    parallel_for(64, [&](std::int64_t i) {
      for (std::uint32_t k = 0; k < 1000; ++k) {
        const std::uint32_t key = (k * 7 + std::uint32_t(i)) % kKeys;
        wrong += maker.get(key)->value != key;
      }
    });
    CHECK(wrong == 0);
    if (most == 10 * kKeys) CHECK(maker.made == int(kKeys));
  }
}

}  // namespace bp
