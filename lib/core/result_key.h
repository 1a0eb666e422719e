#pragma once
#include <memory>
#include <span>

#include "lib/core/result_store.h"

/// XXH3-128 of a job's input, value by value.
namespace bp {

class KeyHash {
 public:
  /// `job`: what is done with the input, and the version of how; beside it the version of the suite goes in.
  explicit KeyHash(std::string_view job);
  ~KeyHash();
  KeyHash(const KeyHash&) = delete;
  KeyHash& operator=(const KeyHash&) = delete;

  KeyHash& add(std::span<const std::byte> bytes);
  KeyHash& add(std::string_view text);  ///< with its length
  KeyHash& add(std::int64_t number);
  KeyHash& add(double number);  ///< its bits
  [[nodiscard]] ResultKey key() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace bp
