// SPDX-License-Identifier: Apache-2.0
#pragma once
// What became of one order, as lines for people or one JSON object for machines.

#include <cstdint>
#include <string>
#include <vector>

#include "engine_health.h"

namespace ehm::operating {

struct OrderAnswer {
  std::string topic, partition;
  std::uint32_t domain = 0, engine_id = 0;
  int readers = 0;
  std::string order;
  std::vector<CommandReply> replies = {};
  std::vector<std::string> unanswered = {};  ///< who did not answer, and why

  /// Somebody answered, and all who listen carried it out.
  bool accepted() const;
};

/// "source 1", "monitor 101"
std::string who(std::uint32_t role, std::uint32_t source_id);
/// Before there are replies: who listens to what is ordered.
std::string opening(const OrderAnswer& report);
std::string line(const CommandReply& reply);
std::string json(const OrderAnswer& report);

}  // namespace ehm::operating
