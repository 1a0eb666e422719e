#pragma once
#include <string>
#include <vector>

#include "tools/view/tool_pipe.h"
#include "tools/view/view_options.h"

/// The command lines of a design: what bpview runs, and what it shows.
namespace bp {

/// What stands for the files that bpview keeps in memory.
struct CommandFiles {
  std::string rules, stream;  ///< as bpscale reads them
  std::string out;            ///< as bpmesh writes it
};

/// Of the scene: `bpvox SCENE... OPTIONS`, to stdout.
[[nodiscard]] ToolCommand voxelize_command(const ViewOptions& options);
/// From the stream of voxels to the proxy.
[[nodiscard]] std::vector<ToolCommand> mesh_commands(const ViewOptions& options, std::uint64_t faces,
                                                     const CommandFiles& files);
/// The verdict on a proxy as JSON.
[[nodiscard]] ToolCommand check_command(const ViewOptions& options, const std::string& proxy);

/// All of it in one line, to copy into a shell: from the scene to the file of the proxy.
[[nodiscard]] std::string command_line(const ViewOptions& options, std::uint64_t faces);

}  // namespace bp
