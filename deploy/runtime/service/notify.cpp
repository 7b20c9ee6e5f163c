// SPDX-License-Identifier: Apache-2.0
#include "deploy/runtime/service/notify.h"

#include <systemd/sd-daemon.h>

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

void notify_stopping() {
  tell("STOPPING=1");
}

}  // namespace ehm::service
