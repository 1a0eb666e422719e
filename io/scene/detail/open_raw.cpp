#include "io/scene/detail/open_raw.h"

#include <algorithm>
#include <cstring>

#include "io/files/lower.h"
#include "io/scene/detail/foreign_format.h"
#include "io/scene/scene_format.h"
#include "io/stream/stream_format.h"
#include "lib/core/error.h"

namespace bp {

namespace {

enum class Reader { ply, stl, obj, off, gltf, tileset, other, unknown };

Reader reader_of(const std::string& extension) {
  if (extension == "ply") return Reader::ply;
  if (extension == "stl" || extension == "stla" || extension == "stlb") return Reader::stl;
  if (extension == "obj") return Reader::obj;
  if (extension == "off") return Reader::off;
  if (extension == "gltf" || extension == "glb") return Reader::gltf;
  return extension.empty() ? Reader::unknown : Reader::other;
}

constexpr std::size_t kStart = 1024;  // bytes in which a format is looked for

/// Returns the size of a binary STL that begins so; 0: none does.
std::uint64_t binary_stl_size(const std::string& start) {
  if (start.size() < 84) return 0;
  std::uint32_t triangles = 0;
  std::memcpy(&triangles, start.data() + 80, sizeof triangles);
  return 84 + std::uint64_t(50) * triangles;
}

std::string start_of(const SceneFile& file) {
  std::string start(kStart, '\0');
  start.resize(file.read_at(0, std::as_writable_bytes(std::span(start))));
  return start;
}

/// Returns the reader that the first bytes of a file tell; else the one that its name tells. `extension` is set for a
/// format that goes to Assimp.
Reader reader_by_content(const std::string& start, std::uint64_t size, std::string& extension) {
  if (size == binary_stl_size(start)) return Reader::stl;
  const std::size_t first = start.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
  const std::string text = first == std::string::npos ? std::string() : start.substr(first);
  const auto begins = [&](const char* word) { return text.compare(0, std::strlen(word), word) == 0; };
  if (begins("ply\n") || begins("ply\r")) return Reader::ply;
  if (begins("glTF") || (begins("{") && text.find('"') != std::string::npos)) return Reader::gltf;
  if (lower(text.substr(0, 5)) == "solid") return Reader::stl;
  for (const char* keyword : {"OFF", "COFF", "NOFF", "CNOFF", "STOFF"}) {
    if (begins(keyword)) return Reader::off;
  }
  for (const char* line : {"\nv ", "\nf ", "\nmtllib "}) {
    if (("\n" + text).find(line) != std::string::npos) return Reader::obj;
  }
  if (begins("AC3D")) extension = "ac";
  if (begins("<?xml") && text.find("<COLLADA") != std::string::npos) extension = "dae";
  return reader_of(extension);
}

void refuse_brick_stream(const std::string& name, const std::string& start) {
  std::uint32_t magic = 0;
  std::memcpy(&magic, start.data(), std::min(start.size(), sizeof magic));
  if (magic == detail::kFrameMagic)
    fail(ErrorCode::bad_input, "{}: a stream of voxels, not a scene or a mesh; bpmesh makes a mesh of it", name);
}

[[noreturn]] void fail_unknown(const std::string& name) {
  fail(ErrorCode::bad_input, {Remedy::name_format}, "{}: neither its name nor its first bytes tell its format", name);
}

/// Refuses a pipe as soon as no format fits what came of it: a device may have no end, and all that came is written to
/// a scratch file.
void refuse_pipe(const std::string& name, const std::string& all, std::uint64_t bytes) {
  const std::string start = all.substr(0, kStart);
  std::string extension;
  refuse_brick_stream(name, start);
  refuse_foreign(name, start);
  if (reader_by_content(start, bytes, extension) == Reader::unknown && bytes > binary_stl_size(start))
    fail_unknown(name);
}

}  // namespace

RawSourcePtr open_raw(const SceneFilePtr& file, const std::string& path, const SceneOptions& options) {
  std::string extension = scene_format_of(path);
  if (extension.empty() && !options.format.empty()) extension = scene_format_named(options.format);
  Reader reader = reader_of(extension);
  if (file->size() == 0)  // of any format: what a tool writes without faces has a few words at least
    fail(ErrorCode::bad_input, "{}: is empty; did the tool before it fail?", file->name());
  if (reader != Reader::other) {
    const std::string start = start_of(*file);
    refuse_foreign(file->name(), start);
    reader = reader_by_content(start, file->size(), extension);
  }
  if (reader == Reader::gltf && lower(path).ends_with(".json")) reader = Reader::tileset;
  if (!options.parts.empty() && reader != Reader::obj && reader != Reader::gltf && reader != Reader::tileset)
    fail(ErrorCode::bad_input, "{}: names of parts are known of OBJ and glTF, and this is neither", file->name());
  switch (reader) {
    case Reader::ply:
      return open_ply(file, options);
    case Reader::stl:
      return open_stl(file, options);
    case Reader::obj:
      return open_obj(file, options);
    case Reader::off:
      return open_off(file, options);
    case Reader::gltf:
      return open_gltf(file, options);
    case Reader::tileset:
      return open_tileset(file, options);
    case Reader::other:
      return open_with_assimp(file, extension, options);
    case Reader::unknown:
      break;
  }
  fail_unknown(file->name());
}

SceneFilePtr open_scene_or_mesh(const std::string& path, const SceneOptions& options) {
  const bool is_named = !options.format.empty() || !scene_format_of(path).empty();
  SceneFilePtr file =
      open_scene_file(path, temp_dir_of(options), NamedBy::user, is_named ? PipeCheck() : PipeCheck(refuse_pipe));
  refuse_brick_stream(file->name(), start_of(*file));
  return file;
}

RawSourcePtr open_raw(const std::string& path, const SceneOptions& options) {
  return open_raw(open_scene_or_mesh(path, options), path, options);
}

}  // namespace bp
