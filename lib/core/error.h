#pragma once
#include <fmt/format.h>

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

/// The one exception type of the suite. It is thrown anywhere and caught once per process, in tools/cli/run_tool.h,
/// which prints the message and exits with exit_code(). A message names the object and the fact (docs/exit-codes.md).
/// The library does not know the options of a tool: a Remedy says what would help, and tools/cli/advice.h names the
/// option.
namespace bp {

enum class ErrorCode {
  failed,           ///< the work could not be done, for a reason that is none of the below
  bad_argument,     ///< the caller asked for something impossible: a usage error
  bad_input,        ///< an input is missing, broken, truncated or of the wrong kind
  out_of_resource,  ///< memory, disk or device exhausted or absent
  closed_pipe,      ///< the reader of our output went away: end quietly
};

/// Returns the exit status of the process: 1 failed, 2 usage, 3 bad input, 4 out of memory, disk or device. A closed
/// pipe has 141, which is 128 + SIGPIPE.
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

/// A remedy that would help the user.
enum class Remedy {
  more_memory,
  larger_voxels,
  smaller_voxels,
  coarser_grid,    ///< larger voxels, where the tool itself makes them
  units_of_scene,  ///< the size of voxels in units of the scene
  other_units,     ///< other units for the scene
  smaller_scale,
  smaller_tiles,
  larger_tiles,
  fewer_faces,
  split_scene,
  move_scene,  ///< move the scene nearer to its origin
  repair_file,
  flood_fill,
  fill_inside,  ///< the stream holds only the voxels that the scene touches; its inside is needed
  mode_inside,  ///< the stream holds only the inside; `--mode inside` is needed
  enclose_closing,
  enclose_input,
  enclose_own_scene,  ///< enclose the scene that the stream was made from
  no_volume,
  no_textures,
  fewer_users_of_device,
  use_cpu,
  other_scratch_folder,
  other_output,
  overwrite,
  name_format,
  name_scene_format,  ///< the input is taken for a stream of voxels; if it is a scene, name its format
  set_origin,
  double_format,  ///< choose a format that holds doubles
  ply_format,     ///< choose PLY, which has no limit on the size of a mesh
  free_space,     ///< free space on the disk that is written to
};
using Remedies = std::vector<Remedy>;

class Error : public std::runtime_error {
 public:
  Error(ErrorCode code, const std::string& message, Remedies remedies = {}, std::uint64_t memory_bytes = 0)
      : std::runtime_error(message), code_(code), remedies_(std::move(remedies)), memory_bytes_(memory_bytes) {}
  [[nodiscard]] ErrorCode code() const { return code_; }
  [[nodiscard]] const Remedies& remedies() const { return remedies_; }  ///< each of them helps by itself
  /// Returns the limit on memory that would do, for Remedy::more_memory. 0: not known.
  [[nodiscard]] std::uint64_t memory_bytes() const { return memory_bytes_; }

 private:
  ErrorCode code_;
  Remedies remedies_;
  std::uint64_t memory_bytes_;
};

/// Thrown if a step does not fit in its share of the memory.
class NeedsMemory : public Error {
 public:
  /// `what` is, for example, "closing a tile of 64 voxels". `needed` and `left` are the bytes of the step and of its
  /// share. `limit` is that of memory_bytes().
  NeedsMemory(const std::string& what, std::uint64_t needed, std::uint64_t left, std::uint64_t limit,
              const Remedies& others = {})
      : Error(ErrorCode::out_of_resource,
              fmt::format("{} takes {} MiB, and the limit on memory leaves {} MiB for it", what, (needed >> 20) + 1,
                          left >> 20),
              with_memory(others), limit),
        needed_(needed) {}
  [[nodiscard]] std::uint64_t needed_bytes() const { return needed_; }  ///< that the step would take

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
/// Throws an Error with the formatted message and with remedies.
template <class... Args>
[[noreturn]] void fail(ErrorCode code, Remedies remedies, fmt::format_string<Args...> format, Args&&... args) {
  throw Error(code, fmt::format(format, std::forward<Args>(args)...), std::move(remedies));
}
/// fail_as(e, "{}: {}", name, e.what()) throws the error `e` again with a message that also tells where it happened, or
/// what it left behind. Code, remedies and memory_bytes() stay.
template <class... Args>
[[noreturn]] void fail_as(const Error& e, fmt::format_string<Args...> format, Args&&... args) {
  throw Error(e.code(), fmt::format(format, std::forward<Args>(args)...), e.remedies(), e.memory_bytes());
}

/// fail_with_limit(e, limit) throws the error `e` again. It names the limit on memory that limit() returns, at which
/// other steps fit, too, if that is more than its own. If counting fails, the refusal stays as it was.
template <class Limit>
[[noreturn]] void fail_with_limit(const Error& e, const Limit& limit) {
  std::uint64_t most = 0;
  try {
    most = limit();
  } catch (const Error&) {
    most = 0;
  }
  throw Error(e.code(), e.what(), e.remedies(), e.memory_bytes() > most ? e.memory_bytes() : most);
}

/// Calls work(). A refusal that names a limit on memory is thrown again with limit() as fail_with_limit() does. Without
/// a limit of its own it is thrown as it is, since nobody would learn a number.
template <class Work, class Limit>
decltype(auto) naming_limit(const Work& work, const Limit& limit) {
  try {
    return work();
  } catch (const Error& e) {
    if (e.memory_bytes() == 0) throw;
    fail_with_limit(e, limit);
  }
}

}  // namespace bp
