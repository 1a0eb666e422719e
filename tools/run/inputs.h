#pragma once
#include <string>
#include <vector>

/// What tools ask of the files that they read, before any work.
namespace bp {

/// --format is for stdin, and for files whose names do not tell. Throws bad_argument if it names no scene format, or if
/// all names tell another one: it would be passed over in silence.
void check_scene_format(const std::string& format, const std::vector<std::string>& inputs);

/// Whether their names, or the format where these do not tell, say that all are glTF.
[[nodiscard]] bool are_gltf(const std::string& format, const std::vector<std::string>& inputs);

/// The tileset.json in a folder that has one; a file as it is. Throws bad_argument for any other folder, and names the
/// meshes in it.
[[nodiscard]] std::string tileset_in(const std::string& path);

/// Whether a file that can be read again begins as streams of voxels do.
[[nodiscard]] bool begins_as_stream(const std::string& path);

}  // namespace bp
