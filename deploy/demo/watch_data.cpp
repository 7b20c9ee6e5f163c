#include "deploy/demo/watch_data.h"

#include <cmath>
#include <limits>

#include "idl/wire_values.h"

namespace ehm::demo {

double Row::deviation() const {
  const double deviation = std::abs(estimate - truth) / sigma;
  return sigma > 0.0 && std::isfinite(deviation) ? deviation : std::numeric_limits<double>::infinity();
}

void WatchData::hear(const EngineTruth& truth) {
  if (!first_time_ns_) first_time_ns_ = truth.source_time_ns();
  recent_truth_[truth.sequence_number() % recent_truth_.size()] = truth;
  last_truth_ = truth;
}

void WatchData::hear(const EngineHealth& health) {
  health_ = health;
  ++estimates_;
  latency_.record(1e-3 * static_cast<double>(health.publish_time_ns() - health.source_time_ns()));
}

void WatchData::hear(const EngineAuxiliary& auxiliary) {
  auxiliary_ = auxiliary;
}

void WatchData::hear(const EngineDescription& description) {
  if (description.role() == static_cast<std::uint32_t>(wire::DescriptionRole::monitor)) description_ = description;
}

void WatchData::hear(const MonitorStatus& status) {
  status_ = status;
}

void WatchData::hear(const HealthEvent& event) {
  const double time_s = first_time_ns_ ? 1e-9 * static_cast<double>(event.source_time_ns() - *first_time_ns_) : 0.0;
  events_.push_back({time_s, event.raised() != 0, event.kind(), event.channel_name().c_str(), event.message().c_str(),
                     event.value()});
  if (events_.size() <= most_events) return;
  events_.pop_front();
  ++events_dropped_;
}

const EngineTruth* WatchData::truth_of(std::uint64_t sequence) const {
  const auto& candidate = recent_truth_[sequence % recent_truth_.size()];
  return candidate && candidate->sequence_number() == sequence ? &*candidate : nullptr;
}

std::vector<Row> WatchData::health() const {
  std::vector<Row> rows;
  if (!health_ || !description_) return rows;
  const EngineTruth* truth = truth_of(health_->sequence_number());
  for (std::size_t i = 0; truth && i < health_->health_count(); ++i)
    rows.push_back({description_->health()[i].name().c_str(), description_->health()[i].unit().c_str(),
                    truth->health()[i], health_->health()[i], health_->sigma_total()[i]});
  return rows;
}

std::vector<Row> WatchData::auxiliary() const {
  std::vector<Row> rows;
  if (!auxiliary_ || !description_) return rows;
  const EngineTruth* truth = truth_of(auxiliary_->sequence_number());
  for (std::size_t i = 0; truth && i < auxiliary_->auxiliary_count(); ++i)
    rows.push_back({description_->auxiliary()[i].name().c_str(), description_->auxiliary()[i].unit().c_str(),
                    truth->auxiliary()[i], auxiliary_->auxiliary()[i], auxiliary_->sigma_total()[i]});
  return rows;
}

std::uint64_t WatchData::lost() const {
  if (!status_) return 0;
  if (!accounted()) return status_->samples_lost();
  return published() > received() ? published() - received() : 0;
}

double WatchData::flight_time_s() const {
  return health_ && first_time_ns_ ? 1e-9 * static_cast<double>(health_->source_time_ns() - *first_time_ns_) : 0.0;
}

}  // namespace ehm::demo
