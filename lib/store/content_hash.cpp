#include "lib/store/content_hash.h"

#include <xxhash.h>

namespace bp {

struct ContentHash::State {
  XXH3_state_t* hash = XXH3_createState();
  State() { XXH3_128bits_reset(hash); }
  ~State() { XXH3_freeState(hash); }
  State(const State&) = delete;
  State& operator=(const State&) = delete;
};

ContentHash::ContentHash() : state_(std::make_unique<State>()) {}
ContentHash::~ContentHash() = default;

void ContentHash::add(std::span<const std::byte> bytes) {
  XXH3_128bits_update(state_->hash, bytes.data(), bytes.size());
}

ResultKey ContentHash::value() const {
  const XXH128_hash_t h = XXH3_128bits_digest(state_->hash);
  return {{h.high64, h.low64}};
}

void ContentHash::reset() {
  XXH3_128bits_reset(state_->hash);
}

}  // namespace bp
