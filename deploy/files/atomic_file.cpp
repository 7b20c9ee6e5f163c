#include "deploy/files/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "deploy/files/file_error.h"

namespace ehm::files {

AtomicFile::AtomicFile(const std::string& path) : path_(path), target_(path) {
  std::error_code unknown;
  const auto status = std::filesystem::status(path, unknown);
  const bool replaceable = !std::filesystem::exists(status) || std::filesystem::is_regular_file(status);
  if (std::filesystem::is_regular_file(status)) target_ = std::filesystem::canonical(path, unknown).string();
  if (target_.empty()) target_ = path;
  if (replaceable) temporary_ = target_ + ".tmp" + std::to_string(::getpid());
  descriptor_ = replaceable ? ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644)
                            : ::open(target_.c_str(), O_WRONLY | O_CLOEXEC);
  if (descriptor_ < 0) fail(errno);
}

AtomicFile::~AtomicFile() {
  if (descriptor_ < 0) return;
  ::close(descriptor_);
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void AtomicFile::fail(int reason) const {
  throw FileError(path_ + ": cannot be written: " + std::strerror(reason) + ". Check the folder and its permissions.");
}

void AtomicFile::write(std::string_view content) {
  while (!content.empty()) {
    const ssize_t written = ::write(descriptor_, content.data(), content.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) fail(errno);
    content.remove_prefix(static_cast<std::size_t>(written));
  }
}

void AtomicFile::commit() {
  if (!temporary_.empty()) {
    if (::fsync(descriptor_) != 0 || std::rename(temporary_.c_str(), target_.c_str()) != 0) fail(errno);
    temporary_.clear();
  }
  const int finished = descriptor_;
  descriptor_ = -1;
  if (::close(finished) != 0) fail(errno);
}

void write_file_atomically(const std::string& path, std::string_view content) {
  AtomicFile file(path);
  file.write(content);
  file.commit();
}

}  // namespace ehm::files
