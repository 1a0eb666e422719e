#include "lib/store/result_key.h"

#include <bit>

#include "lib/store/source_digest.h"

namespace bp {

KeyHash::KeyHash(std::string_view job) {
  add(source_digest()).add(job);
}

KeyHash& KeyHash::add(std::span<const std::byte> bytes) {
  hash_.add(bytes);
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

}  // namespace bp
