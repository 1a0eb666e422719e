#include "tests/fuzz/tool_runs.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>

#include "tests/fuzz/tool_mains.h"

namespace fuzz {

namespace {

namespace fs = std::filesystem;

using Main = int (*)(int, char**);

Main main_of(const std::string& tool) {
  static const std::map<std::string, Main> kMains{
      {"bpvox", bpvox_main},     {"bpscale", bpscale_main}, {"bpclose", bpclose_main}, {"bpmesh", bpmesh_main},
      {"bpcheck", bpcheck_main}, {"bplod", bplod_main},     {"bpinfo", bpinfo_main},   {"bpdeform", bpdeform_main}};
  return kMains.at(tool);
}

/// stderr as it was before any run: sanitizers report to the people who run the fuzzer.
int stderr_of_process() {
  static const int fd = ::fcntl(2, F_DUPFD_CLOEXEC, 100);
  return fd;
}

void say(const std::string& text) {
  (void)!::write(stderr_of_process(), text.data(), text.size());
}

/// While it lives, stdout and stderr go to files in memory, and stdin is empty.
class Streams {
 public:
  Streams() {
    keep_stderr();
    for (int fd = 0; fd < 3; ++fd) {
      kept_[fd] = ::fcntl(fd, F_DUPFD_CLOEXEC, 100);
      const int file = fd == 0 ? ::open("/dev/null", O_RDONLY | O_CLOEXEC) : ::memfd_create("fuzz", MFD_CLOEXEC);
      if (file < 0 || ::dup2(file, fd) != fd) fail_fuzz("streams", "no file for them");
      ::close(file);
    }
  }
  ~Streams() {
    std::fflush(stdout);
    for (int fd = 0; fd < 3; ++fd) {
      if (kept_[fd] < 0) continue;
      ::dup2(kept_[fd], fd);
      ::close(kept_[fd]);
    }
  }
  Streams(const Streams&) = delete;
  Streams& operator=(const Streams&) = delete;

  static std::string text(int fd) {
    std::fflush(stdout);
    struct stat info {};
    if (::fstat(fd, &info) != 0) return "";
    std::string text(std::size_t(info.st_size), '\0');
    return ::pread(fd, text.data(), text.size(), 0) == ssize_t(text.size()) ? text : "";
  }

 private:
  int kept_[3];
};

std::string command_line(const std::string& tool, const std::vector<std::string>& arguments) {
  std::string text = tool;
  for (const std::string& a : arguments) text += " '" + a + "'";
  return text;
}

bool begins_with_name(const std::string& line, const std::string& tool) {
  return line.rfind(tool + ": ", 0) == 0;
}

/// Returns the fault of a failed run's messages: they must be one line that begins with the tool's name, and no
/// "unexpected" error.
const char* fault_of(const ToolResult& result, const std::string& tool) {
  const int status = result.status;
  const auto says = [&](const char* text) { return result.messages.find(text) != std::string::npos; };
  const std::string unforeseen = tool + ": unexpected";  // at the beginning of a line: an input may hold these words
  if (result.messages.starts_with(unforeseen) || says(("\n" + unforeseen).c_str()))
    return "fails in a way that nobody foresaw";
  if ((status == 1 || status == 5) && tool == "bpcheck") return nullptr;  // no, not decided
  if (status == 1 && says("cannot write")) return nullptr;
  if (status != 0 && (status < 2 || status > 4)) return "ends with a status that it should not";
  if (status == 0) return nullptr;
  const std::size_t end = result.messages.find_last_of('\n', result.messages.size() - 2);
  const std::string last = result.messages.substr(end == std::string::npos ? 0 : end + 1);
  return begins_with_name(last, tool) ? nullptr : "fails without a line that says why";
}

bool takes_scratch(const std::string& tool) {
  return tool != "bpinfo" && tool != "bpscale";
}

}  // namespace

void fail_fuzz(const std::string& what, const std::string& why) {
  say("fuzz: " + what + ": " + why + "\n");
  std::abort();
}

void keep_stderr() {
  (void)stderr_of_process();
}

Workplace::Workplace() {
  keep_stderr();
  const char* const parent = std::getenv("TMPDIR");
  folder_ = std::string(parent != nullptr                 ? parent
                        : ::access("/dev/shm", W_OK) == 0 ? "/dev/shm"
                                                          : "/tmp") +
            "/bp-fuzz-XXXXXX";
  if (::mkdtemp(folder_.data()) == nullptr) fail_fuzz(folder_, "cannot be made");
}

Workplace::~Workplace() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

void Workplace::write(const std::string& name, const std::string& bytes) {
  std::ofstream out(path(name), std::ios::binary);
  out.write(bytes.data(), std::streamsize(bytes.size()));
  out.close();
  if (!out) fail_fuzz(name, "cannot be written");
}

bool Workplace::has(const std::string& name) const {
  return fs::exists(path(name));
}

void Workplace::remove_outputs() {
  std::vector<fs::path> outputs;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_)) {
    const std::string name = entry.path().filename().string();
    if (name == "out" || name == "no" || name.rfind("out.", 0) == 0) outputs.push_back(entry.path());
  }
  for (const fs::path& path : outputs) fs::remove_all(path);
}

std::vector<std::string> Workplace::names() const {
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder_))
    names.push_back(entry.path().string().substr(folder_.size() + 1));
  std::sort(names.begin(), names.end());
  return names;
}

ToolResult Workplace::run(const std::string& tool, std::vector<std::string> arguments,
                          const std::vector<std::string>& outputs) {
  arguments.insert(arguments.begin(), {"-j", "1"});
  if (takes_scratch(tool)) arguments.insert(arguments.begin(), {"--temp", folder_});
  std::vector<std::string> words = arguments;
  words.insert(words.begin(), tool);
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);

  if (std::getenv("BP_FUZZ_TRACE") != nullptr) say(command_line(tool, arguments) + "\n");
  const std::vector<std::string> before = names();
  ToolResult result;
  {
    const Streams streams;
    result.status = main_of(tool)(int(words.size()), argv.data());
    result.output = Streams::text(1);
    result.messages = Streams::text(2);
  }
  if (const char* const fault = fault_of(result, tool))
    fail_fuzz(command_line(tool, arguments),
              std::string(fault) + ": " + std::to_string(result.status) + " " + result.messages);
  for (const std::string& name : names()) {
    const std::string top = name.substr(0, name.find('/'));
    const bool expected = std::find(before.begin(), before.end(), name) != before.end() ||
                          (result.status < 2 && std::find(outputs.begin(), outputs.end(), top) != outputs.end() &&
                           name.find(".partial") == std::string::npos);
    if (!expected)
      fail_fuzz(command_line(tool, arguments),
                "leaves " + name + " behind; " + std::to_string(result.status) + " " + result.messages);
  }
  return result;
}

}  // namespace fuzz
