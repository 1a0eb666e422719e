#pragma once
#include <cstdint>
#include <exception>
#include <functional>
#include <string>

/// Work that may crash, hang or eat all memory, in a process of its own.
namespace bp {

struct ChildLimits {
  std::uint64_t memory_bytes = std::uint64_t(1) << 30;  ///< address space, beyond what this process has now
  std::uint64_t cpu_seconds = 60;
  std::uint64_t wall_seconds = 600;
  std::uint64_t answer_bytes = std::uint64_t(1) << 40;  ///< largest answer
};

/// Thrown if the child needs more memory than it may take, or wants to return more. The caller words the error.
class ChildOutOfMemory : public std::exception {};

/// Forks, runs `work` in the child and returns its result. Output of the child is dropped. An Error thrown in the child
/// is thrown here; any other exception, a signal and an exceeded time limit become bad_input "name: what WHY; remedy";
/// missing memory becomes ChildOutOfMemory. To be called before other threads hold locks that `work` may need.
[[nodiscard]] std::string run_in_child(const std::string& name, const std::string& what, const std::string& remedy,
                                       const ChildLimits& limits, const std::function<std::string()>& work);

}  // namespace bp
