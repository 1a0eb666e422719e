#pragma once
#include <string>

#include "io/files/partial_outputs.h"

/// Names that others see are given and taken away here, and nowhere else: what this process reads stays
/// (io/files/kept_files.h), and what somebody else put there meanwhile stays, too.
namespace bp {

/// Gives the finished file `from` the name `name`, in the same file system, in one step. Throws bad_argument if `name`
/// is kept, or if it is there and `overwrite` is false, also if it appeared just now; else as the system fails.
///   partial  the entry of `from`, which ends with that name
void place_file(const std::string& from, const std::string& name, bool overwrite, PartialOutput* partial = nullptr);

/// Removes a file of an earlier run. 0: there is none now; else errno, EBUSY of a file that is kept.
int remove_file(const std::string& path);

namespace detail {

/// Ways to name a file that must not be there yet, best first; 0 or errno: EEXIST if it is there.
int place_by_rename(const char* from, const char* name) noexcept;
/// Where the file system has no renameat2(): a second name, and then the first one goes.
int place_by_link(const char* from, const char* name) noexcept;
/// Where it has no links, either: an empty file takes the name, and is replaced.
int place_by_claim(const char* from, const char* name) noexcept;

}  // namespace detail

}  // namespace bp
