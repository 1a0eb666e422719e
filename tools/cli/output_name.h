#pragma once
#include <string>

/// Whether the names of outputs promise what a tool writes. A name promises nothing if no known format has its ending.
/// All of them throw bad_argument, and tell the right name.
namespace bp {

/// For tools that write voxels: the name must not promise another kind of file.
void check_stream_name(const std::string& output);

/// For bpdeform bind.
void check_weights_name(const std::string& output);

/// For tools that write `files` to a folder; `name` is what they call them. A folder that is there may have any name,
/// and so may one with a slash at the end.
void check_folder_name(const std::string& output, const std::string& name, const std::string& files);

}  // namespace bp
