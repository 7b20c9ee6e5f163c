// SPDX-License-Identifier: Apache-2.0
// The path of a sample: the fuzzer's bytes become a flight, sample by sample, mostly plausible and spoilt here and
// there, with silences and resets between; whatever comes, the cycle keeps its promises (published.h).

#include "tests/fuzz/byte_reader.h"
#include "tests/fuzz/published.h"
#include "tests/fuzz/small_design.h"

namespace {

using namespace ehm;

/// What may become of the next sample; the bits of one byte.
enum Change : std::uint8_t {
  sequence = 1,   ///< jumps
  time = 2,       ///< jumps
  sensors = 4,    ///< some take any bits, or a step in percent of trim
  actuators = 8,  ///< the same
  flight = 16,
  header = 32,  ///< schema, source, writer, counts, validity
  silence = 64,
  reset = 128
};

class Pilot {
 public:
  explicit Pilot(const linear_model::LinearModel& model) : model_(model) {
    sample_.schema = 1;
    sample_.sensor_count = static_cast<std::uint32_t>(model.sensors.size());
    sample_.actuator_count = static_cast<std::uint32_t>(model.controls.size());
    sample_.sensor_valid = 0xffffffffu;
    if (model.operating_point) sample_.flight = *model.operating_point;
    for (std::size_t i = 0; i < model.sensors.size(); ++i) sample_.sensor[i] = model.sensors[i].trim;
    for (std::size_t i = 0; i < model.controls.size(); ++i) sample_.actuator[i] = model.controls[i].trim;
  }

  /// The next sample, as the bytes tell. Jumps and steps stay; a spoilt header does not.
  monitor::Sample next(std::uint8_t change, fuzz::ByteReader& bytes) {
    ++sample_.sequence;
    time_ns_ += static_cast<std::uint64_t>(1e9 * model_.sample_time_s);
    for (std::size_t i = 0; i < model_.sensors.size(); ++i)  // a trace of noise, since equal values are stuck
      sample_.sensor[i] =
          model_.sensors[i].trim * (1.0 + 1e-5 * static_cast<double>(sample_.sequence * (i + 1) % 7)) + step_[i];
    for (std::size_t i = 0; i < model_.controls.size(); ++i) sample_.actuator[i] = model_.controls[i].trim + hold_[i];
    if (change & Change::sequence) sample_.sequence += bytes.take<std::uint64_t>() >> (bytes.take<std::uint8_t>() % 64);
    if (change & Change::time)
      time_ns_ += static_cast<std::uint64_t>(bytes.take<std::int64_t>() >> (bytes.take<std::uint8_t>() % 64));
    sample_.source_time_ns = static_cast<std::int64_t>(time_ns_);
    monitor::Sample s = sample_;
    if (change & Change::sensors) spoil(s.sensor, step_, model_.sensors, bytes);
    if (change & Change::actuators) spoil(s.actuator, hold_, model_.controls, bytes);
    if (change & Change::flight) {
      const auto which = bytes.take<std::uint8_t>();
      (which % 3 == 0   ? s.flight.altitude_m
       : which % 3 == 1 ? s.flight.mach
                        : s.flight.delta_isa_k) = bytes.take<double>();
    }
    if (change & Change::header) spoil_header(s, bytes);
    return s;
  }

 private:
  /// One value takes the fuzzer's bits once, or moves by a step in percent of trim that stays.
  template <class Values, class Steps>
  static void spoil(Values& values, Steps& steps, const std::vector<linear_model::Channel>& channels,
                    fuzz::ByteReader& bytes) {
    const auto which = bytes.take<std::uint8_t>();
    const std::size_t count = std::min(channels.size(), values.size());
    if (count == 0) return;
    const std::size_t i = which % count;
    if (which & 128u)
      values[i] = bytes.take<double>();
    else
      steps[i] = 0.01 * channels[i].trim * bytes.take<std::int8_t>();
  }
  static void spoil_header(monitor::Sample& s, fuzz::ByteReader& bytes) {
    const auto value = bytes.take<std::uint32_t>();
    switch (bytes.take<std::uint8_t>() % 6) {
      case 0:
        s.schema = value;
        break;
      case 1:
        s.source_id = value;
        break;
      case 2:
        s.writer = value;
        break;
      case 3:
        s.sensor_count = value;
        break;
      case 4:
        s.actuator_count = value;
        break;
      default:
        s.sensor_valid = value;
        break;
    }
  }

  const linear_model::LinearModel& model_;
  monitor::Sample sample_;
  std::uint64_t time_ns_ = 0;
  std::array<double, estimation::max_sensors> step_{};
  std::array<double, estimation::max_actuators> hold_{};
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr int longest_flight = 2000;
  const auto design = fuzz::small_design();
  static const monitor::MonitorCycle fresh(design, monitor::CycleOptions{});
  monitor::MonitorCycle cycle = fresh;
  fuzz::ByteReader bytes(data, size);
  Pilot pilot(design->model);
  for (int samples = 0; samples < longest_flight && !bytes.empty();) {
    const auto change = bytes.take<std::uint8_t>();
    // Without a change, a stretch of plain flight: faults are declared and requalified over many samples.
    const int stretch = change == 0 ? bytes.take<std::uint8_t>() : 1;
    if (change & Change::silence) cycle.no_input(bytes.take<double>());
    if (change & Change::reset) cycle.reset();
    for (int i = 0; i < stretch; ++i, ++samples) {
      cycle.process(pilot.next(change, bytes));
      fuzz::require_promises(cycle);
      cycle.clear_events();
    }
    if (stretch == 0) ++samples;
  }
  return 0;
}
