#include "tools/mesh/scale_advice.h"

#include "lib/core/parallel.h"
#include "lib/device/cpu/cpu_backend.h"
#include "lib/pass/mesh/scale_search.h"
#include "tools/cli/length.h"
#include "tools/cli/progress.h"
#include "tools/mesh/mesh_memory.h"
#include "tools/run/memory_shares.h"

namespace bp {

namespace {

/// The value of `key` in the canonical text of the last step of bpclose; empty if there is none.
std::string option_of_bpclose(const StreamHeader& header, const std::string& key) {
  if (header.provenance.empty() || header.provenance.back().tool != "bpclose") return "";
  const std::string text = " " + header.provenance.back().options + " ", name = " " + key + "=";
  const std::size_t at = text.find(name);
  if (at == std::string::npos) return "";
  const std::size_t begin = at + name.size();
  return text.substr(begin, text.find(' ', begin) - begin);
}

Backends cpu_backends() {
  Backends backends;
  for (int i = 0; i < thread_count(); ++i) backends.push_back(std::make_unique<CpuBackend>());
  return backends;
}

}  // namespace

bool is_closed_by_scale(const StreamHeader& header) {
  return header.has_closing && header.scale.constant();
}

bool has_scale_to_raise(const StreamHeader& header) {
  return is_closed_by_scale(header) && header.fill != FillMode::inside && header.scale.base > 0 &&
         !option_of_bpclose(header, "scale").empty();
}

std::optional<std::string> enough_scale(const StreamHeader& header, BrickShelf& solid, std::uint64_t faces,
                                        const ShelfFactory& make_shelf, const CommonOptions& common) {
  try {
    Progress progress("bpmesh", common.progress);
    Length scale = parse_length(option_of_bpclose(header, "scale"));
    ScaleSearch search;
    search.faces = faces;
    search.keep_cavities = option_of_bpclose(header, "keep-cavities") == "yes";
    search.context.pieces = mesh_memory(common);
    search.context.memory.bytes = search.context.pieces.work_bytes;
    search.context.make_shelf = make_shelf;
    search.context.progress = progress.for_pass("try scales: ");
    Backends backends = cpu_backends();
    const std::optional<int> times = enough_scales(header, solid, backends, search);
    if (!times) return "";
    scale.value *= *times;
    return scale.text();
  } catch (const std::exception&) {  // out of memory, a full disk, no further thread
    return std::nullopt;
  }
}

}  // namespace bp
