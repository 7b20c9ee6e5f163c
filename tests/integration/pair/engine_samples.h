// SPDX-License-Identifier: Apache-2.0
#pragma once
// Good samples of one engine at the design's trim, for tests that publish by themselves and spoil some of them.

#include <nlohmann/json.hpp>

#include <fstream>
#include <string>
#include <vector>

#include "idl/topics.h"
#include "idl/wire_values.h"

namespace ehm::test {

class EngineSamples {
 public:
  EngineSamples(const std::string& design_file, std::uint32_t engine_id) : engine_id_(engine_id) {
    const auto design = nlohmann::json::parse(std::ifstream(design_file));
    for (const auto& channel : design["model"]["sensors"]) trim_.push_back(channel["trim"]);
    for (const auto& channel : design["model"]["controls"]) actuator_trim_.push_back(channel["trim"]);
  }

  /// The next in order, 15 ms after the one before.
  EngineSensors next() {
    EngineSensors s;
    s.engine_id(engine_id_);
    s.schema(idl::schema_version);
    s.source_id(source_id_);
    s.sequence_number(sequence_);
    s.source_time_ns(1'000'000'000'000 + static_cast<std::int64_t>(sequence_) * 15'000'000);
    s.altitude_m(10668.0);
    s.mach(0.8);
    s.actuator_count(static_cast<std::uint32_t>(actuator_trim_.size()));
    std::copy(actuator_trim_.begin(), actuator_trim_.end(), s.actuator().begin());
    s.sensor_count(static_cast<std::uint32_t>(trim_.size()));
    s.sensor_valid((1u << trim_.size()) - 1);
    // A trace of noise, since equal values would be stuck.
    for (std::size_t i = 0; i < trim_.size(); ++i)
      s.sensor()[i] = trim_[i] * (1.0 + 1e-5 * static_cast<double>(sequence_ % 7));
    ++sequence_;
    return s;
  }
  void set_source(std::uint32_t source_id) { source_id_ = source_id; }
  const std::vector<double>& trim() const { return trim_; }

 private:
  std::uint32_t engine_id_, source_id_ = 9;
  std::vector<double> trim_, actuator_trim_;
  std::uint64_t sequence_ = 0;
};

}  // namespace ehm::test
