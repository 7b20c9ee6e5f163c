// SPDX-License-Identifier: Apache-2.0
// The design file: refused with a FileError, or for matrices that do not fit together, or a design that flies.

#include "deploy/runtime/files/file_error.h"
#include "monitor/design/design_file.h"
#include "tests/fuzz/memory_file.h"
#include "tests/fuzz/published.h"
#include "tests/fuzz/sealed_json.h"

namespace {

/// At the design's trim, with a trace of change, since equal values are stuck.
ehm::monitor::Sample at_trim(const ehm::linear_model::LinearModel& model, std::uint64_t sequence) {
  ehm::monitor::Sample s;
  s.schema = 1;
  s.sequence = sequence;
  s.source_time_ns =
      static_cast<std::int64_t>(1e9 * std::min(model.sample_time_s, 1e6) * static_cast<double>(sequence));
  if (model.operating_point) s.flight = *model.operating_point;
  s.sensor_count = static_cast<std::uint32_t>(model.sensors.size());
  s.sensor_valid = 0xffffffffu;
  s.actuator_count = static_cast<std::uint32_t>(model.controls.size());
  for (std::size_t i = 0; i < model.sensors.size(); ++i)
    s.sensor[i] = model.sensors[i].trim * (1.0 + 1e-6 * static_cast<double>(sequence % 3));
  for (std::size_t i = 0; i < model.controls.size(); ++i) s.actuator[i] = model.controls[i].trim;
  return s;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ehm;
  const std::string text = fuzz::sealed(data, size);
  const fuzz::MemoryFile file(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
  std::shared_ptr<const design::Design> design;
  try {
    design = std::make_shared<const design::Design>(design::read_design(file.path()));
  } catch (const files::FileError& e) {
    EHM_REQUIRE(e.what()[0] != '\0');
    return 0;
  }
  std::unique_ptr<monitor::MonitorCycle> made;
  try {
    made = std::make_unique<monitor::MonitorCycle>(design, monitor::CycleOptions{});
  } catch (const std::invalid_argument& e) {  // the engine table adds the file's name
    EHM_REQUIRE(e.what()[0] != '\0');
    return 0;
  }
  monitor::MonitorCycle& cycle = *made;
  for (std::uint64_t i = 0; i < 12; ++i) {
    cycle.process(at_trim(design->model, i));
    fuzz::require_promises(cycle);
    cycle.clear_events();
  }
  return 0;
}
