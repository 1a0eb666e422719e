#pragma once
#include <memory>
#include <string>

namespace bp {

class OutputFile;

/// The file of --inputs: the paths of read_paths() (io/files/kept_files.h), one a line. A build system that keeps this
/// list knows when the outputs have to be made again.
class InputList {
 public:
  /// Opens the file; there is none if `path` is empty. Throws as open_output().
  InputList(const std::string& path, bool overwrite);
  ~InputList();
  /// Writes what was read up to now. Throws failed if a path holds a line break.
  void write();

 private:
  std::unique_ptr<OutputFile> file_;
};

}  // namespace bp
