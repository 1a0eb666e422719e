#include "tools/cli/advice.h"

#include <string_view>

namespace bp {

namespace {

const char* text_of(Remedy remedy) {
  switch (remedy) {
    case Remedy::more_memory:
      return "raise --memory";
    case Remedy::larger_voxels:
      return "use larger voxels";
    case Remedy::smaller_voxels:
      return "use smaller voxels";
    case Remedy::coarser_grid:
      return "use a larger --voxel or a smaller --resolution";
    case Remedy::units_of_scene:
      return "give --voxel in the units of the scene";
    case Remedy::other_units:
      return "convert the scene to another unit of length";
    case Remedy::smaller_scale:
      return "use a smaller --scale";
    case Remedy::smaller_tiles:
      return "use a smaller --tile";
    case Remedy::larger_tiles:
      return "use a larger --tile";
    case Remedy::fewer_faces:
      return "use fewer faces";
    case Remedy::split_scene:
      return "split it";
    case Remedy::move_scene:
      return "move the scene near to its origin";
    case Remedy::repair_file:
      return "repair or re-export the file";
    case Remedy::flood_fill:
      return "use --fill flood";
    case Remedy::fill_inside:
      return "voxelize with bpvox --fill inside";
    case Remedy::mode_inside:
      return "use --mode inside";
    case Remedy::enclose_closing:
      return "use --enclose closing";
    case Remedy::enclose_input:
      return "use --enclose input";
    case Remedy::enclose_own_scene:
      return "name with --enclose the scene that bpvox read";
    case Remedy::no_volume:
      return "leave out --volume";
    case Remedy::fewer_users_of_device:
      return "run fewer tools on this GPU";
    case Remedy::use_cpu:
      return "use --device cpu";
    case Remedy::other_scratch_folder:
      return "choose another --temp";
    case Remedy::other_output:
      return "name another output";
    case Remedy::overwrite:
      return "add --overwrite to replace it";
    case Remedy::name_format:
      return "name it with --format";
    case Remedy::name_scene_format:
      return "name the format of a scene with --format";
    case Remedy::no_textures:
      return "use --appearance color";
    case Remedy::set_origin:
      return "set --origin";
    case Remedy::double_format:
      return "write GLB, PLY or OBJ";
    case Remedy::ply_format:
      return "write PLY";
    case Remedy::free_space:
      return "free some space";
  }
  return "";
}

/// Returns whether an advice suits a tool: it names an option that the tool has, or no option, or one of bpvox by its
/// name.
bool suits(const std::function<bool(const std::string&)>& has, std::string_view advice) {
  const std::size_t at = advice.find("--");
  if (at == std::string_view::npos || advice.find("bpvox") != std::string_view::npos) return true;
  return !has || has(std::string(advice.substr(at, advice.find(' ', at) - at)));
}

}  // namespace

std::string advised(const Error& error, const std::function<bool(const std::string&)>& has) {
  std::string text = error.what();
  const std::size_t fact = text.rfind(": ");
  // No advice has been added yet.
  bool first = text.find("; ", fact == std::string::npos ? 0 : fact) == std::string::npos;
  std::string_view before;
  Remedies remedies;
  for (const Remedy remedy : error.remedies())
    if (suits(has, text_of(remedy))) remedies.push_back(remedy);
  for (const Remedy& remedy : remedies) {
    const bool last = &remedy == &remedies.back();
    text += first ? "; " : last ? ", or " : ", ";
    std::string_view words = text_of(remedy);
    if (before.starts_with("use ") && words.starts_with("use ")) words.remove_prefix(4);  // "use" is there already
    before = text_of(remedy);
    text += words;
    if (remedy == Remedy::more_memory && error.memory_bytes() > 0)
      text += fmt::format(" to at least {} MiB", (error.memory_bytes() + (1 << 20) - 1) >> 20);
    first = false;
  }
  return text;
}

}  // namespace bp
