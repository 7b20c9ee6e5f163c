// SPDX-License-Identifier: Apache-2.0
#include "deploy/demo/watch_data.h"

#include <cmath>
#include <limits>

#include "idl/wire_names.h"

namespace ehm::demo {

namespace {

constexpr std::size_t most_monitors = 16;

std::uint64_t since(std::uint64_t before, std::uint64_t now) {
  return now > before ? now - before : 0;
}

Row row(const ChannelDescription& channel, double estimate, double sigma, const double* truth) {
  return {channel.name().c_str(), channel.unit().c_str(), truth ? std::optional(*truth) : std::nullopt, estimate,
          sigma};
}

}  // namespace

std::optional<double> Row::deviation() const {
  if (!truth) return std::nullopt;
  const double deviation = std::abs(estimate - *truth) / sigma;
  return sigma > 0.0 && std::isfinite(deviation) ? deviation : std::numeric_limits<double>::infinity();
}

void WatchData::hear(const EngineDescription& description, std::uint64_t participant) {
  if (description.role() == static_cast<std::uint32_t>(idl::DescriptionRole::monitor)) description_ = description;
  if (description.role() == static_cast<std::uint32_t>(idl::DescriptionRole::source)) truth_.describe(participant);
}

void WatchData::hear(const EngineHealth& health) {
  if (!first_time_ns_) {
    first_time_ns_ = health.source_time_ns();
    first_sequence_ = health.sequence_number();
  }
  health_ = health;
  ++estimates_;
  truth_.follow(health.sequence_number(), health.source_time_ns());
}

void WatchData::hear(const MonitorStatus& status) {
  auto known = monitors_.find(status.source_id());
  if (known == monitors_.end()) {
    if (monitors_.size() == most_monitors) return;
    known = monitors_.emplace(status.source_id(), Watched{status, status}).first;
  }
  Watched& monitor = known->second;
  if (status.samples_received() < monitor.last.samples_received()) monitor.first = MonitorStatus();  // started anew
  monitor.last = status;
  monitor.error_said |= status.level() == static_cast<std::uint32_t>(idl::StatusLevel::error);
  last_monitor_ = status.source_id();
}

void WatchData::hear(const HealthEvent& event) {
  const double time_s = first_time_ns_ ? 1e-9 * static_cast<double>(event.source_time_ns() - *first_time_ns_) : 0.0;
  events_.push_back({time_s, event.raised() != 0, event.kind(), event.channel_name().c_str(), event.message().c_str(),
                     event.value()});
  if (events_.size() <= most_events) return;
  events_.pop_front();
  ++events_dropped_;
}

const WatchData::Watched* WatchData::watched() const {
  auto known = health_ ? monitors_.find(health_->source_id()) : monitors_.end();
  if (known == monitors_.end()) known = monitors_.find(last_monitor_);
  return known == monitors_.end() ? nullptr : &known->second;
}

const MonitorStatus* WatchData::status() const {
  return watched() ? &watched()->last : nullptr;
}

std::vector<Row> WatchData::health() const {
  std::vector<Row> rows;
  if (!health_ || !description_) return rows;
  const EngineTruth* truth = truth_.find(health_->sequence_number(), health_->source_time_ns());
  for (std::size_t i = 0; i < health_->health_count(); ++i)
    rows.push_back(row(description_->health()[i], health_->health()[i], health_->sigma_total()[i],
                       truth ? &truth->health()[i] : nullptr));
  return rows;
}

std::vector<Row> WatchData::auxiliary() const {
  std::vector<Row> rows;
  if (!auxiliary_ || !description_) return rows;
  const EngineTruth* truth = truth_.find(auxiliary_->sequence_number(), auxiliary_->source_time_ns());
  for (std::size_t i = 0; i < auxiliary_->auxiliary_count(); ++i)
    rows.push_back(row(description_->auxiliary()[i], auxiliary_->auxiliary()[i], auxiliary_->sigma_total()[i],
                       truth ? &truth->auxiliary()[i] : nullptr));
  return rows;
}

std::vector<std::string> WatchData::sensors(bool used) const {
  std::vector<std::string> names;
  if (!health_ || !description_) return names;
  for (std::size_t i = 0; i < description_->sensor_count(); ++i)
    if ((health_->sensors_used() >> i & 1u) == (used ? 1u : 0u))
      names.emplace_back(description_->sensors()[i].name().c_str());
  return names;
}

std::vector<std::string> WatchData::flags() const {
  std::vector<std::string> names;
  for (const auto& [bit, name] : idl::estimate_flag_names)
    if (health_ && (health_->flags() & bit) != 0) names.emplace_back(name);
  return names;
}

std::uint64_t WatchData::lost() const {
  if (!watched()) return 0;
  if (accounted()) return since(received(), published());
  return since(watched()->first.samples_lost(), watched()->last.samples_lost());
}

std::uint64_t WatchData::withheld() const {
  return watched() ? since(watched()->first.samples_withheld(), watched()->last.samples_withheld()) : 0;
}

double WatchData::flight_time_s() const {
  if (!health_) return 0.0;
  if (health_->source_time_ns() != 0) return 1e-9 * static_cast<double>(health_->source_time_ns() - *first_time_ns_);
  // A source without a clock: its samples are counted.
  const double sample_time_s = description_ ? description_->sample_time_s() : 0.0;
  return sample_time_s * static_cast<double>(since(first_sequence_, health_->sequence_number()));
}

}  // namespace ehm::demo
