// SPDX-License-Identifier: Apache-2.0
#include "deploy/runtime/files/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <map>
#include <mutex>

#include "deploy/runtime/files/file_error.h"

namespace ehm::files {

namespace {

/// The name of the target whose temporary file `name` is, where the process that made it is no more; else empty.
std::string abandoned_target(const std::string& name) {
  constexpr std::string_view mark = ".tmp";
  const std::size_t at = name.rfind(mark);
  if (at == std::string::npos) return {};
  pid_t maker = 0;
  const char* const end = name.data() + name.size();
  const auto [stop, error] = std::from_chars(name.data() + at + mark.size(), end, maker);
  const bool is_ours = error == std::errc() && stop == end && maker > 0;
  return is_ours && ::kill(maker, 0) != 0 && errno == ESRCH ? name.substr(0, at) : std::string();
}

/// Removes what killed processes have left of this target: kill -9 within a write leaves its file. Each folder is looked
/// through once.
void remove_leftovers(const std::filesystem::path& target) {
  static std::mutex mutex;
  static std::map<std::filesystem::path, std::multimap<std::string, std::filesystem::path>> folders;
  const std::lock_guard lock(mutex);
  const auto folder = target.has_parent_path() ? target.parent_path() : std::filesystem::path(".");
  const auto [known, is_new] = folders.try_emplace(folder);
  std::error_code error;
  if (is_new)
    for (const auto& entry : std::filesystem::directory_iterator(folder, error))
      if (std::string name = abandoned_target(entry.path().filename().string()); !name.empty())
        known->second.emplace(std::move(name), entry.path());
  const auto [first, last] = known->second.equal_range(target.filename().string());
  for (auto it = first; it != last; ++it) std::filesystem::remove(it->second, error);
  known->second.erase(first, last);
}

}  // namespace

AtomicFile::AtomicFile(const std::string& path) : path_(path), target_(path) {
  std::error_code unknown;
  const auto status = std::filesystem::status(path, unknown);
  const bool replaceable = !std::filesystem::exists(status) || std::filesystem::is_regular_file(status);
  if (std::filesystem::is_regular_file(status)) target_ = std::filesystem::canonical(path, unknown).string();
  if (target_.empty()) target_ = path;
  if (replaceable) remove_leftovers(target_);
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
