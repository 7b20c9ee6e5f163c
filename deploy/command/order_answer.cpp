// SPDX-License-Identifier: Apache-2.0
#include "deploy/command/order_answer.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "idl/wire_values.h"

namespace ehm::operating {

bool OrderAnswer::accepted() const {
  return !replies.empty() && unanswered.empty() &&
         std::all_of(replies.begin(), replies.end(), [](const CommandReply& r) { return r.accepted() == 1; });
}

std::string who(std::uint32_t role, std::uint32_t source_id) {
  const bool monitor = role == static_cast<std::uint32_t>(idl::DescriptionRole::monitor);
  return fmt::format("{} {}", monitor ? "monitor" : "source", source_id);
}

std::string opening(const OrderAnswer& r) {
  const std::string engine = r.engine_id == 0 ? "all engines" : fmt::format("engine {}", r.engine_id);
  return fmt::format("{}: {}\n{} reader{} of {} on domain {}\n", engine, r.order, r.readers, r.readers == 1 ? "" : "s",
                     r.topic, r.domain);
}

std::string line(const CommandReply& reply) {
  return fmt::format("{}: {}: {}\n", who(reply.role(), reply.source_id()), reply.accepted() == 1 ? "done" : "refused",
                     reply.message().c_str());
}

std::string json(const OrderAnswer& r) {
  nlohmann::ordered_json j{{"topic", r.topic},         {"domain", r.domain},   {"partition", r.partition},
                           {"engine_id", r.engine_id}, {"readers", r.readers}, {"order", r.order},
                           {"accepted", r.accepted()}};
  j["replies"] = nlohmann::ordered_json::array();
  for (const auto& reply : r.replies)
    j["replies"].push_back({{"from", who(reply.role(), reply.source_id())},
                            {"source_id", reply.source_id()},
                            {"accepted", reply.accepted() == 1},
                            {"message", reply.message().c_str()}});
  j["unanswered"] = r.unanswered;
  return j.dump(2) + "\n";
}

}  // namespace ehm::operating
