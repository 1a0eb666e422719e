#pragma once
#include <string>

#include "io/files/partial_outputs.h"

namespace bp {

/// Of an output whose folder is not there: throws bad_argument.
[[noreturn]] void fail_for_folder(const std::string& path);

/// Makes a folder if it is not there; the folder above it must be there. Throws `failed`, or bad_argument if there is
/// none above it. Of several threads.
void make_folder(const std::string& path);

/// A folder, made as by make_folder(). One that was made goes again with this object, and when a signal ends the
/// process, unless it is kept or something lies in it.
class MadeFolder {
 public:
  explicit MadeFolder(const std::string& path);
  ~MadeFolder();
  MadeFolder(const MadeFolder&) = delete;
  MadeFolder& operator=(const MadeFolder&) = delete;
  void keep();  ///< it stays, also after a crash of the machine

 private:
  std::string path_;
  PartialOutput entry_;
  bool made_ = false;
};

}  // namespace bp
