#include <cstring>
#include <random>

#include "tests/catch.h"
#include "tests/fuzz/brick_stream_entry.h"
#include "tests/unit/io/stream/stream_files.h"

using namespace stream_files;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

/// One of the damages that files meet: bits, bytes, numbers, pieces lost, doubled or moved, two files mixed.
void damage(Bytes& b, const Bytes& other, std::mt19937& random) {
  const auto place = [&](std::size_t n) { return std::ptrdiff_t(random() % (n + 1)); };
  const std::ptrdiff_t at = place(b.size() - 1), n = std::min(place(64), std::ptrdiff_t(b.size()) - at);
  static const std::uint32_t numbers[] = {0, 1, 0x7fffffff, 0x80000000, 0xffffffff, 0x10000, 4097, 1179649};
  switch (random() % 7) {
    case 0:
      b[std::size_t(at)] ^= static_cast<unsigned char>(1 << random() % 8);
      break;
    case 1:
      b[std::size_t(at)] = static_cast<unsigned char>(random());
      break;
    case 2:
      if (at + 4 <= std::ptrdiff_t(b.size())) std::memcpy(&b[std::size_t(at)], &numbers[random() % 8], 4);
      break;
    case 3:
      b.erase(b.begin() + at, b.begin() + at + n);
      break;
    case 4: {
      const Bytes piece(b.begin() + at, b.begin() + at + n);
      b.insert(b.begin() + place(b.size()), piece.begin(), piece.end());
      break;
    }
    case 5:
      b.resize(std::size_t(at) + 1);
      break;
    default:
      b.resize(std::size_t(at));
      b.insert(b.end(), other.begin() + std::min(at, std::ptrdiff_t(other.size())), other.end());
  }
}

}  // namespace

TEST_CASE("damaged streams end in an error, never in a crash or in other bricks", "[quick][io]") {
  std::vector<Bytes> corpus{written(small_header(), small_bricks()), written(small_header(), {})};
  for (std::uint32_t seed = 0; seed < 4; ++seed) {
    const bp::StreamHeader header = random_header(seed);
    corpus.push_back(written(header, random_bricks(header, seed, 3)));
  }
  for (const Bytes& b : corpus) CHECK(fuzz::read_brick_stream(b.data(), b.size()));
  std::mt19937 random(1);
  for (int i = 0; i < 1500; ++i) {
    Bytes b = corpus[random() % corpus.size()];
    for (std::uint32_t k = 0; k <= random() % 3 && !b.empty(); ++k) damage(b, corpus[random() % corpus.size()], random);
    LLVMFuzzerTestOneInput(b.data(), b.size());
  }
}
