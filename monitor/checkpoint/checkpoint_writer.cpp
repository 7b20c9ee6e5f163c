#include "monitor/checkpoint/checkpoint_writer.h"

#include <spdlog/spdlog.h>

#include <chrono>

#include "deploy/files/atomic_file.h"
#include "deploy/files/file_error.h"
#include "monitor/checkpoint/checkpoint_folder.h"

namespace ehm::monitor {

namespace {

constexpr std::chrono::milliseconds poll{20}, stop_limit{400};

}  // namespace

CheckpointWriter::CheckpointWriter(std::string folder)
    : folder_(std::move(folder)),
      queue_(std::make_unique<SpscQueue<CheckpointRequest, queue_length>>()),
      thread_([this] { run(); }) {}

CheckpointWriter::~CheckpointWriter() {
  stop_.store(true, std::memory_order_release);
  thread_.join();
}

void CheckpointWriter::run() {
  CheckpointRequest request;
  while (!stop_.load(std::memory_order_acquire)) {
    while (queue_->pop(request)) write(request);
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
    files::write_file_atomically(checkpoint_path(folder_, request.engine_id), to_text(checkpoint));
    written_.fetch_add(1, std::memory_order_relaxed);
  } catch (const std::exception& e) {
    // Said once a thousand: a full disk must not fill the log as well.
    if (failed_.fetch_add(1, std::memory_order_relaxed) % 1000 == 0) spdlog::error("checkpoint: {}", e.what());
  }
}

}  // namespace ehm::monitor
