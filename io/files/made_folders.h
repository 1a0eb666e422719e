#pragma once
#include <string>
#include <utility>
#include <vector>

#include "io/files/partial_outputs.h"

namespace bp {

/// Makes a folder if it is not there. Throws `failed`. Of several threads.
void make_folder(const std::string& path);

/// A folder and those above it, made where they are not there. The ones that were made go again with this object, and
/// when a signal ends the process, unless they are kept or something lies in them.
class MadeFolders {
 public:
  explicit MadeFolders(const std::string& path);  ///< throws `failed` if one cannot be made
  ~MadeFolders();
  MadeFolders(const MadeFolders&) = delete;
  MadeFolders& operator=(const MadeFolders&) = delete;
  void keep();  ///< they stay, also after a crash of the machine

 private:
  void remove();
  std::vector<std::pair<std::string, PartialOutput>> made_;  ///< from above
};

}  // namespace bp
