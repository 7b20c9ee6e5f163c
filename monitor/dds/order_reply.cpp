// SPDX-License-Identifier: Apache-2.0
#include "monitor/dds/order_reply.h"

#include <spdlog/fmt/fmt.h>

#include "idl/wire_names.h"
#include "monitor/shared/reset_throttle.h"

namespace ehm::monitor {

namespace {

std::string text_of(std::uint32_t engine_id, const OrderOutcome& o) {
  using Kind = OrderOutcome::Kind;
  const std::string_view estimator = idl::ordered_estimator(o.order);
  switch (o.kind) {
    case Kind::done:
      if (!estimator.empty())
        return fmt::format("estimates of {} are published{}", estimator,
                           o.engines == 1 ? "" : fmt::format(" for {} engines", o.engines));
      return o.engines == 1 ? "the filter starts anew; sensors that were named faulty stay out until they requalify"
                            : fmt::format(
                                  "the filters of {} engines start anew; sensors that were named faulty stay "
                                  "out until they requalify",
                                  o.engines);
    case Kind::other_schema:
      return fmt::format("its schema is not {}", idl::schema_version);
    case Kind::unknown_kind:
      return fmt::format("kind {} is unknown, {} is a reset, from {} on estimators are published", o.order,
                         static_cast<std::uint32_t>(idl::MonitorCommandKind::reset),
                         static_cast<std::uint32_t>(idl::MonitorCommandKind::publish));
    case Kind::not_served:
      return engine_id == 0 ? "no engine is served yet" : fmt::format("engine {} is not served here", engine_id);
    case Kind::too_soon:
      return fmt::format("{} of {} engines were reset less than {:.2g} s ago", o.refused, o.engines,
                         ResetThrottle::period_s);
    case Kind::not_flying:
      return fmt::format("{} does not fly for {} of {} engines: name it in estimator.shadow and restart", estimator,
                         o.refused, o.engines);
    case Kind::no_answer:
      return fmt::format(
          "{} has no estimate now for {} of {} engines: no usable sample, outside of where it holds, or "
          "at rest",
          estimator, o.refused, o.engines);
  }
  return "for a reason that this version does not know";
}

}  // namespace

CommandReply reply_to(std::uint32_t engine_id, const OrderOutcome& outcome, std::uint32_t source_id) {
  CommandReply reply;
  reply.engine_id(engine_id);
  reply.source_id(source_id);
  reply.role(static_cast<std::uint32_t>(idl::DescriptionRole::monitor));
  reply.schema(idl::schema_version);
  reply.request(outcome.request);
  reply.kind(outcome.order);
  reply.accepted(outcome.kind == OrderOutcome::Kind::done ? 1 : 0);
  reply.message() = text_of(engine_id, outcome).c_str();
  return reply;
}

}  // namespace ehm::monitor
