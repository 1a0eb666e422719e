#pragma once
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "io/scene/scene_reader.h"
#include "lib/core/error.h"
#include "tests/catch.h"

/// Small files for the tests of readers and writers.
namespace bp::test {

/// Corners of a square, and its triangles from the first corner on.
inline const Vec3d kQuad[] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
inline const std::vector<TriangleD> kQuadFan{{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}}, {{{0, 0, 0}, {1, 1, 0}, {0, 1, 0}}}};

#if __has_include(<catch2/catch_all.hpp>)
inline auto Contains(const std::string& part) {
  return Catch::Matchers::ContainsSubstring(part);
}
#else
using Catch::Matchers::Contains;
#endif

/// A directory that goes away with its files.
class TempDir {
 public:
  TempDir() {
    static int serial = 0;
    path_ = std::filesystem::temp_directory_path() /
            ("bp-test-" + std::to_string(::getpid()) + "-" + std::to_string(serial++));
    std::filesystem::create_directories(path_);
  }
  ~TempDir() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TempDir(const TempDir&) = delete;
  TempDir& operator=(const TempDir&) = delete;

  [[nodiscard]] std::string path(const std::string& name) const { return (path_ / name).string(); }
  /// Writes a file and returns its path.
  [[nodiscard]] std::string file(const std::string& name, const std::string& bytes) const {
    std::filesystem::remove(path(name));  // truncating an old file would wait for the disk
    std::ofstream(path(name), std::ios::binary) << bytes;
    return path(name);
  }

 private:
  std::filesystem::path path_;
};

inline std::string bytes_of_file(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

inline std::vector<TriangleD> read_all(TriangleSource& source) {
  std::vector<TriangleD> all, batch;
  while (source.read(batch)) all.insert(all.end(), batch.begin(), batch.end());
  return all;
}
inline std::vector<TriangleD> read_all(const std::string& path, const SceneOptions& options = {}) {
  return read_all(*open_scene(path, options));
}

/// As TriangleSource::read_faces() gives them.
inline std::vector<std::uint8_t> read_inner_edges(TriangleSource& source) {
  std::vector<TriangleD> batch;
  std::vector<TriangleColors> colors;
  std::vector<std::uint8_t> all, inner_edges;
  while (source.read_faces(batch, colors, inner_edges)) all.insert(all.end(), inner_edges.begin(), inner_edges.end());
  return all;
}

/// Reads to the end and returns what was counted.
inline SceneCounts counts_of(const std::string& path, const SceneOptions& options = {}) {
  const auto source = open_scene(path, options);
  (void)read_all(*source);
  return source->counts();
}

/// Returns the message of the Error that reading `path` throws; "" if it throws none. Fails on any code but bad_input.
inline std::string complaint_of(const std::string& path, const SceneOptions& options = {}) {
  try {
    (void)read_all(path, options);
  } catch (const Error& e) {
    return e.code() == ErrorCode::bad_input ? e.what() : "wrong code: " + std::string(e.what());
  }
  return "";
}

/// Bytes of values, least significant byte first, or last.
template <class T>
std::string raw(T value, bool big_endian = false) {
  std::string bytes(reinterpret_cast<const char*>(&value), sizeof value);
  return big_endian ? std::string(bytes.rbegin(), bytes.rend()) : bytes;
}

}  // namespace bp::test
