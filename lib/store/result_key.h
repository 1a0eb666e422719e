#pragma once
#include "lib/store/content_hash.h"

/// XXH3-128 of a job's input, value by value.
namespace bp {

class KeyHash {
 public:
  /// `job`: what is done with the input; beside it source_digest() goes in.
  explicit KeyHash(std::string_view job);

  KeyHash& add(std::span<const std::byte> bytes);
  KeyHash& add(std::string_view text);  ///< with its length
  KeyHash& add(std::int64_t number);
  KeyHash& add(double number);  ///< its bits
  [[nodiscard]] ResultKey key() const { return hash_.value(); }

 private:
  ContentHash hash_;
};

}  // namespace bp
