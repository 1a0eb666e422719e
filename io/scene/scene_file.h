#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/files/file.h"

/// Random access to the bytes that a reader works on, wherever they lie.
namespace bp {

class SceneFile {
 public:
  virtual ~SceneFile() = default;
  /// Reads up to buffer.size() bytes at `offset`; fewer only at the end. Thread-safe.
  virtual std::size_t read_at(std::uint64_t offset, std::span<std::byte> buffer) const = 0;
  [[nodiscard]] virtual std::uint64_t size() const = 0;
  [[nodiscard]] virtual std::string name() const = 0;            ///< for messages
  [[nodiscard]] virtual std::string path() const { return {}; }  ///< empty if the bytes have no file of their own
};
using SceneFilePtr = std::shared_ptr<const SceneFile>;

/// Looks at the first bytes of a pipe (1 MiB, or all), and at how many came so far. Throws if the rest is not wanted.
using PipeCheck = std::function<void(const std::string& name, const std::string& start, std::uint64_t bytes)>;

/// Opens a file; a pipe ("-" or a named one) is spooled to a scratch file first, as long as `check` lets it.
[[nodiscard]] SceneFilePtr open_scene_file(const std::string& path, const std::string& temp_dir,
                                           NamedBy named_by = NamedBy::user, const PipeCheck& check = {});

/// Returns the bytes of a scratch file to which other code appends. `size`: set if another process does.
[[nodiscard]] SceneFilePtr view_of(std::shared_ptr<const ScratchFile> scratch, const std::string& name,
                                   std::optional<std::uint64_t> size = {});

/// Returns `size` bytes at `offset` of `file`. The range need not exist; reads end where the file ends.
[[nodiscard]] SceneFilePtr part_of(SceneFilePtr file, std::uint64_t offset, std::uint64_t size);

/// Files one after the other in one address space, so that one cache serves them all.
class JoinedFile : public SceneFile {
 public:
  /// Adds a part; returns the address of its first byte.
  std::uint64_t add(SceneFilePtr file);
  /// Returns bytes within one part; the other parts may be freed.
  [[nodiscard]] SceneFilePtr part(std::uint64_t address, std::uint64_t size) const;
  std::size_t read_at(std::uint64_t offset, std::span<std::byte> buffer) const override;
  [[nodiscard]] std::uint64_t size() const override { return size_; }
  [[nodiscard]] std::string name() const override;

 private:
  std::size_t part_at(std::uint64_t offset) const;
  std::vector<SceneFilePtr> parts_;
  std::vector<std::uint64_t> begins_;
  std::uint64_t size_ = 0;
};

}  // namespace bp
