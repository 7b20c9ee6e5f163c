// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/print/certificate_text.h"

#include <algorithm>
#include <iomanip>
#include <numbers>
#include <ostream>

#include "deploy/runtime/numbers/index.h"
#include "monitor/design/detectability.h"

namespace ehm::tuner_design {
namespace {

void print_starts(const design::Certificate& certificate, std::ostream& out) {
  if (certificate.starts.empty()) return;
  std::size_t width = 5;
  for (const auto& start : certificate.starts) width = std::max(width, start.name.size());
  out << "\n  " << std::left << std::setw(static_cast<int>(width)) << "start" << std::right << std::setw(13)
      << "J there" << std::setw(13) << "J reached" << std::setw(12) << "|gradient|" << std::setw(12) << "angle, deg"
      << std::setw(13) << "evaluations" << '\n';
  for (const auto& start : certificate.starts) {
    out << "  " << std::left << std::setw(static_cast<int>(width)) << start.name << std::right << std::setprecision(8)
        << std::setw(13) << start.first << std::setw(13) << start.last << std::setprecision(2) << std::setw(12)
        << start.gradient_norm << std::setw(12) << start.angle_rad * 180.0 / std::numbers::pi << std::setw(13)
        << start.evaluations << '\n';
  }
}

void print_points(const design::Certificate& certificate, std::ostream& out) {
  if (certificate.points.size() < 2) return;
  out << "\n  one V* for " << certificate.points.size() << " points; SSEE / limit\n";
  double sum = 0.0;
  for (const auto& point : certificate.points) {
    out << "    " << point.model << " (weight " << point.weight << "): health " << point.health_ratio << ", auxiliary "
        << point.auxiliary_ratio << '\n';
    sum += point.health_ratio + point.auxiliary_ratio;
  }
  out << "    mean of all ratios " << sum / (2.0 * static_cast<double>(certificate.points.size())) << '\n';
}

}  // namespace

void print_detectability(const linear_model::LinearModel& model, const Eigen::VectorXd& detectability,
                         std::ostream& out) {
  if (detectability.size() != as_index(model.sensors.size())) return;
  const auto precision = out.precision(3);
  out << "    slow bias of 5 sigma against deterioration, distance:";
  for (std::size_t i = 0; i < model.sensors.size(); ++i)
    out << ' ' << model.sensors[i].name << ' ' << detectability(as_index(i));
  out << " (told apart above " << design::least_detectability << ")\n"
      << std::setprecision(static_cast<int>(precision));
}

void print_certificate(const design::Certificate& certificate, std::ostream& out) {
  const auto precision = out.precision(6);
  out << "\n  Certificate: " << certificate.verdict << '\n'
      << "    objective J " << certificate.objective << ", of the closed form " << certificate.closed_form_objective
      << ", of the Bayes limits " << certificate.lower_bound
      << (certificate.limit_is_prior ? " (a limit vanishes; the fleet's own spread divides in its place)" : "") << '\n';
  if (certificate.largest_curvature > 0.0) {
    out << std::setprecision(2) << "    |dJ/dV| " << certificate.gradient_norm << ", gain of a Newton step "
        << certificate.possible_gain << ", curvature " << certificate.least_curvature << " to "
        << certificate.largest_curvature << '\n';
  }
  const Eigen::VectorXd& seen = certificate.steady_singular_values;
  out << std::setprecision(4) << "    what the sensors see, R^-1/2 H Ph^1/2: singular values " << seen(0) << " to "
      << seen(seen.size() - 1) << ", condition " << certificate.condition << "; of the pair "
      << certificate.pair_singular_values(0) << " to "
      << certificate.pair_singular_values(certificate.pair_singular_values.size() - 1) << '\n';
  out << std::setprecision(6);
  print_points(certificate, out);
  print_starts(certificate, out);
  out << std::setprecision(static_cast<int>(precision));
}

}  // namespace ehm::tuner_design
