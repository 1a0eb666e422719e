#pragma once
#include <span>

/// The images of AC3D files by TORCS and Speed Dreams, whose objects have one in each of four layers.
namespace bp {

/// Makes all images of an AC3D file lines that no reader knows, apart from those that are drawn as colours: `texture
/// "x.png"`, or with the word `base` behind. The layers `tiled`, `skids` and `shad` are drawn over it. A name without
/// quotes
/// (`empty_texture_no_mapping`) stands for no image. Assimp takes the last image of an object, whatever its layer, and
/// calls one without quotes "ERROR".
void keep_base_layers(std::span<char> ac3d);

}  // namespace bp
