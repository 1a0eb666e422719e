#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "io/files/file.h"
#include "tools/cli/args.h"
#include "tools/cli/progress.h"

/// The options that every tool shares, with one meaning everywhere (docs/pipeline.md).
namespace bp {

struct DeviceChoice {
  enum class Kind { automatic, cpu, cuda };
  Kind kind = Kind::automatic;
  std::vector<int> ids;  ///< the devices of --device cuda:0,1, each once; empty: all
  friend bool operator==(const DeviceChoice&, const DeviceChoice&) = default;
};
/// Parses `auto`, `cpu`, `cuda` or `cuda:0,1`. Throws bad_argument.
[[nodiscard]] DeviceChoice parse_device(const std::string& text);

/// A --memory that is less than every run takes: refused, or taken as the least until an output is written. The second
/// is for the only run of a process: a step that needs more names its own number first.
enum class SmallMemory { refused, waits };

struct CommonOptions {
  /// Groups of options. A tool leaves out the groups that it does not use.
  enum Part : unsigned {
    threads_part = 1,
    memory_part = 2,
    device_part = 4,
    progress_part = 8,
    report_part = 16,
    overwrite_part = 32,
    all_parts = 63
  };

  int threads = 0;                 ///< 0: all cores
  std::uint64_t memory_bytes = 0;  ///< peak resident memory to keep below; prepare() replaces 0 by the default
  std::string temp;                ///< directory for scratch; prepare() replaces "" by $TMPDIR or /tmp
  DeviceChoice device;
  ProgressMode progress = ProgressMode::automatic;
  std::string report;                       ///< name of the report's file; empty: none
  std::shared_ptr<OutputFile> report_file;  ///< opened by prepare()
  bool overwrite = false;

  void add_to(Args& args, unsigned parts = all_parts);
  /// Fills in the defaults that depend on the machine, and fails early: throws bad_argument if the scratch directory
  /// cannot be written, or if the report's file exists and is no report; throws as OutputFile if that file cannot be
  /// written; out_of_resource for a --memory below least_memory(). If that waits, it is replaced by the least, and the
  /// outputs of this process are refused (io/files/file.h). run_tool calls it before the tool runs.
  void prepare(SmallMemory small = SmallMemory::refused);

 private:
  void refuse_memory(std::uint64_t least, SmallMemory small);
  unsigned parts_ = all_parts;
};

/// Returns whether a file is an earlier report, or empty. A report is a log: the next report replaces it. Nothing else
/// is replaced without being asked for.
[[nodiscard]] bool is_report(const std::string& path);

/// Returns a quarter of the memory of this machine (or of this container), so that the tools of one pipe fit together.
[[nodiscard]] std::uint64_t default_memory();
/// Returns the memory, bytes, that the program and this number of threads (0: all cores) take of --memory: no tool can
/// keep a smaller limit.
[[nodiscard]] std::uint64_t least_memory(int threads);

/// From now on these files, and the files that they name (parts_of_scene()), are neither replaced nor removed while a
/// KeepsInputs lives (io/files/kept_files.h), even with --overwrite. Throws bad_argument if one of them is an output
/// that was opened before.
void keep_inputs(const std::vector<std::string>& paths);
/// Forgets what open_output() was told, for another run of a tool in this process, as in tests.
void forget_outputs();
/// Opens the tool's data output. Throws bad_argument if binary data would go to a terminal, if the file exists and
/// `overwrite` is false, if it is an input that is kept, or if this name was opened before.
[[nodiscard]] std::unique_ptr<OutputFile> open_output(const std::string& path, bool overwrite, bool binary = true,
                                                      NamedBy named_by = NamedBy::user);
/// The check of open_output() for a terminal, for a writer that opens the file itself.
void refuse_terminal(const std::string& path);

}  // namespace bp
