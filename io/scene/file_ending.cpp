#include "io/scene/file_ending.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "io/files/lower.h"
#include "io/scene/detail/foreign_format.h"
#include "io/scene/scene_format.h"

namespace bp {

namespace {

constexpr std::array<std::string_view, 21> kVoxels = {"binvox", "vox",  "npy", "npz",  "vdb", "nvdb", "nii",
                                                      "nrrd",   "nhdr", "mhd", "mha",  "vti", "vtk",  "vtu",
                                                      "tif",    "tiff", "h5",  "hdf5", "qb",  "kvx",  "schem"};
constexpr std::array<std::string_view, 18> kDocuments = {"png",  "jpg", "jpeg", "exr", "tga", "webp",
                                                         "ktx2", "dds", "pdf",  "csv", "txt", "json",
                                                         "xml",  "log", "tar",  "tgz", "bz2", "mtl"};

template <std::size_t N>
bool holds(const std::array<std::string_view, N>& endings, const std::string& ending) {
  return std::find(endings.begin(), endings.end(), ending) != endings.end();
}

/// Returns the position of the ending, with its dot; the end if there is none.
std::size_t dot_of(const std::string& path) {
  const std::size_t dot = path.find_last_of("./");
  return dot == std::string::npos || path[dot] != '.' ? path.size() : dot;
}

std::string last_ending(const std::string& path) {
  const std::size_t dot = dot_of(path);
  return dot == path.size() ? "" : lower(path.substr(dot + 1));
}

std::string unpacked(const std::string& path) {
  const std::string ending = last_ending(path);
  return ending == "gz" || ending == "zst" ? path.substr(0, dot_of(path)) : path;
}

FileKind kind_of(const std::string& ending) {
  const std::string name = "." + ending;
  if (ending == "bpv") return FileKind::stream;
  if (ending == "bpw") return FileKind::weights;
  if (holds(kVoxels, ending)) return FileKind::voxels;
  if (holds(kDocuments, ending) || is_archive(name)) return FileKind::document;
  return !scene_format_of(name).empty() || !foreign_format(name).empty() ? FileKind::scene : FileKind::unknown;
}

}  // namespace

FileEnding file_ending_of(const std::string& path) {
  const std::string ending = last_ending(unpacked(path));
  const FileKind kind = ending.empty() ? FileKind::unknown : kind_of(ending);
  return {kind, kind == FileKind::unknown ? "" : ending};
}

std::string with_ending(const std::string& path, const std::string& ending) {
  const std::string name = unpacked(path), bare = name.substr(0, dot_of(name));
  return ending.empty() ? bare : bare + "." + ending;
}

}  // namespace bp
