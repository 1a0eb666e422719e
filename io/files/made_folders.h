#pragma once
#include <string>

#include "io/files/partial_outputs.h"

namespace bp {

/// Throws bad_argument for an output whose folder does not exist.
[[noreturn]] void fail_for_folder(const std::string& path);

/// Makes a folder if it does not exist; the folder above must exist. Throws `failed`, or bad_argument if there is none
/// above. Several threads may make the same folder.
void make_folder(const std::string& path);

/// A folder, made as by make_folder(). If this object made it, the folder is removed when the object goes or a signal
/// ends the process, unless it is kept or not empty.
class MadeFolder {
 public:
  explicit MadeFolder(const std::string& path);
  ~MadeFolder();
  MadeFolder(const MadeFolder&) = delete;
  MadeFolder& operator=(const MadeFolder&) = delete;
  void keep();  ///< the folder stays, even after a crash of the machine

 private:
  std::string path_;
  PartialOutput entry_;
  bool made_ = false;
};

}  // namespace bp
