// SPDX-License-Identifier: Apache-2.0
#include "monitor/checkpoint/checkpoint_writer.h"

#include <spdlog/spdlog.h>

#include <chrono>
#include <filesystem>

#include "deploy/runtime/files/atomic_file.h"
#include "deploy/runtime/files/file_error.h"
#include "deploy/runtime/service/last_catch.h"
#include "monitor/checkpoint/checkpoint_folder.h"

namespace ehm::monitor {

namespace {

constexpr std::chrono::milliseconds poll{20}, stop_limit{400};

CheckpointRequest room_for(std::size_t companions) {
  CheckpointRequest request;
  request.state.companions.resize(companions);
  return request;
}

}  // namespace

CheckpointWriter::CheckpointWriter(std::string folder, NoticeBoard& notices, std::size_t companions)
    : folder_(std::move(folder)),
      notices_(notices),
      queue_(std::make_unique<SpscQueue<CheckpointRequest, queue_length>>(room_for(companions))) {
  try {
    require_writable_folder(folder_, "checkpoint.directory");
  } catch (const files::FileError& e) {
    tell(true, e.what());
  }
  thread_ = std::thread([this] { run(); });
}

CheckpointWriter::~CheckpointWriter() {
  stop_.store(true, std::memory_order_release);
  thread_.join();
}

void CheckpointWriter::run() {
  CheckpointRequest request;
  while (!stop_.load(std::memory_order_acquire)) {
    service::survive("checkpoints", [&] {
      while (queue_->pop(request)) write(request);
    });
    std::this_thread::sleep_for(poll);
  }
  const auto limit = std::chrono::steady_clock::now() + stop_limit;
  while (std::chrono::steady_clock::now() < limit && queue_->pop(request)) write(request);
  std::size_t left = 0;
  while (queue_->pop(request)) ++left;
  if (left > 0) spdlog::warn("{} checkpoints were not written in time; the files before them stand", left);
}

void CheckpointWriter::write(const CheckpointRequest& request) {
  Checkpoint checkpoint{request.engine_id, std::string(request.design_hash.data(), request.design_hash.size()),
                        request.wall_time_ns, request.state};
  try {
    std::error_code there;  // if it cannot be made, writing says why
    if (failing_) std::filesystem::create_directories(folder_, there);
    files::write_file_atomically(checkpoint_path(folder_, request.engine_id), to_text(checkpoint));
    written_.fetch_add(1, std::memory_order_relaxed);
    tell(false, "");
  } catch (const std::exception& e) {
    failed_.fetch_add(1, std::memory_order_relaxed);
    tell(true, e.what());
  }
}

void CheckpointWriter::tell(bool failing, const std::string& why) {
  if (failing == failing_) return;
  failing_ = failing;
  notices_.post({.kind = idl::EventKind::checkpoint,
                 .raised = failing,
                 .text = failing ? "checkpoints cannot be written, the monitor flies without and tries again: " + why
                                 : "checkpoints are written again"});
}

}  // namespace ehm::monitor
