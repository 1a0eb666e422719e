#pragma once
#include <string>
#include <vector>

namespace bp {

/// Keeps a scene and the files that it names from being replaced or removed while a KeepsInputs lives (keep_file(),
/// io/files/kept_files.h).
void keep_scene(const std::string& path);

/// Returns the paths of the other files of a scene: buffers and images of glTF, materials of OBJ and their textures.
/// Quick, since it only serves warnings: at most 64 MiB of JSON are read, and the first 64 KiB of OBJ, where the names
/// stand (1 MiB of MTL). None for a file that cannot be read. A broken document gives the names before the fault.
/// Memory: for JSON, 4 MiB of names and 100 KiB, whatever its size.
[[nodiscard]] std::vector<std::string> parts_of_scene(const std::string& path);

/// Returns the materials that an OBJ names in its first 64 KiB and that do not exist, or are no regular files: its
/// colours are lost. Each is a path with what is wrong, as "a.mtl is not there".
[[nodiscard]] std::vector<std::string> missing_materials(const std::string& path);

}  // namespace bp
