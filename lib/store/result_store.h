#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <string_view>

/// Keeps results of jobs, under a hash of their inputs. io/store/result_store.h keeps them in a folder.
namespace bp {

/// A 128-bit hash of everything that a result depends on.
struct ResultKey {
  std::array<std::uint64_t, 2> words{};
  friend auto operator<=>(const ResultKey&, const ResultKey&) = default;
};

/// A store of results. Thread-safe.
class ResultStore {
 public:
  virtual ~ResultStore() = default;
  /// Gets the bytes that were put under `key`. Returns false if they are not there, or damaged.
  virtual bool get(const ResultKey& key, std::string& out) = 0;
  /// Puts bytes under `key`. Throws out_of_resource if there is no room.
  virtual void put(const ResultKey& key, std::string_view bytes) = 0;
};

}  // namespace bp
