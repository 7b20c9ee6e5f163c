// SPDX-License-Identifier: Apache-2.0
#include "monitor/checks/condition_check.h"

#include <cmath>
#include <limits>

#include "deploy/runtime/numbers/index.h"
#include "monitor/checks/actuator_reach.h"

namespace ehm::monitor {

namespace {

/// What a word can do in no time, and in a second.
struct Agility {
  double jump, slew_per_s;
};

constexpr double farthest_jumps = 1000.0;
constexpr double anywhere = std::numeric_limits<double>::infinity();  ///< of a flight condition validity decides
constexpr Agility altitude{100.0, 150.0}, mach{0.03, 0.1}, delta_isa{5.0, 2.0};

/// `reach` stands for a trim of 0.
Agility agility(const linear_model::Channel& actuator, double reach) {
  if (actuator.unit == "deg") return {3.0, 60.0};
  if (actuator.unit == "fraction") return {0.03, 1.0};
  const double size = actuator.trim == 0.0 ? reach : std::abs(actuator.trim);
  return {0.1 * size, size};
}

}  // namespace

WordCheck::State WordCheck::take(double word, int steps) noexcept {
  since_good_ += steps;
  if (!std::isfinite(word) || std::abs(word - centre_) > farthest_) {
    candidate_run_ = 0;
    return doubt();
  }
  if (!has_good_ || near(word, good_, since_good_)) return believe(word, State::good);
  if (has_before_ && near(word, before_, good_run_ + since_good_)) return believe(word, State::good);
  candidate_run_ = candidate_run_ > 0 && near(word, candidate_, steps) ? candidate_run_ + 1 : 1;
  candidate_ = word;
  if (candidate_run_ <= bridge_) return doubt();
  before_ = good_;
  has_before_ = good_run_ > bridge_;  // what was good for a moment only is no place to return to
  good_run_ = 0;
  return believe(word, State::moved);
}

bool WordCheck::near(double word, double other, std::int64_t samples) const noexcept {
  return std::abs(word - other) <= jump_ + slew_ * static_cast<double>(samples);
}

WordCheck::State WordCheck::believe(double word, State state) noexcept {
  good_ = word;
  has_good_ = true;
  bad_run_ = candidate_run_ = since_good_ = 0;
  if (++good_run_ >= requalify_) has_before_ = false;
  return state;
}

WordCheck::State WordCheck::doubt() noexcept {
  ++bad_run_;
  if (has_good_ && bad_run_ <= bridge_) return State::held;
  good_run_ = 0;
  return State::lost;
}

void WordCheck::reset() noexcept {
  has_good_ = has_before_ = false;
  good_run_ = bad_run_ = candidate_run_ = since_good_ = 0;
}

ConditionCheck::ConditionCheck(const CheckOptions& options, const linear_model::LinearModel& model)
    : fault_(flight_words + model.controls.size()) {
  const auto add = [&](const Agility& a, double otherwise, double farthest) {
    words_.emplace_back(a.jump, a.slew_per_s * model.sample_time_s, otherwise, farthest, options);
    otherwise_.push_back(otherwise);
  };
  const auto point = model.operating_point.value_or(linear_model::OperatingPoint{});
  add(altitude, point.altitude_m, anywhere);
  add(mach, point.mach, anywhere);
  add(delta_isa, point.delta_isa_k, anywhere);
  const Eigen::VectorXd reach = actuator_reach(model);
  for (std::size_t i = 0; i < model.controls.size(); ++i) {
    const Agility a = agility(model.controls[i], reach(as_index(i)));
    add(a, model.controls[i].trim, farthest_jumps * a.jump);
  }
}

bool ConditionCheck::mend(Sample& sample, int steps, EventList& events) noexcept {
  replaced_ = 0;
  bool usable = mend(0, sample.flight.altitude_m, steps, events);
  usable &= mend(1, sample.flight.mach, steps, events);
  usable &= mend(2, sample.flight.delta_isa_k, steps, events);
  for (std::size_t i = flight_words; i < words_.size(); ++i)
    usable &= mend(i, sample.actuator[i - flight_words], steps, events);
  return usable;
}

bool ConditionCheck::mend(std::size_t word, double& value, int steps, EventList& events) noexcept {
  WordCheck& check = words_[word];
  const double came = value, good = check.value(otherwise_[word]);
  const WordCheck::State state = check.take(value, steps);
  value = check.value(otherwise_[word]);
  const bool bad = state == WordCheck::State::held || state == WordCheck::State::lost;
  replaced_ += bad;
  const bool begins = state == WordCheck::State::moved || state == WordCheck::State::lost;
  const auto detail = static_cast<std::uint32_t>(state == WordCheck::State::lost);
  if (begins || check.steady())
    fault_[word].set(begins,
                     {.kind = idl::EventKind::condition_fault,
                      .channel = static_cast<std::uint32_t>(word),
                      .raised = begins,
                      .value = came,
                      .threshold = good,
                      .detail = detail},
                     events);
  return state != WordCheck::State::lost;
}

void ConditionCheck::reset(EventList& events) noexcept {
  for (std::size_t i = 0; i < words_.size(); ++i) {
    words_[i].reset();
    fault_[i].set(false, {.kind = idl::EventKind::condition_fault, .channel = static_cast<std::uint32_t>(i)}, events);
  }
}

}  // namespace ehm::monitor
