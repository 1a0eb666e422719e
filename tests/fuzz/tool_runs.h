#pragma once
#include <string>
#include <vector>

/// Tools run inside this process, in a folder of their own, and held to what docs/exit-codes.md promises.
namespace fuzz {

struct ToolResult {
  int status = 0;
  std::string output, messages;  ///< stdout, stderr
  [[nodiscard]] bool done() const { return status == 0; }
};

/// Ends the process with a message that names `what` and `why`, on the stderr of the process.
[[noreturn]] void fail_fuzz(const std::string& what, const std::string& why);

/// Makes fail_fuzz() write to the present stderr from now on, even if stderr is redirected later.
void keep_stderr();

/// A folder for inputs and outputs; it goes with this.
class Workplace {
 public:
  Workplace();
  ~Workplace();
  Workplace(const Workplace&) = delete;
  Workplace& operator=(const Workplace&) = delete;

  /// Path of a file of this name.
  [[nodiscard]] std::string path(const std::string& name) const { return folder_ + "/" + name; }
  void write(const std::string& name, const std::string& bytes);
  [[nodiscard]] bool has(const std::string& name) const;

  /// Removes files called "out", "out.*" or "no".
  void remove_outputs();

  /// Runs a tool with these arguments, and one thread and scratch in the folder where it takes such options. Fails
  /// unless the status is one of docs/exit-codes.md, a failure has its line, and nothing is left behind: a failed run
  /// leaves the folder as it was; one that ends with 0 has added `outputs` at most. 1 is for bpcheck only,
  /// and for a place where nothing can be written. With BP_FUZZ_TRACE in the environment, the command line is shown.
  ToolResult run(const std::string& tool, std::vector<std::string> arguments,
                 const std::vector<std::string>& outputs = {});

 private:
  [[nodiscard]] std::vector<std::string> names() const;
  std::string folder_;
};

}  // namespace fuzz
