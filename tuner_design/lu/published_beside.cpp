// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/lu/published_beside.h"

#include <cmath>

#include "deploy/runtime/numbers/index.h"

namespace ehm::tuner_design {
namespace {

/// Column of the paper: EKF, PF, cEKPF.
std::optional<std::size_t> published_column(LuFilter filter) {
  switch (filter) {
    case LuFilter::extended:
      return 0;
    case LuFilter::particle:
      return 1;
    case LuFilter::boxed_particle:
      return 2;
    default:
      return std::nullopt;
  }
}

}  // namespace

std::string filter_name(const LuCase& c) {
  return std::string(lu_filter_names[as_size(static_cast<int>(c.flight.filter))]);
}

double sum_of_means(const published::Lu& p) {
  double sum = 0.0;
  for (const double m : p.mean) sum += std::abs(m);
  return sum;
}

const published::Lu* published_parameters(const LuStudy& s, const LuCase& c) {
  const auto column = published_column(c.flight.filter);
  if (!column || s.options.table > 5 || c.flight.ratio_weights || c.flight.noise == NoiseDistribution::rayleigh)
    return nullptr;
  const published::LuTable& table = s.options.table == 4 ? published::table_4 : published::table_5;
  return &table[as_size(c.flight.fault - 1)][*column];
}

std::optional<double> published_figure(const LuStudy& s, std::size_t index) {
  const LuCase& c = s.cases[index];
  const auto column = published_column(c.flight.filter);
  switch (s.options.table) {
    case 6:
      if (column && c.flight.noise != NoiseDistribution::rayleigh)
        return published::table_6[c.flight.noise == NoiseDistribution::gaussian ? 0 : 1][*column];
      return std::nullopt;
    case 7:
      return column && !c.flight.own_jacobian ? std::optional(published::table_7[as_size(c.flight.fault - 1)][*column])
                                              : std::nullopt;
    case 8:
      if (c.flight.filter == LuFilter::extended_particle) return published::table_8_ekpf[*c.flight.missing_sensor];
      return column && *column == 2 ? std::optional(published::table_8_cekpf[*c.flight.missing_sensor]) : std::nullopt;
    case 9:
      return published::table_9_sme[index / 3][index % 3];
    default:
      return std::nullopt;
  }
}

}  // namespace ehm::tuner_design
