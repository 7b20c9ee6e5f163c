// SPDX-License-Identifier: Apache-2.0
#include "monitor/service/event_text.h"
#include "idl/printable.h"

#include <gmock/gmock.h>

#include "monitor/checks/sample_check.h"
#include "monitor/checks/sample_time_watch.h"

#include <cmath>

namespace {

using namespace ehm;
using idl::EventKind;
using monitor::Event;

linear_model::LinearModel model() {
  linear_model::LinearModel m;
  m.sensors = {{"T30", "K", 667.0}};
  m.sensor_noise_sigma = Eigen::VectorXd::Constant(1, 5.024);
  m.health = {{"hpc_efficiency", "fraction", 0.0}};
  m.auxiliary = {{"T40", "K", 1308.0}};
  return m;
}

std::string text(const Event& event) {
  return monitor::event_text(event, model());
}

TEST(EventText, SaysWhatHappenedToWhichChannel) {
  namespace reason = idl::reject_reason;
  EXPECT_EQ(text({EventKind::sensor_fault, 0, true, 1.4, 1.0, reason::range | reason::rate}),
            "sensor T30 is faulty (out of range, impossible rate) and no longer used");
  EXPECT_EQ(
      text({EventKind::sensor_fault, 0, true, 198.0, 198.0, reason::stuck | reason::innovation_gate}),
      "sensor T30 is faulty (stuck: 198 equal values in a row, a healthy one shows fewer than 198; stuck_samples in "
      "its [[sensor]] table sets the limit) and no longer used");
  EXPECT_EQ(
      text({EventKind::slow_sensor, 0, true, 0.495, 0.015, 0}),
      "sensor T30 is updated every 0.495 s, the design has 0.015 s: each value is used once, and its share of the "
      "estimates is slower; state its update_period_s and design anew");
  EXPECT_EQ(text({EventKind::condition_fault, 0, true, 0.0, 10668.0, 0}),
            "altitude_m jumped from 10668 to 0 m between two samples and stays there: it is believed");
  EXPECT_EQ(text({EventKind::condition_fault, 1, true, std::nan(""), 0.8, 1}),
            "mach is lost: it is nan, for longer than checks.bridge_samples allows: estimates are withheld");
  EXPECT_EQ(text({EventKind::condition_fault, 2, false, 0.0, 0.0, 0}), "delta_isa_k is good again");
  EXPECT_EQ(text({EventKind::sensor_fault, 0, true, 25.12, 6.0, reason::bias, 0.21}),
            "sensor T30 is faulty (bias +25.12 K, +5.0 sigma, since 0.21 s) and no longer used");
  EXPECT_EQ(text({EventKind::sensor_fault, 0, true, 1.7, 1.6, reason::noise}),
            "sensor T30 is faulty (its noise grew 1.7 times or more) and no longer used");
  EXPECT_EQ(text({EventKind::sensor_fault, 0, false, 0.0, 0.0, 0}), "sensor T30 is good again and used");
  EXPECT_EQ(text({EventKind::health_shift, 0, true, -0.0174, 0.0121, 0}),
            "hpc_efficiency changed by -0.0174 fraction (noticeable from 0.0121)");
  EXPECT_EQ(text({EventKind::auxiliary_limit, 0, true, 1391.5, 1380.0, 0}), "T40 is 1391.5 K, beyond its limit 1380");
  EXPECT_EQ(text({EventKind::health_limit, 0, false, 0.0, 0.0, 0}), "hpc_efficiency is back inside its limit");
  EXPECT_EQ(text({EventKind::input_lost, 0, true, 0.0461, 0.045, 0}), "no sample for 0.046 s, estimates are stale");
  EXPECT_EQ(text({EventKind::no_design, 0, true, 2.0, 1.0, 0}),
            "2 sensors are faulty and no design flies without them: estimates are withheld");
}

TEST(EventText, SaysWhyTheFilterStartedAnew) {
  using monitor::RestartReason;
  const auto restart = [](RestartReason reason, double seconds) {
    return text({EventKind::filter_restart, 0, true, seconds, 2.0, static_cast<std::uint32_t>(reason)});
  };
  EXPECT_EQ(restart(RestartReason::command, 0.0), "the filter started anew: reset by an operator");
  EXPECT_EQ(restart(RestartReason::other_design, 0.0), "the filter started anew: with another design or other options");
  EXPECT_EQ(restart(RestartReason::source_restarted, 0.2),
            "the filter started anew: the source restarted, its numbers begin anew (+0.200 s by its clock)");
  EXPECT_EQ(restart(RestartReason::source_restarted, 0.0),
            "the filter started anew: the source restarted, its numbers begin anew");
  EXPECT_EQ(restart(RestartReason::time_back, -50.0),
            "the filter started anew: the source's time jumped back by 50.000 s");
  EXPECT_EQ(restart(RestartReason::time_ahead, 99.5),
            "the filter started anew: the source paused, or its time jumped ahead, by 99.500 s; no sample is missing");
  EXPECT_EQ(restart(RestartReason::gap, 3.0),
            "the filter started anew: a gap of 3.000 s in the source's samples, 2 s are bridged");
  EXPECT_EQ(restart(RestartReason::sequence_jump, 15000.0),
            "the filter started anew: the sequence jumped by 1.5e+04 s of samples, which the source's time does not "
            "explain");
}

TEST(EventText, SaysWhatIsWrongWithStampsAndNumbers) {
  using monitor::StampState;
  using testing::HasSubstr;
  const auto stamps = [](StampState state, double seconds) {
    return text({EventKind::source_stamps, 0, true, seconds, 0.0, static_cast<std::uint32_t>(state)});
  };
  EXPECT_THAT(stamps(StampState::unset, 0.0), HasSubstr("source_time_ns is not set (0)"));
  EXPECT_THAT(stamps(StampState::repeated, 0.0), HasSubstr("source_time_ns repeats"));
  EXPECT_THAT(stamps(StampState::set_back, -0.005), HasSubstr("source_time_ns stepped back by 0.005 s"));
  EXPECT_EQ(text({EventKind::source_stamps, 0, false, 0.0, 0.0, 0}), "the source's stamps measure time again");
  EXPECT_THAT(text({EventKind::source_sequence, 0, true, 499.0, 0.0, 0}),
              HasSubstr("sequence stands still: new samples carry the number 499 of the one before"));
  EXPECT_THAT(text({EventKind::sample_time, 0, false, 0.0, 0.015, monitor::SampleTimeWatch::not_measured}),
              HasSubstr("measure no sample time any more"));
}

TEST(EventText, LostInputSaysWhatCameInstead) {
  using monitor::SampleVerdict;
  const auto bit = [](SampleVerdict verdict) { return 1u << static_cast<unsigned>(verdict); };
  EXPECT_EQ(text({EventKind::input_lost, 0, true, 0.0461, 0.045, bit(SampleVerdict::malformed)}),
            "no usable sample for 0.046 s, estimates are stale; what came: malformed ones");
  EXPECT_EQ(
      text(
          {EventKind::input_lost, 0, true, 0.0461, 0.045, bit(SampleVerdict::duplicate) | bit(SampleVerdict::foreign)}),
      "no usable sample for 0.046 s, estimates are stale; what came: duplicates of the last one, those of another "
      "source");
}

TEST(EventText, AnEstimatorIsNamedByItsNumber) {
  EXPECT_EQ(text({EventKind::estimator_overrun, 5, true, 9120.0, 7500.0, 0}),
            "estimator ekf took 9120 us for a sample, and 3 times in a row more than the 7500 us of "
            "estimator.budget_ms: it rests for 10 s");
  EXPECT_EQ(text({EventKind::estimator_overrun, 5, true, 0.0, 0.0, 0}),
            "estimator ekf overran its budget where this was recorded: it rests for 10 s");
  EXPECT_EQ(text({EventKind::estimator_overrun, 5, false, 0.0, 0.0, 0}),
            "estimator ekf flies again, from a cold start");
  EXPECT_EQ(text({EventKind::estimator_chosen, 0, true, 0.0, 0.0, 0}), "estimates of tuner are published, by order");
  EXPECT_EQ(monitor::channel_name({EventKind::estimator_chosen, 15, true, 0, 0, 0}, model()), "rls");
  EXPECT_EQ(monitor::channel_name({EventKind::estimator_chosen, 99, true, 0, 0, 0}, model()),
            "?");  // of another version
}

TEST(EventText, WhatIsToldElsewhereIsNoCheckpoint) {
  for (const EventKind kind : {EventKind::input_deadline, EventKind::input_liveliness, EventKind::configuration,
                               EventKind::incompatible_qos, EventKind::security})
    EXPECT_EQ(text({kind, 0, true, 0.1, 0.1, 0}), "unknown event");
}

TEST(EventText, NamesTheChannelOnlyWhereThereIsOne) {
  EXPECT_EQ(monitor::channel_name({EventKind::health_shift, 0, true, 0, 0, 0}, model()), "hpc_efficiency");
  EXPECT_EQ(monitor::channel_name({EventKind::input_lost, 0, true, 0, 0, 0}, model()), "");
}

TEST(EventText, FitsTheWire) {
  linear_model::LinearModel m = model();
  m.health[0] = {std::string(63, 'h'), std::string(31, 'u'), 0.0};
  EXPECT_LE(monitor::event_text({EventKind::health_shift, 0, true, -0.123456, 0.123456, 0}, m).size(), 255u);
}

TEST(Printable, KeepsTextAndNothingElse) {
  EXPECT_EQ(idl::printable("state/engine_1.json: 'x' \xff\n\x7f"), "state/engine_1.json: 'x' ???");
}

}  // namespace
