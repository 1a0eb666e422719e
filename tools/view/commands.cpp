#include "tools/view/commands.h"

#include "lib/levels/voxel_choice.h"
#include "tools/cli/names.h"
#include "tools/cli/shell_word.h"

namespace bp {

namespace {

/// Adds options that change no result. Only the tools that bpview runs itself get them.
void add_resources(ToolCommand& command, const ViewOptions& o) {
  command.insert(command.end(), {"--threads", std::to_string(o.common.threads), "--memory",
                                 std::to_string(o.common.memory_bytes), "--temp", o.common.temp});
}

/// Returns a name that no tool takes for an option.
std::string as_file(const std::string& name) {
  return name.starts_with('-') ? "./" + name : name;
}

void add_scenes(ToolCommand& command, const ViewOptions& o) {
  for (const std::string& scene : o.voxels.scenes) command.push_back(as_file(scene));
}

ToolCommand voxelize(const ViewOptions& o) {
  ToolCommand command{"bpvox"};
  add_scenes(command, o);
  if (!o.voxels.format.empty()) command.insert(command.end(), {"--format", o.voxels.format});
  if (o.voxels.voxel) {
    command.insert(command.end(), {"--voxel", o.voxels.voxel->text()});
  } else {
    const auto resolution = o.voxels.resolution.value_or(kDefaultResolution);
    command.insert(command.end(), {"--resolution", std::to_string(resolution)});
  }
  if (o.voxels.fill != FillMode::flood) command.insert(command.end(), {"--fill", name_of(o.voxels.fill)});
  if (o.voxels.up) command.push_back(std::string("--up=") + name_of(*o.voxels.up));
  return command;
}

ToolCommand close(const ViewOptions& o) {
  ToolCommand command{"bpclose"};
  if (o.closing.element != StructuringElement::cube)
    command.insert(command.end(), {"--element", name_of(o.closing.element)});
  return command;
}

ToolCommand mesh(std::uint64_t faces, const std::string& out) {
  return {"bpmesh", "--faces", std::to_string(faces), "-o", out};
}

}  // namespace

ToolCommand voxelize_command(const ViewOptions& options) {
  ToolCommand command = voxelize(options);
  add_resources(command, options);
  return command;
}

std::vector<ToolCommand> mesh_commands(const ViewOptions& options, std::uint64_t faces, const CommandFiles& files) {
  std::vector<ToolCommand> commands{{"bpscale", files.rules, files.stream}, close(options), mesh(faces, files.out)};
  for (ToolCommand& command : commands) add_resources(command, options);
  return commands;
}

ToolCommand check_command(const ViewOptions& options, const std::string& proxy) {
  ToolCommand command{"bpcheck"};
  add_scenes(command, options);
  command.insert(command.end(), {as_file(proxy), "--json"});
  add_resources(command, options);
  return command;
}

std::string command_line(const ViewOptions& options, std::uint64_t faces) {
  std::string line;
  for (const ToolCommand& command :
       {voxelize(options), ToolCommand{"bpscale", options.rules}, close(options), mesh(faces, options.out)}) {
    if (!line.empty()) line += " | ";
    for (std::size_t i = 0; i < command.size(); ++i) {
      const bool option = command[i].starts_with("--") || command[i] == "-o";
      line += (i == 0 ? "" : " ") + (option ? command[i] : shell_word(command[i]));
    }
  }
  return line;
}

}  // namespace bp
