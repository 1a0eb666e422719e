#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

/// Holds bytes off the heap, which a pass puts aside when its memory is spent. io/store/scratch.h implements it with
/// zstd and a scratch file.
namespace bp {

/// A store of byte strings under handles. Thread-safe.
class Scratch {
 public:
  using Handle = std::uint64_t;
  virtual ~Scratch() = default;
  /// Puts bytes aside. Throws out_of_resource if the scratch space is full. Chunks of about 1 MiB serve best.
  virtual Handle put(std::span<const std::byte> bytes) = 0;
  virtual void get(Handle handle, std::vector<std::byte>& out) const = 0;  ///< replaces `out`
  virtual void drop(Handle handle) = 0;  ///< frees the memory of bytes that are never read again
  [[nodiscard]] virtual std::uint64_t memory_bytes() const = 0;   ///< bytes held in memory, compressed
  [[nodiscard]] virtual std::uint64_t scratch_bytes() const = 0;  ///< bytes in the scratch file
};
/// Makes an empty store. Passes get the factory from the tool, which knows --memory and --temp.
using ScratchFactory = std::function<std::unique_ptr<Scratch>()>;

}  // namespace bp
