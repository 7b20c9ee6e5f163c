// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/figures/gnuplot.h"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <stdexcept>

extern char** environ;

namespace ehm::engine_sim {
namespace {

/// A nameless file: unlike a pipe it never makes the two programs wait for each other.
class Scratch {
 public:
  Scratch() : file_(std::tmpfile()) {
    if (file_ == nullptr) throw std::runtime_error(std::string("no temporary file: ") + std::strerror(errno));
  }
  ~Scratch() { std::fclose(file_); }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  void fill(const std::string& text) {
    if (std::fwrite(text.data(), 1, text.size(), file_) != text.size() || std::fflush(file_) != 0)
      throw std::runtime_error(std::string("temporary file: ") + std::strerror(errno));
    rewind();
  }
  std::string text() {
    rewind();
    std::string all;
    for (char buffer[256]; std::fgets(buffer, sizeof buffer, file_) != nullptr;) all += buffer;
    return all;
  }
  int descriptor() const { return fileno(file_); }

 private:
  void rewind() { std::rewind(file_); }
  std::FILE* file_;
};

pid_t start(int in, int out, int err) {
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_adddup2(&files, in, STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&files, out, STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&files, err, STDERR_FILENO);
  std::string name = "gnuplot";
  char* arguments[] = {name.data(), nullptr};
  pid_t child = 0;
  const int error = posix_spawnp(&child, name.c_str(), &files, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&files);
  if (error == ENOENT) throw std::runtime_error("gnuplot is not installed; install the package gnuplot-nox");
  if (error != 0) throw std::runtime_error(std::string("gnuplot cannot be started: ") + std::strerror(error));
  return child;
}

}  // namespace

void run_gnuplot(const std::string& script, int descriptor) {
  Scratch in, messages;
  in.fill(script);
  const pid_t child = start(in.descriptor(), descriptor, messages.descriptor());
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) throw std::runtime_error("gnuplot failed: " + messages.text());
}

}  // namespace ehm::engine_sim
