#pragma once
#include <string>

/// The kind of file that the name of an output promises.
namespace bp {

enum class FileKind {
  unknown,  ///< no ending, or one that no known format has
  scene,    ///< a mesh, a scene or a drawing, whether it is read here or not
  voxels,   ///< a volume of voxels of another program
  stream,   ///< voxels of this suite (.bpv)
  weights,  ///< of bpdeform (.bpw)
  document  ///< a picture, a table, a text or an archive
};

struct FileEnding {
  FileKind kind = FileKind::unknown;
  std::string text;  ///< in lower case, without a dot; empty: unknown

  [[nodiscard]] bool is(FileKind asked) const { return kind == asked; }
};

/// Returns the ending of a name. The ending of a packer (.gz, .zst) is skipped: "nii" for a.nii.gz.
[[nodiscard]] FileEnding file_ending_of(const std::string& path);

/// Returns the name with another ending instead of its own and a packer's: "a.bpv" for a.nii.gz; without any if
/// `ending` is empty.
[[nodiscard]] std::string with_ending(const std::string& path, const std::string& ending);

}  // namespace bp
