#pragma once
#include <assimp/DefaultIOSystem.h>

#include <assimp/IOStream.hpp>
#include <string>
#include <utility>

#include "io/files/file.h"
#include "io/scene/detail/exact/ac3d_layers.h"
#include "io/scene/scene_file.h"

/// The file system that Assimp reads through.
namespace bp {

class SceneStream : public Assimp::IOStream {
 public:
  explicit SceneStream(SceneFilePtr file) : file_(std::move(file)) {}
  std::size_t Read(void* buffer, std::size_t size, std::size_t count) override {
    if (size == 0) return 0;
    const std::size_t got = file_->read_at(at_, {static_cast<std::byte*>(buffer), size * count});
    at_ += got;
    return got / size;
  }
  std::size_t Write(const void*, std::size_t, std::size_t) override { return 0; }
  aiReturn Seek(std::size_t offset, aiOrigin origin) override {
    const std::uint64_t from = origin == aiOrigin_SET ? 0 : origin == aiOrigin_CUR ? at_ : file_->size();
    if (from + offset > file_->size()) return aiReturn_FAILURE;
    at_ = from + offset;
    return aiReturn_SUCCESS;
  }
  [[nodiscard]] std::size_t Tell() const override { return std::size_t(at_); }
  [[nodiscard]] std::size_t FileSize() const override { return std::size_t(file_->size()); }
  void Flush() override {}

 private:
  SceneFilePtr file_;
  std::uint64_t at_ = 0;
};

/// An AC3D file with the images of its base layers only. Assimp reads it as a whole.
class Ac3dStream final : public SceneStream {
 public:
  using SceneStream::SceneStream;
  std::size_t Read(void* buffer, std::size_t size, std::size_t count) override {
    const std::size_t got = SceneStream::Read(buffer, size, count);
    keep_base_layers({static_cast<char*>(buffer), size * got});
    return got;
  }
};

/// Offers the scene under the name that Assimp is given. Other names (materials, parts) are files in the scene's
/// folder, and are noted.
class SceneFileSystem final : public Assimp::DefaultIOSystem {
 public:
  SceneFileSystem(SceneFilePtr file, std::string name, std::string& parts, bool is_ac3d)
      : file_(std::move(file)), name_(std::move(name)), parts_(parts), is_ac3d_(is_ac3d) {}
  bool Exists(const char* name) const override { return name == name_ || is_regular_file(name); }
  Assimp::IOStream* Open(const char* name, const char* mode) override {
    if (name == name_) return is_ac3d_ ? new Ac3dStream(file_) : new SceneStream(file_);
    Assimp::IOStream* const part = is_regular_file(name) ? DefaultIOSystem::Open(name, mode) : nullptr;
    if (part != nullptr) parts_.append(name).push_back('\0');
    return part;
  }

 private:
  SceneFilePtr file_;
  std::string name_;
  std::string& parts_;
  bool is_ac3d_;
};

}  // namespace bp
