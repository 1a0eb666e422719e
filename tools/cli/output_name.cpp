#include "tools/cli/output_name.h"

#include <filesystem>

#include "io/scene/file_ending.h"
#include "lib/core/error.h"

namespace bp {

void check_stream_name(const std::string& output) {
  const FileEnding ending = file_ending_of(output);
  if (ending.is(FileKind::unknown) || ending.is(FileKind::stream)) return;
  if (ending.is(FileKind::scene))
    fail(ErrorCode::bad_argument,
         "{}: this would be a stream of voxels, not a mesh; name it .bpv; bpmesh makes meshes of streams (.glb .gltf "
         ".ply .obj .stl)",
         output);
  fail(ErrorCode::bad_argument, "{}: this would be a stream of voxels, not a file of format {}; name it {}", output,
       ending.text, with_ending(output, "bpv"));
}

void check_weights_name(const std::string& output) {
  const FileEnding ending = file_ending_of(output);
  if (ending.is(FileKind::unknown) || ending.is(FileKind::weights)) return;
  fail(ErrorCode::bad_argument, "{}: bind writes weights, not a {}; name them {}", output,
       ending.is(FileKind::scene) ? "scene" : "file of format " + ending.text, with_ending(output, "bpw"));
}

void check_folder_name(const std::string& output, const std::string& name, const std::string& files) {
  const FileEnding ending = file_ending_of(output);
  std::error_code none;
  if (ending.is(FileKind::unknown) || std::filesystem::is_directory(output, none)) return;
  const std::string bare = with_ending(output, "");
  fail(ErrorCode::bad_argument,
       "-o {}: this is the name of a file, and bplod writes several files to a folder: {}; did you mean -o {}?", output,
       files, bare.empty() || bare.ends_with('/') ? bare + name : bare);
}

}  // namespace bp
