#pragma once
#include <fmt/format.h>

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

/// The one exception type of the suite. Thrown anywhere, caught once per process in tools/cli/run_tool.h, which
/// prints the message and exits with exit_code(). A message names the object and the fact (docs/exit-codes.md). The
/// library does not know the options of a tool: what would help is a Remedy, and tools/cli/advice.h names the option.
namespace bp {

enum class ErrorCode {
  failed,           ///< the work could not be done, for a reason that is none of the below
  bad_argument,     ///< the caller asked for something impossible: a usage error
  bad_input,        ///< an input is missing, broken, truncated or of the wrong kind
  out_of_resource,  ///< memory, disk or device exhausted or absent
  closed_pipe,      ///< the reader of our output went away: end quietly
};

/// Process exit status: 1 failed, 2 usage, 3 bad input, 4 out of memory, disk or device; 141 for a closed pipe (128 +
/// SIGPIPE).
[[nodiscard]] constexpr int exit_code(ErrorCode code) {
  switch (code) {
    case ErrorCode::failed:
      return 1;
    case ErrorCode::bad_argument:
      return 2;
    case ErrorCode::bad_input:
      return 3;
    case ErrorCode::out_of_resource:
      return 4;
    case ErrorCode::closed_pipe:
      return 141;
  }
  return 1;
}

/// What would help.
enum class Remedy {
  more_memory,
  larger_voxels,
  smaller_voxels,
  coarser_grid,    ///< where the tool itself makes the voxels
  units_of_scene,  ///< for the size of voxels
  other_units,     ///< for the scene
  smaller_scale,
  smaller_tiles,
  larger_tiles,
  fewer_faces,
  split_scene,
  move_scene,  ///< nearer to its origin
  repair_file,
  flood_fill,
  fill_inside,  ///< the stream holds what the scene touches, and should hold its inside
  mode_inside,  ///< the other way round
  enclose_closing,
  enclose_input,
  enclose_own_scene,  ///< that the stream was made from
  no_volume,
  no_textures,
  fewer_users_of_device,
  use_cpu,
  other_scratch_folder,
  other_output,
  overwrite,
  name_format,
  name_scene_format,  ///< where a stream of voxels is expected, but a scene will do
  set_origin,
  double_format,  ///< one that holds doubles
  ply_format,     ///< the one without a limit on what it holds
  free_space,     ///< on the disk of what is written
};
using Remedies = std::vector<Remedy>;

class Error : public std::runtime_error {
 public:
  Error(ErrorCode code, const std::string& message, Remedies remedies = {}, std::uint64_t memory_bytes = 0)
      : std::runtime_error(message), code_(code), remedies_(std::move(remedies)), memory_bytes_(memory_bytes) {}
  [[nodiscard]] ErrorCode code() const { return code_; }
  [[nodiscard]] const Remedies& remedies() const { return remedies_; }  ///< any one of them
  /// Of Remedy::more_memory: the limit on memory that would do; 0: not known.
  [[nodiscard]] std::uint64_t memory_bytes() const { return memory_bytes_; }

 private:
  ErrorCode code_;
  Remedies remedies_;
  std::uint64_t memory_bytes_;
};

/// A step does not fit in its share of the memory.
class NeedsMemory : public Error {
 public:
  /// what: "closing a tile of 64 voxels". needed, left: bytes of the step and of its share. limit: as memory_bytes().
  NeedsMemory(const std::string& what, std::uint64_t needed, std::uint64_t left, std::uint64_t limit,
              const Remedies& others = {})
      : Error(ErrorCode::out_of_resource,
              fmt::format("{} takes {} MiB, and the limit on memory leaves {} MiB for it", what, (needed >> 20) + 1,
                          left >> 20),
              with_memory(others), limit),
        needed_(needed) {}
  [[nodiscard]] std::uint64_t needed_bytes() const { return needed_; }  ///< of the step

 private:
  std::uint64_t needed_;
  static Remedies with_memory(const Remedies& others) {
    Remedies all{Remedy::more_memory};
    all.insert(all.end(), others.begin(), others.end());
    return all;
  }
};

/// fail(ErrorCode::bad_input, "{}: no triangles", name) throws an Error with the formatted message.
template <class... Args>
[[noreturn]] void fail(ErrorCode code, fmt::format_string<Args...> format, Args&&... args) {
  throw Error(code, fmt::format(format, std::forward<Args>(args)...));
}
/// The same, with what would help.
template <class... Args>
[[noreturn]] void fail(ErrorCode code, Remedies remedies, fmt::format_string<Args...> format, Args&&... args) {
  throw Error(code, fmt::format(format, std::forward<Args>(args)...), std::move(remedies));
}
/// fail_as(e, "{}: {}", name, e.what()) throws the error `e` again with another message, which tells where it happened
/// or what it left. Code, remedies and memory_bytes() stay.
template <class... Args>
[[noreturn]] void fail_as(const Error& e, fmt::format_string<Args...> format, Args&&... args) {
  throw Error(e.code(), fmt::format(format, std::forward<Args>(args)...), e.remedies(), e.memory_bytes());
}

}  // namespace bp
