#pragma once
#include <string>
#include <vector>

#include "tools/view/tool_pipe.h"
#include "tools/view/view_options.h"

/// The command lines of a design, which bpview runs and shows.
namespace bp {

/// The names that stand for the files that bpview keeps in memory.
struct CommandFiles {
  std::string rules, stream;  ///< as bpscale reads them
  std::string out;            ///< as bpmesh writes it
};

/// Returns `bpvox SCENE... OPTIONS`, which writes to stdout.
[[nodiscard]] ToolCommand voxelize_command(const ViewOptions& options);
/// Returns the tools from the stream of voxels to the proxy.
[[nodiscard]] std::vector<ToolCommand> mesh_commands(const ViewOptions& options, std::uint64_t faces,
                                                     const CommandFiles& files);
/// Returns the tool that prints the verdict on a proxy as JSON.
[[nodiscard]] ToolCommand check_command(const ViewOptions& options, const std::string& proxy);

/// Returns all of it in one line, to copy into a shell: from the scene to the file of the proxy.
[[nodiscard]] std::string command_line(const ViewOptions& options, std::uint64_t faces);

}  // namespace bp
