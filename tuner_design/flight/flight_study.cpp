// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/flight/flight_study.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "deploy/runtime/long_work/parallel_for.h"

namespace ehm::tuner_design {
namespace {

std::shared_ptr<const onboard::OnBoardModel> model_of(const FlightStudyOptions& options) {
  onboard::OnBoardOptions onboard = options.onboard;
  onboard.sample_time_s = options.step_s;
  return std::make_shared<const onboard::OnBoardModel>(flown_engine(*options.engine, options.step_s), onboard);
}

double coverage(const std::vector<ChannelScore>& scores, std::size_t channel) {
  const ChannelScore& s = scores[channel];
  return s.judged == 0 ? 0.0 : static_cast<double>(s.covered) / static_cast<double>(s.judged);
}

void add(const std::vector<ChannelScore>& from, std::vector<ChannelScore>& to) {
  to.resize(from.size());
  for (std::size_t i = 0; i < from.size(); ++i) {
    to[i].judged += from[i].judged;
    to[i].covered += from[i].covered;
  }
}

void add_finding(const Finding& finding, bool happened, Findings& all) {
  all.false_alarms += finding.false_alarms;
  if (!happened) return;
  ++all.happened;
  if (!finding.found_after_s) return;
  ++all.found;
  all.named += finding.named;
  all.delay_s += *finding.found_after_s;
}

void take_means(double flights, Findings& all) {
  all.false_alarms /= flights;
  if (all.found > 0) all.delay_s /= static_cast<double>(all.found);
}

}  // namespace

FleetResult fly_fleet(const FlightStudyOptions& options, const std::function<void(double)>& progress) {
  const auto model = model_of(options);
  std::vector<std::optional<FlightOutcome>> outcomes(options.engines);
  std::vector<std::string> why(options.engines);
  long_work::parallel_for(
      options.engines, options.threads,
      [&](std::size_t i) {
        try {
          outcomes[i] = fly(options, model, i);
        } catch (const std::exception& e) {
          why[i] = e.what();
        }
      },
      [&](std::size_t done) { progress(static_cast<double>(done) / static_cast<double>(options.engines)); });

  FleetResult r;
  std::vector<ChannelScore> health, steady, slam;
  double samples = 0, estimated = 0;
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    if (!outcomes[i]) {
      r.failed.push_back({i, why[i]});
      continue;
    }
    const FlightOutcome& o = *outcomes[i];
    ++r.flown;
    samples += o.samples;
    estimated += o.estimated;
    r.ssee_700 += o.ssee_700;
    r.claim_700 += o.claim_700;
    r.ssee_landing += o.ssee_landing;
    r.claim_landing += o.claim_landing;
    r.worst_landing = std::max(r.worst_landing, o.ssee_landing);
    add_finding(o.step, options.draw.step.has_value(), r.steps);
    add_finding(o.bias, options.draw.bias.has_value(), r.biases);
    add(o.health, health);
    add(o.steady, steady);
    add(o.slam, slam);
  }
  if (r.flown == 0) return r;
  const double n = static_cast<double>(r.flown);
  for (double* mean : {&r.ssee_700, &r.claim_700, &r.ssee_landing, &r.claim_landing}) *mean /= n;
  take_means(n, r.steps);
  take_means(n, r.biases);
  r.estimated = estimated / samples;
  r.worst_health_coverage = 1.0;
  for (std::size_t i = 0; i < health.size(); ++i) {
    r.health_coverage_by_channel.push_back(coverage(health, i));
    r.health_coverage += coverage(health, i) / static_cast<double>(health.size());
    r.worst_health_coverage = std::min(r.worst_health_coverage, coverage(health, i));
  }
  for (std::size_t i = 0; i < steady.size(); ++i) {
    r.steady_coverage.push_back(coverage(steady, i));
    r.slam_coverage.push_back(coverage(slam, i));
  }
  return r;
}

}  // namespace ehm::tuner_design
