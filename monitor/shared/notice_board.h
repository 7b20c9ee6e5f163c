// SPDX-License-Identifier: Apache-2.0
#pragma once
// What the middleware's threads, or others beside the cycle, have to say: conditions that began or ended and that no
// sample decided. The reporter takes, logs and publishes each as a HealthEvent; what did not fit its board is in
// MonitorStatus.reports_lost.

#include <cstdint>
#include <string>

#include "idl/wire_values.h"
#include "monitor/shared/mailbox.h"

namespace ehm::monitor {

struct Notice {
  idl::EventKind kind{};
  bool raised = false;
  std::string text;
  std::uint32_t engine_id = 0;  ///< 0: the whole monitor
  double value = 0.0;
  double threshold = 0.0;
};

using NoticeBoard = Mailbox<Notice>;

}  // namespace ehm::monitor
