#pragma once
#include <memory>
#include <span>

#include "lib/store/result_store.h"

namespace bp {

/// Returns the XXH3-128 of these bytes.
[[nodiscard]] ResultKey content_hash(std::span<const std::byte> bytes);

/// XXH3-128 of bytes that come in pieces.
class ContentHash {
 public:
  ContentHash();
  ~ContentHash();
  ContentHash(const ContentHash&) = delete;
  ContentHash& operator=(const ContentHash&) = delete;

  void add(std::span<const std::byte> bytes);
  [[nodiscard]] ResultKey value() const;
  void reset();  ///< forgets all that was added

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace bp
