#include "monitor/design/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "monitor/design/file_error.h"

namespace ehm::design {
namespace {

bool write_all(int descriptor, const std::string& content) {
  std::size_t done = 0;
  while (done < content.size()) {
    const ssize_t written = ::write(descriptor, content.data() + done, content.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    done += static_cast<std::size_t>(written);
  }
  return true;
}

}  // namespace

void write_file_atomically(const std::string& path, const std::string& content) {
  const std::string temporary = path + ".tmp" + std::to_string(::getpid());
  const auto fail = [&](int reason) {
    ::unlink(temporary.c_str());
    throw FileError(path + ": cannot be written: " + std::strerror(reason) + ". Check the folder and its permissions.");
  };
  const int descriptor = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (descriptor < 0) fail(errno);
  if (!write_all(descriptor, content) || ::fsync(descriptor) != 0) {
    const int reason = errno;
    ::close(descriptor);
    fail(reason);
  }
  if (::close(descriptor) != 0) fail(errno);
  if (std::rename(temporary.c_str(), path.c_str()) != 0) fail(errno);
}

}  // namespace ehm::design
