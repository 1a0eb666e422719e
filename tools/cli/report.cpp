#include "tools/cli/report.h"

#include <sys/resource.h>
#include <sys/stat.h>

#include <cmath>
#include <cstdio>
#include <cstring>

#include "lib/core/error.h"
#include "lib/store/source_digest.h"

namespace bp {

namespace {

double seconds_since(std::chrono::steady_clock::time_point begin) {
  const double s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return std::round(s * 1e6) / 1e6;  // microseconds suffice for readers
}

Json versions() {
  return {{"bounding_proxies", BP_VERSION}, {"sources", source_digest()}, {"compiler", __VERSION__}};
}

}  // namespace

Report::Report(std::string tool) : tool_(std::move(tool)) {}

void Report::close_pass() {
  if (pass_.empty()) return;
  seconds_[pass_] = seconds_.value(pass_, 0.0) + seconds_since(pass_begin_);
  pass_.clear();
}

void Report::note(const std::string& text, const CommonOptions& common) {
  notes.push_back(text);
  if (common.progress != ProgressMode::quiet) std::fprintf(stderr, "%s: note: %s\n", tool_.c_str(), text.c_str());
}

void Report::begin(const std::string& name) {
  close_pass();
  pass_ = name;
  pass_begin_ = Clock::now();
}

std::string Report::text() {
  close_pass();
  Json json;
  json["tool"] = tool_;
  json["version"] = BP_VERSION;
  json["versions"] = versions();
  json["options"] = options;
  json["counts"] = counts;
  json["notes"] = notes;
  json["bytes_in"] = bytes_in;
  json["bytes_out"] = bytes_out;
  json["seconds"] = seconds_;
  json["seconds"]["total"] = seconds_since(begin_);
  json["peak_memory_bytes"] = peak_memory();
  // Replaces invalid UTF-8, since names of files need not be UTF-8.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void Report::write(const CommonOptions& common) {
  if (!common.report_file) return;
  try {
    common.report_file->write(text());
    // The report of another tool of the pipe, written just now.
    if (is_report(common.report)) common.report_file->allow_overwrite();
    common.report_file->commit();
  } catch (const Error& e) {
    fail_as(e, "the report is lost, but what was made is complete: {}", e.what());
  }
}

std::uint64_t size_of_files(const std::vector<std::string>& paths) {
  std::uint64_t bytes = 0;
  for (const std::string& path : paths) {
    struct stat info {};
    if (path != "-" && ::stat(path.c_str(), &info) == 0) bytes += std::uint64_t(info.st_size);
  }
  return bytes;
}

std::uint64_t peak_memory() {
  // VmHWM starts anew with exec, whereas ru_maxrss is inherited from the process that started this one.
  std::uint64_t kib = 0;
  if (std::FILE* status = std::fopen("/proc/self/status", "r")) {
    char line[256];
    while (std::fgets(line, sizeof line, status) != nullptr) {
      if (std::strncmp(line, "VmHWM:", 6) == 0) kib = std::strtoull(line + 6, nullptr, 10);
    }
    std::fclose(status);
  }
  if (kib > 0) return kib * 1024;
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return std::uint64_t(usage.ru_maxrss) * 1024;
}

}  // namespace bp
