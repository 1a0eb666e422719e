#pragma once
#include <string>
#include <vector>

namespace bp {

/// From now on, while a KeepsInputs lives, nothing replaces or removes this scene, nor the files that it names
/// (keep_file(), io/files/kept_files.h).
void keep_scene(const std::string& path);

/// Paths of the other files that a scene consists of: buffers and images of glTF, materials of OBJ and their textures.
/// Quick, for the sake of a warning: no more than 64 MiB of JSON are looked at, and the first 64 KiB of OBJ, where the
/// names stand (1 MiB of MTL); none of a file that cannot be read. A broken document gives those before the fault.
/// Memory: of JSON, 4 MiB of names and 100 KiB, whatever its size.
[[nodiscard]] std::vector<std::string> parts_of_scene(const std::string& path);

/// Materials that an OBJ names and that are not there: its colours are lost. Of the same first 64 KiB.
[[nodiscard]] std::vector<std::string> missing_materials(const std::string& path);

}  // namespace bp
