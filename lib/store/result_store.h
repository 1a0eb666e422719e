#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <string_view>

/// Results of jobs, by what went into them. io/store/result_store.h keeps them in a folder.
namespace bp {

/// A 128-bit hash of everything that a result depends on.
struct ResultKey {
  std::array<std::uint64_t, 2> words{};
  friend auto operator<=>(const ResultKey&, const ResultKey&) = default;
};

/// Thread-safe.
class ResultStore {
 public:
  virtual ~ResultStore() = default;
  /// True, and the bytes that were put under `key`, if they are there and undamaged.
  virtual bool get(const ResultKey& key, std::string& out) = 0;
  /// Throws out_of_resource if there is no room.
  virtual void put(const ResultKey& key, std::string_view bytes) = 0;
};

}  // namespace bp
