#include "tools/cli/input_list.h"

#include "io/files/kept_files.h"
#include "lib/core/error.h"
#include "tools/cli/common_options.h"

namespace bp {

InputList::InputList(const std::string& path, bool overwrite) {
  if (!path.empty()) file_ = open_output(path, overwrite, false);
}

InputList::~InputList() = default;

void InputList::write() {
  if (!file_) return;
  for (const std::string& path : read_paths()) {
    if (path.find('\n') != std::string::npos)
      fail(ErrorCode::failed, "--inputs: the name of a file that was read holds a line break; rename {:?}", path);
    file_->write(path + "\n");
  }
  file_->commit();
}

}  // namespace bp
