// SPDX-License-Identifier: Apache-2.0
#include "deploy/runtime/files/input_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <functional>
#include <future>
#include <memory>
#include <thread>

#include "deploy/runtime/files/file_error.h"

namespace ehm::files {

namespace {

class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() {
    if (number_ >= 0) close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int number() const { return number_; }

 private:
  int number_;
};

[[noreturn]] void refuse(const std::string& path, int reason) {
  if (reason == ENOENT || reason == ENOTDIR) throw FileError(path + ": no such file. Check the path.");
  throw FileError(path + ": cannot be read: " + std::strerror(reason) + ". Check the path and the permissions.");
}

const char* type_name(mode_t mode) {
  if (S_ISDIR(mode)) return "a folder";
  if (S_ISFIFO(mode)) return "a pipe";
  if (S_ISSOCK(mode)) return "a socket";
  return "a device";
}

void require(const std::string& path, const struct stat& status, const InputKind& kind) {
  if (!S_ISREG(status.st_mode))
    throw FileError(path + ": is " + type_name(status.st_mode) + ", needed is a regular file, " + kind.name + ".");
  if (static_cast<std::uint64_t>(status.st_size) > kind.most_bytes)
    throw FileError(path + ": has " + std::to_string(status.st_size) + " bytes, " + kind.name + " has at most " +
                    std::to_string(kind.most_bytes) + ". Is it the right file?");
}

/// Opened without waiting, also where it is a pipe that nobody writes to.
std::unique_ptr<Descriptor> open_input(const std::string& path, const InputKind& kind, struct stat& status) {
  auto file = std::make_unique<Descriptor>(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC));
  if (file->number() < 0 || fstat(file->number(), &status) != 0) {
    // A socket cannot be opened at all: what it is says more than the system's reason.
    const int reason = errno;
    if (stat(path.c_str(), &status) == 0) require(path, status, kind);
    refuse(path, reason);
  }
  require(path, status, kind);
  return file;
}

std::string read_all(const std::string& path, const InputKind& kind) {
  struct stat status {};
  const auto file = open_input(path, kind, status);
  std::string content(static_cast<std::size_t>(status.st_size), '\0');
  for (std::size_t filled = 0;;) {
    if (filled == content.size()) content.resize(filled + 4096);  // it may have grown
    const ssize_t got = read(file->number(), content.data() + filled, content.size() - filled);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) refuse(path, errno);
    filled += static_cast<std::size_t>(got);
    if (filled > kind.most_bytes)
      throw FileError(path + ": has more than " + std::to_string(kind.most_bytes) + " bytes, the most that " +
                      kind.name + " has. Is it the right file?");
    if (got == 0) {
      content.resize(filled);
      return content;
    }
  }
}

/// What a file has come to: its content, or why there is none. No exception passes between the threads.
struct Outcome {
  std::string content, defect;
};

/// On a thread of its own, which is left behind where the file does not answer. It holds all that it needs.
std::string within_patience(const std::string& path, std::function<std::string()> work) {
  std::packaged_task<Outcome()> task([work = std::move(work)]() -> Outcome {
    try {
      return {work(), {}};
    } catch (const std::exception& e) {
      return {{}, e.what()};
    }
  });
  std::future<Outcome> result = task.get_future();
  std::thread(std::move(task)).detach();
  if (result.wait_for(patience) != std::future_status::ready)
    throw FileError(path + ": does not answer for " + std::to_string(patience.count()) +
                    " s. Is it on a mount that hangs?");
  Outcome outcome = result.get();
  if (!outcome.defect.empty()) throw FileError(outcome.defect);
  return std::move(outcome.content);
}

}  // namespace

std::string read_input_file(const std::string& path, const InputKind& kind) {
  return within_patience(path, [path, kind] { return read_all(path, kind); });
}

void require_input_file(const std::string& path, const InputKind& kind) {
  within_patience(path, [path, kind] {
    struct stat status {};
    open_input(path, kind, status);
    return std::string();
  });
}

}  // namespace ehm::files
