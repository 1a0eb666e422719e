#include "lib/core/result_key.h"

#include <xxhash.h>

#include <bit>

namespace bp {

struct KeyHash::State {
  XXH3_state_t* hash = XXH3_createState();
  State() { XXH3_128bits_reset(hash); }
  ~State() { XXH3_freeState(hash); }
  State(const State&) = delete;
  State& operator=(const State&) = delete;
};

KeyHash::KeyHash(std::string_view job) : state_(std::make_unique<State>()) {
  add(std::string_view(BP_VERSION)).add(job);
}

KeyHash::~KeyHash() = default;

KeyHash& KeyHash::add(std::span<const std::byte> bytes) {
  XXH3_128bits_update(state_->hash, bytes.data(), bytes.size());
  return *this;
}

KeyHash& KeyHash::add(std::string_view text) {
  add(std::int64_t(text.size()));
  return add(std::as_bytes(std::span(text.data(), text.size())));
}

KeyHash& KeyHash::add(std::int64_t number) {
  return add(std::as_bytes(std::span(&number, 1)));
}

KeyHash& KeyHash::add(double number) {
  return add(std::bit_cast<std::int64_t>(number));
}

ResultKey KeyHash::key() const {
  const XXH128_hash_t h = XXH3_128bits_digest(state_->hash);
  return {{h.high64, h.low64}};
}

}  // namespace bp
