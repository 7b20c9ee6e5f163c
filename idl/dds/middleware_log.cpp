// SPDX-License-Identifier: Apache-2.0
#include "idl/dds/middleware_log.h"

#include <fastdds/dds/log/Log.hpp>

#include <mutex>
#include <utility>

namespace ehm::idl {

namespace dds = eprosima::fastdds::dds;

namespace {

class Consumer : public dds::LogConsumer {
 public:
  explicit Consumer(std::function<void(const MiddlewareMessage&)> hear) : hear_(std::move(hear)) {}
  void Consume(const dds::Log::Entry& entry) override {
    hear_({entry.kind == dds::Log::Kind::Error, entry.context.category ? entry.context.category : "", entry.message});
  }

 private:
  std::function<void(const MiddlewareMessage&)> hear_;
};

}  // namespace

void hear_middleware(std::function<void(const MiddlewareMessage&)> hear, MiddlewareLevel level) {
  dds::Log::ClearConsumers();
  dds::Log::RegisterConsumer(std::make_unique<Consumer>(std::move(hear)));
  dds::Log::SetVerbosity(level == MiddlewareLevel::warnings ? dds::Log::Kind::Warning : dds::Log::Kind::Error);
}

bool is_of_no_concern(const MiddlewareMessage& message) {
  return message.error && message.category == "DATA_WRITER" &&
         message.text == "Could not set the next deadline in the history";
}

struct MiddlewareErrors::Collected {
  std::mutex mutex;
  std::string text;
};

MiddlewareErrors::MiddlewareErrors() : collected_(std::make_shared<Collected>()) {
  hear_middleware([collected = collected_](const MiddlewareMessage& message) {
    if (!message.error) return;
    const std::lock_guard lock(collected->mutex);
    collected->text += (collected->text.empty() ? "" : "; ") + message.text;
  });
}

MiddlewareErrors::~MiddlewareErrors() {
  dds::Log::Reset();
}

std::string MiddlewareErrors::text() const {
  dds::Log::Flush();
  const std::lock_guard lock(collected_->mutex);
  return collected_->text;
}

}  // namespace ehm::idl
