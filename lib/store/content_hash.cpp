#include "lib/store/content_hash.h"

#include <xxhash.h>

namespace bp {

namespace {

ResultKey key_of(const XXH128_hash_t& hash) {
  return {{hash.high64, hash.low64}};
}

}  // namespace

ResultKey content_hash(std::span<const std::byte> bytes) {
  return key_of(XXH3_128bits(bytes.data(), bytes.size()));
}

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
  return key_of(XXH3_128bits_digest(state_->hash));
}

void ContentHash::reset() {
  XXH3_128bits_reset(state_->hash);
}

}  // namespace bp
