#pragma once
#include <string>

namespace bp {

/// Returns the path of a file that another file names, as a material library names its images. `folder`: the folder of
/// the file that names it. The name may stand in quotes, have backslashes, be a path of another machine, or differ in
/// the case of ASCII letters. The first of these that is a regular file is taken:
///   1. the name as it is written;
///   2. without quotes, and with slashes;
///   3. its last part, in `folder`;
///   4. the second, then the third, with letters of any case; of several such files, the first by name.
/// If there is none: the second; the third for a path with a drive. Cost: a few system calls; folders are listed only
/// if the first three fail.
[[nodiscard]] std::string find_beside(const std::string& folder, const std::string& name);

}  // namespace bp
