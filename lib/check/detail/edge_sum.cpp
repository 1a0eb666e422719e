// The hash is SipHash-2-4 with 128 bits of output (Aumasson and Bernstein 2012, [AB12]), over the six coordinates.
#include "lib/check/detail/edge_sum.h"

#include <bit>
#include <random>

namespace bp {

namespace {

struct SipState {
  std::uint64_t v0, v1, v2, v3;

  explicit SipState(const EdgeKey& key)
      : v0(key.words[0] ^ 0x736f6d6570736575u),
        v1(key.words[1] ^ 0x646f72616e646f6du ^ 0xee),  // 0xee: 128 bits of output
        v2(key.words[0] ^ 0x6c7967656e657261u),
        v3(key.words[1] ^ 0x7465646279746573u) {}

  void rounds(int n) {
    for (; n > 0; --n) {
      v0 += v1, v1 = std::rotl(v1, 13) ^ v0, v0 = std::rotl(v0, 32);
      v2 += v3, v3 = std::rotl(v3, 16) ^ v2;
      v0 += v3, v3 = std::rotl(v3, 21) ^ v0;
      v2 += v1, v1 = std::rotl(v1, 17) ^ v2, v2 = std::rotl(v2, 32);
    }
  }
  void take(std::uint64_t word) {
    v3 ^= word;
    rounds(2);
    v0 ^= word;
  }
  /// Returns the hash. `bytes`: the number of bytes taken.
  std::array<std::uint64_t, 2> finish(std::uint64_t bytes) {
    take(bytes << 56);
    v2 ^= 0xee;
    rounds(4);
    const std::uint64_t low = v0 ^ v1 ^ v2 ^ v3;
    v1 ^= 0xdd;
    rounds(4);
    return {low, v0 ^ v1 ^ v2 ^ v3};
  }
};

std::array<std::uint64_t, 2> hash(const EdgeKey& key, const Vec3d& a, const Vec3d& b) {
  SipState state(key);
  for (const Vec3d* p : {&a, &b})
    for (const double x : *p) state.take(std::bit_cast<std::uint64_t>(x + 0.0));  // -0 is 0
  return state.finish(2 * sizeof(Vec3d));
}

}  // namespace

EdgeKey EdgeKey::drawn() {
  std::random_device source;
  EdgeKey key{};
  for (std::uint64_t& word : key.words) word = std::uint64_t(source()) << 32 | source();
  return key;
}

void EdgeSum::add(const TriangleD& t) {
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3d &a = t[k], &b = t[(k + 1) % 3];
    const auto there = hash(key_, a, b), back = hash(key_, b, a);
    low_ += there[0] - back[0];
    high_ += there[1] - back[1];
  }
}

}  // namespace bp
