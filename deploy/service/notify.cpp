#include "deploy/service/notify.h"

#include <systemd/sd-daemon.h>
#include <time.h>

namespace ehm::service {

namespace {

/// A refusal (a socket that is gone) is not worth stopping a service for.
void tell(const std::string& message) {
  static_cast<void>(sd_notify(0, message.c_str()));
}

}  // namespace

void notify_ready() {
  tell("READY=1");
}

void notify_status(const std::string& text) {
  tell("STATUS=" + text);
}

void notify_reloading() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  tell("RELOADING=1\nMONOTONIC_USEC=" + std::to_string(now.tv_sec * 1'000'000LL + now.tv_nsec / 1000));
}

void notify_stopping() {
  tell("STOPPING=1");
}

}  // namespace ehm::service
