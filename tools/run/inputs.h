#pragma once
#include <string>
#include <vector>

/// Checks of input files before any work.
namespace bp {

/// Checks --format, which is for stdin and for files whose names do not tell. Throws bad_argument if it names no scene
/// format, or if all names tell another format: it would be ignored silently.
void check_scene_format(const std::string& format, const std::vector<std::string>& inputs);

/// Returns whether all inputs are glTF, by their names, or by `format` where these do not tell.
[[nodiscard]] bool are_gltf(const std::string& format, const std::vector<std::string>& inputs);

/// Returns the tileset.json in a folder that has one; the path of a file as it is. Throws bad_argument for any other
/// folder, and names the meshes in it.
[[nodiscard]] std::string tileset_in(const std::string& path);

/// Returns whether a file begins as a stream of voxels. False for files that can be read only once.
[[nodiscard]] bool begins_as_stream(const std::string& path);

}  // namespace bp
