#include "io/scene/scene_file.h"

#include <algorithm>

#include "io/files/kept_files.h"
#include "lib/core/error.h"

namespace bp {

namespace {

class PlainFile : public SceneFile {
 public:
  explicit PlainFile(std::unique_ptr<InputFile> file) : file_(std::move(file)) {}
  std::size_t read_at(std::uint64_t offset, std::span<std::byte> buffer) const override {
    return offset >= file_->size() ? 0 : file_->read_at(offset, buffer);
  }
  [[nodiscard]] std::uint64_t size() const override { return file_->size(); }
  [[nodiscard]] std::string name() const override { return file_->name(); }
  [[nodiscard]] std::string path() const override { return file_->name(); }

 private:
  std::unique_ptr<InputFile> file_;
};

class ScratchView : public SceneFile {
 public:
  ScratchView(std::shared_ptr<const ScratchFile> scratch, std::string name, std::optional<std::uint64_t> size)
      : scratch_(std::move(scratch)), name_(std::move(name)), size_(size) {}
  std::size_t read_at(std::uint64_t offset, std::span<std::byte> buffer) const override {
    if (offset >= size()) return 0;
    const std::size_t n = std::size_t(std::min<std::uint64_t>(buffer.size(), size() - offset));
    scratch_->read_at(offset, buffer.first(n));
    return n;
  }
  [[nodiscard]] std::uint64_t size() const override { return size_ ? *size_ : scratch_->size(); }
  [[nodiscard]] std::string name() const override { return name_; }

 private:
  std::shared_ptr<const ScratchFile> scratch_;
  std::string name_;
  std::optional<std::uint64_t> size_;
};

class FilePart : public SceneFile {
 public:
  FilePart(SceneFilePtr file, std::uint64_t offset, std::uint64_t size)
      : file_(std::move(file)), offset_(offset), size_(size) {}
  std::size_t read_at(std::uint64_t offset, std::span<std::byte> buffer) const override {
    if (offset >= size_) return 0;
    return file_->read_at(offset_ + offset,
                          buffer.first(std::size_t(std::min<std::uint64_t>(buffer.size(), size_ - offset))));
  }
  [[nodiscard]] std::uint64_t size() const override { return size_; }
  [[nodiscard]] std::string name() const override { return file_->name(); }

 private:
  SceneFilePtr file_;
  std::uint64_t offset_, size_;
};

SceneFilePtr spool(InputFile& pipe, const std::string& temp_dir, const PipeCheck& check) {
  auto scratch = std::make_shared<ScratchFile>(temp_dir);
  std::vector<std::byte> block(std::size_t(1) << 20);
  std::string start;
  while (const std::size_t n = pipe.read(block)) {
    if (start.empty()) start.assign(reinterpret_cast<const char*>(block.data()), n);
    if (check) check(pipe.name(), start, scratch->size() + n);
    scratch->append(std::span(block).first(n));
  }
  return view_of(std::move(scratch), pipe.name());
}

}  // namespace

SceneFilePtr open_scene_file(const std::string& path, const std::string& temp_dir, NamedBy named_by,
                             const PipeCheck& check) {
  note_looked_for(path);
  auto file = std::make_unique<InputFile>(path, named_by);
  keep_file(path);  // keeps it also if no list of a scene's parts has it
  // A seekable stdin may be read from the middle of its file, so it is spooled from there as a pipe is.
  if (!file->seekable() || path == "-") return spool(*file, temp_dir, check);
  return std::make_shared<PlainFile>(std::move(file));
}

SceneFilePtr view_of(std::shared_ptr<const ScratchFile> scratch, const std::string& name,
                     std::optional<std::uint64_t> size) {
  return std::make_shared<ScratchView>(std::move(scratch), name, size);
}

SceneFilePtr part_of(SceneFilePtr file, std::uint64_t offset, std::uint64_t size) {
  return std::make_shared<FilePart>(std::move(file), offset, size);
}

std::uint64_t JoinedFile::add(SceneFilePtr file) {
  const std::uint64_t begin = size_;
  size_ += file->size();
  begins_.push_back(begin);
  parts_.push_back(std::move(file));
  return begin;
}

SceneFilePtr JoinedFile::part(std::uint64_t address, std::uint64_t size) const {
  const std::size_t i = part_at(address);
  return part_of(parts_[i], address - begins_[i], size);
}

std::size_t JoinedFile::part_at(std::uint64_t offset) const {
  return std::size_t(std::upper_bound(begins_.begin(), begins_.end(), offset) - begins_.begin()) - 1;
}

std::size_t JoinedFile::read_at(std::uint64_t offset, std::span<std::byte> buffer) const {
  std::size_t got = 0;
  while (got < buffer.size() && offset + got < size_) {
    const std::size_t i = part_at(offset + got);
    const std::uint64_t within = offset + got - begins_[i];
    const auto want = std::size_t(std::min<std::uint64_t>(buffer.size() - got, parts_[i]->size() - within));
    const std::size_t n = parts_[i]->read_at(within, buffer.subspan(got, want));
    got += n;
    if (n < want) break;
  }
  return got;
}

std::string JoinedFile::name() const {
  return parts_.empty() ? std::string() : parts_.front()->name();
}

}  // namespace bp
