#pragma once
#include <string>

/// Checks that the name of an output does not promise another kind of file than the tool writes. A name promises
/// nothing if its ending is no known format. All functions throw bad_argument and tell the right name.
namespace bp {

/// For tools that write voxels.
void check_stream_name(const std::string& output);

/// For bpdeform bind.
void check_weights_name(const std::string& output);

/// For tools that write `files` to a folder; `name`: how the message calls the folder. An existing folder may have any
/// name, and so may one with a slash at the end.
void check_folder_name(const std::string& output, const std::string& name, const std::string& files);

}  // namespace bp
