#include "io/store/result_store.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#include <xxhash.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <mutex>
#include <vector>

#include "io/files/file.h"
#include "io/files/final_names.h"
#include "io/files/made_folders.h"
#include "io/files/write_all.h"
#include "io/store/brick_codec.h"
#include "lib/core/error.h"
#include "lib/store/hex.h"

namespace bp {

namespace {

constexpr char kMagic[8] = {'b', 'p', 'r', 'e', 's', 'u', 'l', 1};

/// The head before the zstd frame. Little-endian, as all machines that the suite runs on.
struct Head {
  char magic[8];
  std::uint64_t key[2];
  std::uint64_t size;      ///< size of the result
  std::uint64_t packed;    ///< size of the frame
  std::uint64_t check[2];  ///< XXH3-128 of all fields before, and of the frame
};

XXH128_hash_t check_of(const Head& head, std::span<const std::byte> frame) {
  const XXH128_hash_t h = XXH3_128bits(frame.data(), frame.size());
  const std::uint64_t all[] = {head.key[0], head.key[1], head.size, head.packed, h.high64, h.low64};
  return XXH3_128bits(all, sizeof all);
}

class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  [[nodiscard]] int get() const { return fd_; }

 private:
  int fd_;
};

[[noreturn]] void fail_with(const std::string& name, const char* what, int error) {
  const bool full = error == ENOSPC || error == EDQUOT || error == EFBIG;
  if (full)
    fail(ErrorCode::out_of_resource, {Remedy::free_space}, "{}: cannot {}: {}", name, what, std::strerror(error));
  fail(ErrorCode::failed, "{}: cannot {}: {}", name, what, std::strerror(error));
}

void write_all(int fd, const std::string& name, std::span<const std::byte> bytes) {
  if (!detail::write_all(fd, bytes)) fail_with(name, "write", errno);
}

bool read_all(int fd, std::span<std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::read(fd, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    bytes = bytes.subspan(std::size_t(n));
  }
  return true;
}

class FolderStore final : public ResultStore {
 public:
  FolderStore(std::string folder, std::function<void(const std::string&)> on_failure)
      : folder_(std::move(folder)), on_failure_(std::move(on_failure)), made_(folder_) {}

  bool get(const ResultKey& key, std::string& out) override {
    const Descriptor file(::open(name_of(key).c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
    Head head{};
    struct stat info {};
    if (file.get() < 0 || ::fstat(file.get(), &info) != 0 || !S_ISREG(info.st_mode)) return false;
    if (!read_all(file.get(), std::as_writable_bytes(std::span(&head, 1)))) return false;
    if (std::memcmp(head.magic, kMagic, sizeof kMagic) != 0 || head.key[0] != key.words[0] ||
        head.key[1] != key.words[1] || std::uint64_t(info.st_size) != sizeof head + head.packed || head.size >> 40 != 0)
      return false;
    std::vector<std::byte> packed(head.packed);
    if (!read_all(file.get(), packed)) return false;
    const XXH128_hash_t check = check_of(head, packed);
    if (check.high64 != head.check[0] || check.low64 != head.check[1]) return false;
    out.resize(head.size);
    return detail::decompress(packed, std::as_writable_bytes(std::span(out.data(), out.size()))) == nullptr;
  }

  void put(const ResultKey& key, std::string_view bytes) override {
    if (failed_) return;
    try {
      keep(key, bytes);
    } catch (const Error& e) {
      if (!on_failure_) throw;
      if (!failed_.exchange(true)) on_failure_(e.what());
    }
  }

 private:
  void keep(const ResultKey& key, std::string_view bytes) {
    std::call_once(first_put_, [this] { made_.keep(); });
    const std::string name = name_of(key), place = name.substr(0, name.rfind('/'));
    if (::mkdir(place.c_str(), 0777) != 0 && errno != EEXIST) fail_with(place, "make this folder", errno);
    if (::access(place.c_str(), W_OK | X_OK) != 0) {
      const int error = errno;
      if (std::string kept; get(key, kept) && kept == bytes) return;
      fail_with(place, "write there", error);
    }
    std::vector<std::byte> packed;
    detail::compress(std::as_bytes(std::span(bytes.data(), bytes.size())), detail::kDefaultLevel, false, packed);
    Head head{{}, {key.words[0], key.words[1]}, bytes.size(), packed.size(), {}};
    const XXH128_hash_t check = check_of(head, packed);
    head.check[0] = check.high64, head.check[1] = check.low64;
    std::memcpy(head.magic, kMagic, sizeof kMagic);
    if (put_unnamed(place, name, head, packed)) return;
    if (std::string kept; get(key, kept) && kept == bytes) return;  // another thread or process was faster
    put_beside(name, head, packed);
  }

  [[nodiscard]] std::string name_of(const ResultKey& key) const {
    const std::string hex = hex_of(key.words[0], key.words[1]);
    return folder_ + "/" + hex.substr(0, 2) + "/" + hex.substr(2);
  }

  /// Writes a file without a name, and names it when it is complete: nothing remains if the process is killed. Returns
  /// false if the file system has no such files, or if the name is taken. The file with that name stays: another thread
  /// may just have put it.
  static bool put_unnamed(const std::string& place, const std::string& name, const Head& head,
                          std::span<const std::byte> packed) {
    const Descriptor file(::open(place.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666));
    if (file.get() < 0) return false;
    write_all(file.get(), name, std::as_bytes(std::span(&head, 1)));
    write_all(file.get(), name, packed);
    const std::string self = fmt::format("/proc/self/fd/{}", file.get());
    return ::linkat(AT_FDCWD, self.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) == 0;
  }

  /// Replaces the file of that name in one step: a damaged result, or another one.
  static void put_beside(const std::string& name, const Head& head, std::span<const std::byte> packed) {
    OutputFile file(name, true, NamedBy::file);
    file.write(std::as_bytes(std::span(&head, 1)));
    file.write(packed);
    file.commit();
  }

  const std::string folder_;
  const std::function<void(const std::string&)> on_failure_;
  std::atomic<bool> failed_{false};
  std::once_flag first_put_;
  MadeFolder made_;  ///< a run that fails before its first result leaves no folder
};

}  // namespace

std::unique_ptr<ResultStore> open_result_store(const std::string& folder,
                                               std::function<void(const std::string&)> on_failure) {
  return std::make_unique<FolderStore>(folder, std::move(on_failure));
}

}  // namespace bp
