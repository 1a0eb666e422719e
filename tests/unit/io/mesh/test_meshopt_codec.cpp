#include <cmath>
#include <cstring>
#include <span>

#include "io/gltf/meshopt_codec.h"
#include "tests/catch.h"

using namespace bp;

TEST_CASE("multiples of a power of two come back from the exponential filter", "[quick][io][lod]") {
  const auto bytes_of = [](const std::vector<float>& x) {
    return std::string(reinterpret_cast<const char*>(x.data()), x.size() * sizeof(float));
  };
  const auto come_back = [&](const std::vector<float>& x) {
    const std::string packed = encode_attributes(exponential(bytes_of(x)), 4);
    std::vector<std::byte> out;
    CHECK(decode_meshopt({MeshoptMode::attributes, MeshoptFilter::exponential, x.size(), 4},
                         std::as_bytes(std::span(packed)), out)
              .empty());
    std::vector<float> got(x.size());
    std::memcpy(got.data(), out.data(), out.size());
    CHECK(got == x);
  };
  come_back({0, 0, 0, 0});
  come_back({1, -0.125F, 1024.5F, -0.0F, 3e3F});
  come_back({8388607, -8388607, 1});
  come_back({0x1p-90F, -0x1.8p-80F});
  come_back({0x1p90F, 0x1.fffffcp90F});
  for (const std::vector<float>& x :
       std::vector<std::vector<float>>{{8388608, 1}, {1e-6F, 1e6F}, {0x1p-120F}, {0x1p126F}, {INFINITY, 1}, {NAN}})
    CHECK(exponential(bytes_of(x)).empty());
}
