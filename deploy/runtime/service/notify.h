// SPDX-License-Identifier: Apache-2.0
#pragma once
// What a service tells systemd through NOTIFY_SOCKET (sd_notify(3), units with Type=notify). Without systemd nothing
// happens. Never call these on the cycle thread: each is a system call.

#include <string>

namespace ehm::service {

/// READY=1: everything that the service needs is there.
void notify_ready();
/// STATUS=...: one line that `systemctl status` shows.
void notify_status(const std::string& text);
/// STOPPING=1: the stop has been asked for and is under way.
void notify_stopping();

}  // namespace ehm::service
