#pragma once
#include <string>

#include "io/files/partial_outputs.h"

/// The only functions that give and take away names that others see. A file that this process reads stays
/// (io/files/kept_files.h), and so does a file that another process placed there meanwhile.
namespace bp {

/// Gives the finished file `from` the name `name`, in the same file system, in one step. Throws bad_argument if `name`
/// is kept, or if it exists and `overwrite` is false, even if it appeared just now; otherwise an Error for the system's
/// reason.
///   partial  the entry of `from`, which ends with that name
void place_file(const std::string& from, const std::string& name, bool overwrite, PartialOutput* partial = nullptr);

/// Removes a file of an earlier run. Returns 0 if there is none now, else errno; EBUSY for a file that is kept.
int remove_file(const std::string& path);

namespace detail {

/// The three functions below name a file if the name does not exist, best first. They return 0 or errno: EEXIST if the
/// name exists.
int place_by_rename(const char* from, const char* name) noexcept;
/// For file systems without renameat2(): makes a second name, then removes the first.
int place_by_link(const char* from, const char* name) noexcept;
/// For file systems without links as well: an empty file takes the name, and is replaced.
int place_by_claim(const char* from, const char* name) noexcept;

}  // namespace detail

}  // namespace bp
