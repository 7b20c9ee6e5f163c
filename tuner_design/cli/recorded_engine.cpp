// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/cli/recorded_engine.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>
#include <vector>

#include "deploy/runtime/config/config_error.h"
#include "deploy/runtime/files/file_error.h"
#include "deploy/runtime/numbers/index.h"
#include "deploy/runtime/recording/row_source.h"
#include "deploy/runtime/units/units.h"

namespace ehm::tuner_design {
namespace {

using Eigen::Index;
using files::FileError;
using recording::Row;

constexpr std::int64_t most_lost = 3;
constexpr double sample_time_tolerance = 0.1, longest_step = 1.5, stray_step = 3.0;

/// Where a channel of the model stands in a row, and how its value becomes the model's.
struct Place {
  std::size_t at = 0;
  units::Conversion conversion;
};

std::vector<Place> places(const std::string& file, const char* what, const std::vector<recording::Channel>& have,
                          const std::vector<linear_model::Channel>& want) {
  std::vector<Place> all;
  std::string list;
  for (const recording::Channel& channel : have) list += (list.empty() ? "" : ", ") + channel.name;
  for (const linear_model::Channel& channel : want) {
    const auto found =
        std::find_if(have.begin(), have.end(), [&](const auto& one) { return one.name == channel.name; });
    if (found == have.end())
      throw FileError(file + ": has no " + what + " " + channel.name + ", which the model needs; it has " +
                      (list.empty() ? "none" : list));
    const auto conversion = units::conversion(found->unit, channel.unit);
    if (!conversion)
      throw FileError(file + ": " + what + " " + channel.name + " is in '" + found->unit + "', the model has it in '" +
                      channel.unit + "', which cannot be converted: " + units::why_not(found->unit, channel.unit));
    all.push_back({as_size(found - have.begin()), *conversion});
  }
  return all;
}

std::unique_ptr<recording::RowSource> opened(const std::string& file, const std::string& column_map) {
  try {
    return recording::open_rows(file, column_map);
  } catch (const config::ConfigError& error) {
    throw FileError(error.what());
  }
}

class EngineReader {
 public:
  EngineReader(const std::string& file, const std::string& column_map, std::optional<std::int64_t> engine_id,
               const linear_model::LinearModel& model)
      : file_(file),
        by_time_(!column_map.empty()),
        wanted_(engine_id),
        model_(model),
        rows_(opened(file, column_map)),
        sensors_(places(file, "sensor", rows_->info().channels.sensors, model.sensors)),
        controls_(places(file, "actuator", rows_->info().channels.actuators, model.controls)) {}

  RecordedEngine read() {
    for (Row row; rows_->next(row);)
      if (row.kind() == recording::RowKind::sample) take(row);
    require_one_engine();
    require_sample_time();
    RecordedEngine result{.samples = {}, .engine_id = engine_id_, .not_accepted = not_accepted_};
    const auto N = as_index(sequence_.size());
    const auto matrix = [&](const std::vector<double>& values, Index height) -> Eigen::MatrixXd {
      return Eigen::Map<const Eigen::MatrixXd>(values.data(), height, N);
    };
    result.samples = {matrix(flight_, recording::flight_channels), matrix(control_, as_index(controls_.size())),
                      matrix(sensor_, as_index(sensors_.size())), gaps()};
    return result;
  }

 private:
  void take(const Row& row) {
    engines_.insert(row.a.unit);
    if (wanted_ && row.a.unit != *wanted_) return;
    engine_id_ = row.a.unit;
    if (row.a.accepted == 0) {
      ++not_accepted_;
      return;
    }
    if (!sequence_.empty()) add_lost(row.a.sequence - sequence_.back() - 1, row.a.source_time_ns);
    sequence_.push_back(row.a.sequence);
    time_ns_.push_back(row.a.source_time_ns);
    flight_.insert(flight_.end(), row.w.begin(), row.w.begin() + recording::flight_channels);
    for (const Place& place : controls_)
      control_.push_back(place.conversion(row.w[recording::flight_channels + place.at]));
    for (const Place& place : sensors_) {
      const bool valid = (row.a.sensor_valid >> place.at & 1) != 0 && std::isfinite(row.x_s[place.at]);
      sensor_.push_back(valid ? place.conversion(row.x_s[place.at]) : recording::no_value);
    }
  }

  /// Samples that the sequence numbers say were lost, as samples without values; many are a gap.
  void add_lost(std::int64_t count, std::int64_t now_ns) {
    if (count < 1 || count > most_lost) return;
    const std::int64_t step_ns = (now_ns - time_ns_.back()) / (count + 1);
    for (std::int64_t i = 0; i < count; ++i) {
      sequence_.push_back(sequence_.back() + 1);
      time_ns_.push_back(time_ns_.back() + step_ns);
      flight_.resize(flight_.size() + recording::flight_channels, recording::no_value);
      control_.resize(control_.size() + controls_.size(), recording::no_value);
      sensor_.resize(sensor_.size() + sensors_.size(), recording::no_value);
    }
  }

  void require_one_engine() const {
    std::string list;
    for (const std::int64_t id : engines_) list += (list.empty() ? "" : ", ") + std::to_string(id);
    if (!wanted_ && engines_.size() > 1)
      throw FileError(file_ + ": has the engines " + list + "; name one with --engine-id");
    if (wanted_ && !engines_.contains(*wanted_))
      throw FileError(file_ + ": has no engine " + std::to_string(*wanted_) + "; it has " +
                      (list.empty() ? "none" : list));
    if (sequence_.empty()) throw FileError(file_ + ": has no accepted sample of the engine");
  }

  bool next_in_sequence(std::size_t k) const { return sequence_[k + 1] == sequence_[k] + 1; }
  double step_s(std::size_t k) const { return 1e-9 * static_cast<double>(time_ns_[k + 1] - time_ns_[k]); }

  /// Mean time between neighbours, without what is much longer than usual; 0 where the clock stands still.
  double usual_step_s() const {
    std::vector<double> steps;
    for (std::size_t k = 0; k + 1 < sequence_.size(); ++k)
      if (next_in_sequence(k)) steps.push_back(step_s(k));
    if (steps.empty()) return 0.0;
    const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
    std::nth_element(steps.begin(), middle, steps.end());
    const double longest = stray_step * std::max(*middle, model_.sample_time_s);
    double sum = 0.0, count = 0.0;
    for (const double step : steps)
      if (std::abs(step) <= longest) sum += step, count += 1.0;
    return count > 0.0 ? std::max(0.0, sum / count) : 0.0;
  }

  void require_sample_time() const {
    const double usual_s = usual_step_s();
    if (usual_s == 0.0 || std::abs(usual_s / model_.sample_time_s - 1.0) <= sample_time_tolerance) return;
    throw FileError(file_ + ": a sample each " + fmt::format("{:.6g}", usual_s) + " s, the model is made for " +
                    fmt::format("{:.6g}", model_.sample_time_s) +
                    " s; allowed is 10 % more or less. Resample the record, or give the model that sample time");
  }

  std::vector<Index> gaps() const {
    bool rises = by_time_;
    for (std::size_t k = 0; rises && k + 1 < sequence_.size(); ++k) rises = step_s(k) > 0.0;
    std::vector<Index> all;
    for (std::size_t k = 0; k + 1 < sequence_.size(); ++k)
      if (!next_in_sequence(k) || (rises && step_s(k) > longest_step * model_.sample_time_s))
        all.push_back(as_index(k));
    return all;
  }

  std::string file_;
  bool by_time_;
  std::optional<std::int64_t> wanted_;
  const linear_model::LinearModel& model_;
  std::unique_ptr<recording::RowSource> rows_;
  std::vector<Place> sensors_, controls_;
  std::set<std::int64_t> engines_;
  std::int64_t engine_id_ = 0;
  Index not_accepted_ = 0;
  std::vector<std::int64_t> sequence_, time_ns_;
  std::vector<double> flight_, control_, sensor_;
};

}  // namespace

RecordedEngine read_recorded_engine(const std::string& file, const std::string& column_map,
                                    std::optional<std::int64_t> engine_id, const linear_model::LinearModel& model) {
  return EngineReader(file, column_map, engine_id, model).read();
}

}  // namespace ehm::tuner_design
