#pragma once
#include <cstdint>
#include <exception>
#include <functional>
#include <string>

/// Work that may crash, hang or eat all memory, in a process of its own.
namespace bp {

struct ChildLimits {
  std::uint64_t memory_bytes = std::uint64_t(1) << 30;  ///< of address space, beyond what this process has now
  std::uint64_t cpu_seconds = 60;
  std::uint64_t wall_seconds = 600;
  std::uint64_t answer_bytes = std::uint64_t(1) << 40;  ///< of what it returns
};

/// The child needs more memory than it may take, or wants to return more. The caller knows what to say of it.
class ChildOutOfMemory : public std::exception {};

/// Forks, runs `work` in the child and returns what it returned. What the child prints is dropped. An Error thrown in
/// the child is thrown here; any other exception, a signal and a time limit that was hit become bad_input
/// "name: what WHY; remedy"; memory that is not there ChildOutOfMemory. Call it before other threads hold locks that
/// `work` may need.
[[nodiscard]] std::string run_in_child(const std::string& name, const std::string& what, const std::string& remedy,
                                       const ChildLimits& limits, const std::function<std::string()>& work);

}  // namespace bp
