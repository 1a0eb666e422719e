#include "tools/cli/common_options.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <span>
#include <string_view>
#include <utility>

#include "io/files/kept_files.h"
#include "io/scene/file_ending.h"
#include "io/scene/scene_parts.h"
#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "tools/cli/names.h"

namespace bp {

namespace {

constexpr int kMostThreads = 4096;  ///< each thread has a backend of its own

std::string default_temp() {
  const char* dir = std::getenv("TMPDIR");
  return dir != nullptr && *dir != '\0' ? dir : "/tmp";
}

void check_temp(const std::string& dir) {
  struct stat info {};
  if (::stat(dir.c_str(), &info) != 0 || !S_ISDIR(info.st_mode))
    fail(ErrorCode::bad_argument, "{}: no such directory for scratch files; name one with --temp", dir);
  if (::access(dir.c_str(), W_OK | X_OK) != 0)
    fail(ErrorCode::bad_argument, "{}: scratch files cannot be written there; name another directory with --temp", dir);
}

/// Returns the number on the first line of a kernel's file; 0 if there is none ("max").
std::uint64_t kernel_number(const char* path) {
  unsigned long long value = 0;
  if (std::FILE* file = std::fopen(path, "r")) {
    if (std::fscanf(file, "%llu", &value) != 1) value = 0;
    std::fclose(file);
  }
  return value;
}

/// The outputs that this process has opened, each by its whole path.
std::set<std::string>& named_outputs() {
  static std::set<std::string> names;
  return names;
}

/// Refuses an input that is known late, such as the scene that a stream names, if it is an open output by then.
void refuse_open_output(const std::string& input) {
  if (named_outputs().empty()) return;
  std::vector<std::string> files = parts_of_scene(input);
  files.push_back(input);
  for (const std::string& file : files) {
    if (named_outputs().count(whole_path(file)) > 0)
      fail(ErrorCode::bad_argument, "{}: is read as the scene, and would be lost; give the output another name", file);
  }
}

/// Returns the whole path of an output that is about to be opened; empty if the output is written in place, as
/// /dev/null, which may be named twice.
std::string free_name(const std::string& path) {
  struct stat info {};
  if (path != "-" && ::stat(path.c_str(), &info) == 0 && !S_ISREG(info.st_mode)) return "";
  if (path != "-") refuse_kept(path);
  std::string whole = path == "-" ? path : whole_path(path);
  if (named_outputs().count(whole) > 0)
    fail(ErrorCode::bad_argument, "{}: is named for two outputs; give each a name of its own",
         path == "-" ? "stdout" : path);
  return whole;
}

/// Refuses the name of a report, which is JSON, if its ending is that of a scene or of voxels.
void check_report_name(const std::string& path) {
  const FileEnding ending = file_ending_of(path);
  if (ending.is(FileKind::unknown) || ending.is(FileKind::document)) return;
  fail(ErrorCode::bad_argument, "--report {}: a report is JSON, not a file of format {}; name it {}", path, ending.text,
       with_ending(path, "json"));
}

}  // namespace

DeviceChoice parse_device(const std::string& text) {
  DeviceChoice choice;
  if (text == "auto") return choice;
  if (text == "cpu") return {DeviceChoice::Kind::cpu, {}};
  choice.kind = DeviceChoice::Kind::cuda;
  if (text == "cuda") return choice;
  if (text.rfind("cuda:", 0) != 0) fail(ErrorCode::bad_argument, "'{}' is none of auto, cpu, cuda, cuda:0,1", text);
  for_each_item(std::string_view(text).substr(5), [&](std::string_view item) {
    const int id = int(parse_integer(item, 0, 1023));
    if (std::find(choice.ids.begin(), choice.ids.end(), id) != choice.ids.end())
      fail(ErrorCode::bad_argument, "'{}' names GPU {} twice", text, id);
    choice.ids.push_back(id);
  });
  return choice;
}

void CommonOptions::add_to(Args& args, unsigned parts) {
  parts_ = parts;
  if (parts & overwrite_part) {
    args.group("Files");
    args.flag("--overwrite", overwrite, "replace output files that exist");
  }
  args.group("Resources");
  if (parts & threads_part) {
    args.option(
        "-j,--threads", "N", [this](const std::string& t) { threads = int(parse_integer(t, 0, kMostThreads)); },
        "number of threads; 0: one for each core (default: 0)");
  }
  if (parts & memory_part) {
    args.option(
        "--memory", "SIZE", [this](const std::string& t) { memory_bytes = parse_size(t); },
        "most memory to use, as 4G; the rest goes to --temp (default: a quarter of the machine's)");
    args.option("--temp", "DIR", temp, "folder for scratch files (default: $TMPDIR, else /tmp)");
  }
  if (parts & device_part) {
    args.option(
        "--device", "DEVICE", [this](const std::string& t) { device = parse_device(t); },
        "auto, cpu, cuda (every GPU) or cuda:0,1 (default: auto, one GPU where the work is worth its start, or the "
        "CPU)");
    args.words({{"auto", ""}, {"cpu", ""}, {"cuda", ""}});
  }
  args.group("Messages");
  if (parts & progress_part) {
    args.flag_with_word(
        "--progress", {"json"},
        [this](const std::string& word) { progress = word.empty() ? ProgressMode::bar : ProgressMode::json; },
        "show progress on stderr, even if that is no terminal; json: as lines of JSON");
    args.flag(
        "-q,--quiet", [this] { progress = ProgressMode::quiet; },
        "show neither progress nor notes; the report has the notes");
  }
  if (parts & report_part)
    args.option("--report", "FILE", report,
                "write options, counts, notes, times and peak memory as JSON; an earlier report is replaced");
}

void CommonOptions::prepare(SmallMemory small) {
  const std::uint64_t least = least_memory(threads);
  if (memory_bytes == 0) memory_bytes = std::max(default_memory(), least);
  if (memory_bytes < least) refuse_memory(least, small);
  if (parts_ & memory_part) {
    if (temp.empty()) temp = default_temp();
    check_temp(temp);
  }
  check_report_name(report);
  if (!report.empty()) report_file = open_output(report, overwrite || is_report(report), false);
}

/// Refuses a --memory that is less than every run takes. A number without its unit is never a wish, so it does not
/// wait.
void CommonOptions::refuse_memory(std::uint64_t least, SmallMemory small) {
  constexpr std::uint64_t kNoUnit = 1024;
  const std::uint64_t asked = std::exchange(memory_bytes, least);
  if (asked < kNoUnit)
    fail(ErrorCode::out_of_resource, "--memory {}: at least {}M is needed with these --threads; did you mean {}G?",
         size_text(asked), least >> 20, asked);
  const auto why = std::make_shared<const Error>(
      ErrorCode::out_of_resource, fmt::format("--memory {} is too little with these --threads", size_text(asked)),
      Remedies{Remedy::more_memory}, least);
  if (small == SmallMemory::refused) throw Error(*why);
  refuse_outputs(why);
}

bool is_report(const std::string& path) {
  std::error_code none;
  if (!std::filesystem::is_regular_file(path, none)) return false;
  constexpr std::string_view kBegin = "{\n  \"tool\": \"bp";  // as Report::text() begins
  char head[kBegin.size()] = {};
  const InputFile file(path);
  const std::size_t got = file.read_at(0, std::as_writable_bytes(std::span(head)));
  return got == 0 || std::string_view(head, got) == kBegin;
}

std::uint64_t default_memory() {
  std::uint64_t bytes = std::uint64_t(::sysconf(_SC_PHYS_PAGES)) * std::uint64_t(::sysconf(_SC_PAGESIZE));
  const std::uint64_t limit = kernel_number("/sys/fs/cgroup/memory.max");
  if (limit > 0) bytes = std::min(bytes, limit);
  return bytes / 4;
}

std::uint64_t least_memory(int threads) {
  return (std::uint64_t(48) << 20) + (std::uint64_t(16) << 20) * std::uint64_t(threads > 0 ? threads : thread_count());
}

void refuse_terminal(const std::string& path) {
  if (path == "-" && ::isatty(1) != 0)
    fail(ErrorCode::bad_argument, "binary data does not go to a terminal; name a file with -o, or pipe it on");
}

void keep_inputs(const std::vector<std::string>& paths) {
  for (const std::string& path : paths) {
    if (path != "-") refuse_open_output(path);
    keep_scene(path);
  }
}

void forget_outputs() {
  named_outputs().clear();
  refuse_outputs(nullptr);
}

std::unique_ptr<OutputFile> open_output(const std::string& path, bool overwrite, bool binary, NamedBy named_by) {
  if (binary) refuse_terminal(path);
  const std::string name = free_name(path);
  auto file = std::make_unique<OutputFile>(path, overwrite, named_by);
  if (!name.empty()) named_outputs().insert(name);
  return file;
}

}  // namespace bp
