#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>

#include "io/files/partial_outputs.h"
#include "io/files/paths.h"

/// Files, stdin, stdout. Every read, write, flush and close is checked; failures are Errors with the right code:
/// missing or unreadable input bad_input, full disk out_of_resource, EPIPE closed_pipe, anything else failed.
namespace bp {

class Error;

/// Tells who named a file. One that another file names, or that a folder holds, must be a regular file to be read, and
/// is replaced if it is written: a named pipe would wait, and a device has no end.
enum class NamedBy { user, file };

/// Sequential input. "-" is stdin if the user named it.
class InputFile {
 public:
  explicit InputFile(const std::string& path, NamedBy named_by = NamedBy::user);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  /// Reads up to buffer.size() bytes; fewer only at the end of the file; 0 at the end.
  std::size_t read(std::span<std::byte> buffer);
  /// Reads up to buffer.size() bytes at `offset`; needs seekable(). Thread-safe.
  std::size_t read_at(std::uint64_t offset, std::span<std::byte> buffer) const;

  [[nodiscard]] bool seekable() const { return seekable_; }
  [[nodiscard]] std::uint64_t size() const { return size_; }      ///< bytes; 0 if not seekable
  [[nodiscard]] std::uint64_t offset() const { return offset_; }  ///< bytes read sequentially so far
  [[nodiscard]] const std::string& name() const { return name_; }
  void seek(std::uint64_t offset);  ///< needs seekable()

 private:
  std::string name_;
  int fd_ = -1;
  bool seekable_ = false;
  std::uint64_t size_ = 0, offset_ = 0;
};

/// Sequential output. "-" is stdout. A named file is written as NAME.partial-1 in the same folder, and renamed by
/// commit(). Without commit() nothing stays behind, even if a signal ends the process. A file that SIGKILL or a crash
/// left is taken over by the next process that writes NAME; a file that a living process writes is locked, and the next
/// process takes the next number. Throws bad_argument if the name exists and `overwrite` is false, here or in commit(),
/// or if it is a file that this process reads (io/files/kept_files.h).
class OutputFile {
 public:
  /// Takes the next bytes of an output.
  using Sink = std::function<void(std::span<const std::byte> bytes)>;

  OutputFile(const std::string& path, bool overwrite, NamedBy named_by = NamedBy::user);
  /// Hands the bytes to `sink`, in their order, until commit() returns. No file is written; `name` is for messages.
  OutputFile(const std::string& name, Sink sink);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(std::span<const std::byte> bytes);
  void write(const std::string& text) { write(std::as_bytes(std::span(text.data(), text.size()))); }
  /// The state that survives a crash of the machine after commit(). name: the file under its name. content: its bytes,
  /// but perhaps not its name, since its folder is not synced.
  enum class Sync { name, content };
  /// Flushes, syncs, closes and renames; the file appears under its name now. stdout: flushes.
  void commit(Sync sync = Sync::name);
  /// Lets commit() replace a file of that name.
  void allow_overwrite() { overwrite_ = true; }
  /// Commits files together, in this order. If one fails, those that are new are removed again.
  static void commit_all(std::span<const std::unique_ptr<OutputFile>> files);

  [[nodiscard]] std::uint64_t bytes() const { return bytes_; }
  [[nodiscard]] const std::string& name() const { return name_; }

 private:
  void open_partial();
  void flush();
  void emit(std::span<const std::byte> bytes);
  void complete();
  void place();
  void take_back();
  void close(Sync sync);
  std::string name_, temporary_;
  bool overwrite_ = false, placed_ = false;
  PartialOutput partial_;  ///< entry for temporary_, used by signal handlers
  int fd_ = -1;
  Sink sink_;  ///< in place of fd_
  std::uint64_t bytes_ = 0;
  std::unique_ptr<std::byte[]> buffer_;
  std::size_t used_ = 0;
};

/// From now on files and stdout throw `why` instead of their next byte. Null: outputs work again. For a refusal that
/// waits, since a later step may have a better reason. Not thread-safe.
void refuse_outputs(std::shared_ptr<const Error> why);
/// Throws the reason of refuse_outputs(), if there is one: before long work of which the output would be refused.
void check_outputs();

/// Prints text to stdout, and flushes it.
void print(const std::string& text);

/// An anonymous scratch file in `directory`: unlinked at once, so nothing stays behind whatever happens. Thread-safe.
class ScratchFile {
 public:
  explicit ScratchFile(const std::string& directory);  ///< out_of_resource if the directory cannot be written
  ~ScratchFile();
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;

  /// Appends bytes; returns the offset of the first one.
  std::uint64_t append(std::span<const std::byte> bytes);
  /// Writes at `offset`; the file grows if needed. Must not be mixed with append().
  void write_at(std::uint64_t offset, std::span<const std::byte> bytes);
  void read_at(std::uint64_t offset, std::span<std::byte> buffer) const;
  [[nodiscard]] std::uint64_t size() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Returns a whole file as a string. Throws bad_input if it is missing or larger than `limit` bytes.
[[nodiscard]] std::string read_text(const std::string& path, std::uint64_t limit = std::uint64_t(1) << 26,
                                    NamedBy named_by = NamedBy::user);

}  // namespace bp
