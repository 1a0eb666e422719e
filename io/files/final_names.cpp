#include "io/files/final_names.h"

#include <fcntl.h>
#include <stdio.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "io/files/kept_files.h"
#include "lib/core/error.h"

namespace bp {

namespace {

bool is_unsupported(int error) {
  return error == EINVAL || error == ENOSYS || error == EPERM || error == EOPNOTSUPP || error == EMLINK;
}

int place_new(const char* from, const char* name) {
  int error = detail::place_by_rename(from, name);
  if (is_unsupported(error)) error = detail::place_by_link(from, name);
  if (is_unsupported(error)) error = detail::place_by_claim(from, name);
  return error;
}

int place(const char* from, const char* name, bool overwrite, PartialOutput* partial) {
  const WhileMaking making;  // another process may begin to write under the old name at once
  if (overwrite && ::rename(from, name) != 0) return errno;
  if (const int error = overwrite ? 0 : place_new(from, name)) return error;
  if (partial != nullptr) *partial = PartialOutput();
  return 0;
}

}  // namespace

void place_file(const std::string& from, const std::string& name, bool overwrite, PartialOutput* partial) {
  refuse_kept(name);
  const int error = place(from.c_str(), name.c_str(), overwrite, partial);
  if (error == 0) return;
  if (error == EEXIST && !overwrite)
    fail(ErrorCode::bad_argument, {Remedy::other_output, Remedy::overwrite},
         "{}: appeared during the work, and is not replaced", name);
  const bool full = error == ENOSPC || error == EDQUOT;
  fail(full ? ErrorCode::out_of_resource : ErrorCode::failed, "{}: cannot write: {}", name, std::strerror(error));
}

int remove_file(const std::string& path) {
  if (is_kept(path)) return EBUSY;
  return ::unlink(path.c_str()) == 0 || errno == ENOENT ? 0 : errno;
}

namespace detail {

int place_by_rename(const char* from, const char* name) noexcept {
  return ::renameat2(AT_FDCWD, from, AT_FDCWD, name, RENAME_NOREPLACE) == 0 ? 0 : errno;
}

int place_by_link(const char* from, const char* name) noexcept {
  if (::link(from, name) != 0) return errno;
  ::unlink(from);
  return 0;
}

int place_by_claim(const char* from, const char* name) noexcept {
  const int fd = ::open(name, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (fd < 0) return errno;
  ::close(fd);
  if (::rename(from, name) == 0) return 0;
  const int error = errno;
  ::unlink(name);
  return error;
}

}  // namespace detail

}  // namespace bp
