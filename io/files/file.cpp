#include "io/files/file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

#include "io/files/final_names.h"
#include "io/files/kept_files.h"
#include "io/files/made_folders.h"
#include "io/files/write_all.h"
#include "io/files/write_signals.h"
#include "lib/core/error.h"

namespace bp {

namespace {

constexpr std::size_t kBufferBytes = std::size_t(1) << 20;

[[noreturn]] void fail_write(const std::string& name) {
  const int e = errno;
  if (e == EPIPE) fail(ErrorCode::closed_pipe, "{}: the reader closed the pipe", name);
  if (e == ENOSPC || e == EDQUOT || e == EFBIG)
    fail(ErrorCode::out_of_resource, {Remedy::free_space, Remedy::other_output}, "{}: {}", name, std::strerror(e));
  if (e == ENOENT) fail_for_folder(name);
  fail(ErrorCode::failed, "{}: cannot write: {}", name, std::strerror(e));
}

/// The reason why outputs are refused.
std::shared_ptr<const Error>& refusal() {
  static std::shared_ptr<const Error> why;
  return why;
}

constexpr int kMostPartials = 1000;  ///< partial files of one name at a time

/// Returns whether the locked file `fd` still has the name `name`: only then it may be written from its beginning and
/// renamed. Another process may have changed the name before it released the lock.
bool is_ours(int fd, const std::string& name) {
  struct stat held {
  }, named{};
  return ::fstat(fd, &held) == 0 && ::lstat(name.c_str(), &named) == 0 && held.st_dev == named.st_dev &&
         held.st_ino == named.st_ino && S_ISREG(held.st_mode) && held.st_nlink == 1 && held.st_uid == ::geteuid();
}

/// Returns whether something has this name. A link that leads nowhere counts, since a new file cannot have its name.
bool is_there(const std::string& path) {
  struct stat info {};
  return ::lstat(path.c_str(), &info) == 0;
}

/// Returns an empty, locked file of that name, new or left by a dead process; -1 if another process has it. On a file
/// system without locks only a new file is taken. Throws if no file can be made there.
int take_partial(const std::string& name, const std::string& path) {
  int fd = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  const bool made = fd >= 0;
  if (!made && errno != EEXIST) fail_write(path);
  if (!made) fd = ::open(name.c_str(), O_WRONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (fd < 0) return -1;
  const bool locked = ::flock(fd, LOCK_EX | LOCK_NB) == 0;
  const bool is_free = locked ? is_ours(fd, name) : made && errno != EWOULDBLOCK;
  if (is_free && ::ftruncate(fd, 0) == 0) return fd;
  ::close(fd);
  return -1;
}

}  // namespace

InputFile::InputFile(const std::string& path, NamedBy named_by)
    : name_(path == "-" && named_by == NamedBy::user ? "stdin" : path) {
  const bool waits = named_by == NamedBy::user;
  fd_ = waits && path == "-" ? ::dup(0) : ::open(path.c_str(), O_RDONLY | O_CLOEXEC | (waits ? 0 : O_NONBLOCK));
  if (fd_ < 0) fail(ErrorCode::bad_input, "{}: {}", name_, std::strerror(errno));
  struct stat info {};
  if (::fstat(fd_, &info) != 0) fail(ErrorCode::bad_input, "{}: {}", name_, std::strerror(errno));
  if (S_ISDIR(info.st_mode)) fail(ErrorCode::bad_input, "{}: is a directory, not a file", name_);
  if (!waits && !S_ISREG(info.st_mode))
    fail(ErrorCode::bad_input, "{}: is a pipe or a device, and a file may name regular files only", name_);
  seekable_ = S_ISREG(info.st_mode) && ::lseek(fd_, 0, SEEK_CUR) == 0;
  if (seekable_) size_ = std::uint64_t(info.st_size);
}

InputFile::~InputFile() {
  if (fd_ >= 0) ::close(fd_);
}

std::size_t InputFile::read(std::span<std::byte> buffer) {
  std::size_t got = 0;
  while (got < buffer.size()) {
    const ssize_t n = ::read(fd_, buffer.data() + got, buffer.size() - got);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail(ErrorCode::bad_input, "{}: cannot read at byte {}: {}", name_, offset_ + got, std::strerror(errno));
    if (n == 0) break;
    got += std::size_t(n);
  }
  offset_ += got;
  return got;
}

std::size_t InputFile::read_at(std::uint64_t offset, std::span<std::byte> buffer) const {
  std::size_t got = 0;
  while (got < buffer.size()) {
    const ssize_t n = ::pread(fd_, buffer.data() + got, buffer.size() - got, off_t(offset + got));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail(ErrorCode::bad_input, "{}: cannot read at byte {}: {}", name_, offset + got, std::strerror(errno));
    if (n == 0) break;
    got += std::size_t(n);
  }
  return got;
}

void InputFile::seek(std::uint64_t offset) {
  if (::lseek(fd_, off_t(offset), SEEK_SET) < 0)
    fail(ErrorCode::bad_input, "{}: cannot seek: {}", name_, std::strerror(errno));
  offset_ = offset;
}

OutputFile::OutputFile(const std::string& path, bool overwrite, NamedBy named_by)
    : name_(path == "-" ? "stdout" : path), overwrite_(overwrite), buffer_(new std::byte[kBufferBytes]) {
  if (path == "-") {
    fd_ = ::dup(1);
    if (fd_ < 0) fail_write(name_);
    return;
  }
  struct stat info {};
  const bool exists = ::stat(path.c_str(), &info) == 0;
  if (exists && S_ISDIR(info.st_mode)) fail(ErrorCode::bad_argument, "{}: is a directory; name a file", path);
  if (named_by == NamedBy::user && exists && !S_ISREG(info.st_mode)) {  // a device or a pipe: written as a shell would
    fd_ = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
    if (fd_ < 0) fail_write(name_);
    return;
  }
  refuse_kept(path);
  if (!overwrite && is_there(path)) fail(ErrorCode::bad_argument, {Remedy::overwrite}, "{}: exists", path);
  open_partial();
}

OutputFile::OutputFile(const std::string& name, Sink sink)
    : name_(name), sink_(std::move(sink)), buffer_(new std::byte[kBufferBytes]) {}

void OutputFile::open_partial() {
  for (int i = 1; i <= kMostPartials; ++i) {
    std::string name = fmt::format("{}.partial-{}", name_, i);
    if (is_kept(name)) continue;  // a kept input of that name is no leftover of a run
    const WhileMaking making;
    fd_ = take_partial(name, name_);
    if (fd_ < 0) continue;
    partial_ = PartialOutput(name);
    temporary_ = std::move(name);
    return;
  }
  fail(ErrorCode::failed, "{}: {} unfinished files of that name lie beside it; remove them", name_, kMostPartials);
}

/// Releases the lock last: until then no other process may take the name over.
OutputFile::~OutputFile() {
  if (!temporary_.empty()) {
    const WhileMaking making;  // after the rename, a file of this name belongs to another process
    ::unlink(temporary_.c_str());
    partial_ = PartialOutput();
  }
  if (fd_ >= 0) ::close(fd_);
}

void OutputFile::write(std::span<const std::byte> bytes) {
  bytes_ += bytes.size();
  if (used_ + bytes.size() > kBufferBytes) flush();
  if (bytes.size() >= kBufferBytes) return emit(bytes);
  std::memcpy(buffer_.get() + used_, bytes.data(), bytes.size());
  used_ += bytes.size();
}

void OutputFile::flush() {
  emit({buffer_.get(), used_});
  used_ = 0;
}

void OutputFile::emit(std::span<const std::byte> bytes) {
  check_outputs();
  if (sink_) {
    if (!bytes.empty()) sink_(bytes);
  } else if (!detail::write_all(fd_, bytes)) {
    fail_write(name_);
  }
}

void OutputFile::commit(Sync sync) {
  complete();
  place();
  close(sync);
}

void OutputFile::commit_all(std::span<const std::unique_ptr<OutputFile>> files) {
  for (const auto& file : files) file->complete();
  try {
    for (const auto& file : files) file->place();
  } catch (...) {
    for (const auto& file : files) file->take_back();
    throw;
  }
  for (const auto& file : files) file->close(Sync::name);
}

void OutputFile::complete() {
  flush();
  if (!temporary_.empty() && ::fsync(fd_) != 0) fail_write(name_);
}

void OutputFile::place() {
  if (temporary_.empty()) return;
  place_file(temporary_, name_, overwrite_, &partial_);
  temporary_.clear();
  placed_ = true;
}

/// Removes a file that was placed and replaced nothing. A file that it replaced cannot be brought back.
void OutputFile::take_back() {
  if (placed_ && !overwrite_ && is_ours(fd_, name_)) (void)remove_file(name_);
}

void OutputFile::close(Sync sync) {
  if (sink_) return;
  const int fd = std::exchange(fd_, -1);
  if (::close(fd) != 0) fail_write(name_);
  if (placed_ && sync == Sync::name) sync_folder(folder_of(name_));
}

void refuse_outputs(std::shared_ptr<const Error> why) {
  refusal() = std::move(why);
}

void check_outputs() {
  if (refusal() != nullptr) throw Error(*refusal());
}

void print(const std::string& text) {
  OutputFile out("-", false);
  out.write(text);
  out.commit();
}

struct ScratchFile::State {
  int fd = -1;
  std::string name;
  std::atomic<std::uint64_t> size{0};
};

ScratchFile::ScratchFile(const std::string& directory) : state_(new State) {
  state_->name = directory + "/bp-scratch-XXXXXX";
  {
    const WhileMaking making;
    state_->fd = ::mkstemp(state_->name.data());
    if (state_->fd >= 0) ::unlink(state_->name.c_str());
  }
  if (state_->fd < 0) {
    fail(ErrorCode::out_of_resource, {Remedy::other_scratch_folder}, "{}: cannot create a scratch file: {}", directory,
         std::strerror(errno));
  }
}

ScratchFile::~ScratchFile() {
  if (state_->fd >= 0) ::close(state_->fd);
}

std::uint64_t ScratchFile::append(std::span<const std::byte> bytes) {
  const std::uint64_t offset = state_->size.fetch_add(bytes.size());
  write_at(offset, bytes);
  return offset;
}

void ScratchFile::write_at(std::uint64_t offset, std::span<const std::byte> bytes) {
  const detail::NoWriteSignals as_errors;
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t n = ::pwrite(state_->fd, bytes.data() + done, bytes.size() - done, off_t(offset + done));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) fail_write(state_->name);
    done += std::size_t(n);
  }
}

void ScratchFile::read_at(std::uint64_t offset, std::span<std::byte> buffer) const {
  std::size_t got = 0;
  while (got < buffer.size()) {
    const ssize_t n = ::pread(state_->fd, buffer.data() + got, buffer.size() - got, off_t(offset + got));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) fail(ErrorCode::failed, "{}: scratch file lost bytes at {}", state_->name, offset + got);
    got += std::size_t(n);
  }
}

std::uint64_t ScratchFile::size() const {
  return state_->size;
}

std::string read_text(const std::string& path, std::uint64_t limit, NamedBy named_by) {
  InputFile file(path, named_by);
  std::string text;
  std::byte block[65536];
  while (const std::size_t n = file.read(block)) {
    text.append(reinterpret_cast<const char*>(block), n);
    if (text.size() > limit)
      fail(ErrorCode::bad_input, "{}: larger than {} bytes; is it the right file?", file.name(), limit);
  }
  return text;
}

}  // namespace bp
