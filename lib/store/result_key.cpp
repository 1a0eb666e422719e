#include "lib/store/result_key.h"

#include "lib/store/source_digest.h"

namespace bp {

KeyHash::KeyHash(std::string_view job) {
  add(source_digest(), job);
}

void KeyHash::add_bytes(std::span<const std::byte> bytes) {
  add(bytes.size());
  hash_.add(bytes);
}

}  // namespace bp
