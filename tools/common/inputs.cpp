#include "tools/common/inputs.h"

#include <algorithm>

#include "io/scene_format.h"
#include "lib/core/error.h"

namespace bp {

void check_scene_format(const std::string& format, const std::vector<std::string>& inputs) {
  if (format.empty()) return;
  const std::string named = scene_format_named(format);
  const auto needs_it = [&](const std::string& input) {
    const std::string told = scene_format_of(input);
    return told.empty() || told == named;
  };
  if (inputs.empty() || std::any_of(inputs.begin(), inputs.end(), needs_it)) return;
  fail(ErrorCode::bad_argument,
       "--format {}: is for stdin and for names that do not tell, and {} tells its format; leave it out, or rename the "
       "file",
       format, inputs.front());
}

void check_stdin_once(const std::vector<std::string>& inputs) {
  if (std::count(inputs.begin(), inputs.end(), "-") > 1)
    fail(ErrorCode::bad_argument, "stdin (-) is named twice; give all but one of these inputs as files");
}

void check_panel_size(int pixels) {
  constexpr int kLeast = 16, kMost = 16384;  // of render()
  if (pixels < kLeast || pixels > kMost)
    fail(ErrorCode::bad_argument, "--image-size {}: must be {} to {} pixels", pixels, kLeast, kMost);
}

}  // namespace bp
