// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/scenario/recorded_mission.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "deploy/runtime/files/csv_table.h"
#include "deploy/runtime/files/file_error.h"
#include "engine_sim/control/scheduled_point.h"
#include "engine_sim/model/parts/root_theta.h"
#include "engine_sim/model/thermo/atmosphere.h"
#include "engine_sim/model/thermo/ram.h"

namespace ehm::engine_sim {
namespace {

using files::CsvRow;
using files::CsvTable;

constexpr double metre_per_foot = 0.3048, m_s_per_knot = 1852.0 / 3600.0, kg_s_per_kg_h = 1.0 / 3600.0;
constexpr double point_s = 5.0, highest_mach = 0.9, taxi = 0.45, take_off = 1.02;
constexpr double full_bleed_mach = 0.5;  ///< below, the aircraft takes less air, none at rest

struct Column {
  const char* name;
  double factor;
};

/// One of several columns that tell the same in other units.
class Quantity {
 public:
  Quantity(const CsvTable& table, std::vector<Column> columns) : table_(table) {
    std::string names;
    for (const Column& column : columns) {
      names += (names.empty() ? "" : ", ") + std::string(column.name);
      if (const auto at = table.column(column.name); at && !found_) {
        found_ = true;
        at_ = *at;
        column_ = column;
      }
    }
    names_ = names;
  }
  const Quantity& required() const {
    if (!found_) throw files::FileError(table_.file + ": has no column " + names_ + "; one of them is needed");
    return *this;
  }
  bool is(const char* name) const { return found_ && std::string(column_.name) == name; }
  double of(const CsvRow& row) const {
    if (!found_) return 0.0;
    const auto value = files::parse_number(row.cells[at_]);
    if (!value)
      throw files::FileError(table_.place(row) + ": " + column_.name + " is " + files::in_quotes(row.cells[at_]) +
                             ", allowed is a number");
    return column_.factor * *value;
  }

 private:
  const CsvTable& table_;
  bool found_ = false;
  std::size_t at_ = 0;
  Column column_{"", 1.0};
  std::string names_;
};

struct Moment {
  double time_s, altitude_m, mach, delta_isa_k, power;  ///< power: rpm, or reduced fuel flow
};

/// Reduced fuel flow of an engine over corrected fan speed, at several Mach numbers.
class FuelLine {
 public:
  FuelLine(const EngineDefinition& engine, double design_n1_corrected_rpm) {
    const Turbofan turbofan(engine.data);
    for (std::size_t m = 0; m < machs.size(); ++m)
      for (const double share : shares) {
        const FlightCondition flight{machs[m] < 0.1 ? 0.0 : 5000.0, machs[m], 0.0};
        const RamRatios ram = ram_ratios(flight.altitude_m, flight.mach, flight.delta_isa_k);
        const double n1_rpm = share * design_n1_corrected_rpm * root_theta(engine.data.inlet, flight);
        const SteadyPoint point =
            solve_scheduled(turbofan, engine.control, {flight, {}, {}}, {DemandKind::n1_rpm, n1_rpm});
        reduced_[m].push_back(point.gas.fuel_flow_kg_s / (ram.delta * std::sqrt(ram.theta)));
      }
  }
  double take_off_flow() const { return reduced_.front().back(); }
  /// Share of the design point's corrected fan speed; taxi or take-off beyond the ends of the line.
  double share_at(double reduced_flow, double mach) const {
    const double at = std::clamp(mach, machs.front(), machs.back());
    const std::size_t m = at < machs[1] ? 0 : 1;
    const double between = (at - machs[m]) / (machs[m + 1] - machs[m]);
    return (1.0 - between) * on_line(m, reduced_flow) + between * on_line(m + 1, reduced_flow);
  }

 private:
  double on_line(std::size_t m, double flow) const {
    const std::vector<double>& line = reduced_[m];
    if (flow <= line.front()) return shares.front();
    const auto above = static_cast<std::size_t>(std::upper_bound(line.begin(), line.end(), flow) - line.begin());
    if (above >= line.size()) return shares.back();
    return shares[above - 1] +
           (shares[above] - shares[above - 1]) * (flow - line[above - 1]) / (line[above] - line[above - 1]);
  }

  static constexpr std::array machs{0.0, 0.4, 0.8};
  static constexpr std::array shares{taxi, 0.55, 0.65, 0.75, 0.85, 0.92, take_off};
  std::array<std::vector<double>, machs.size()> reduced_;
};

void require_flown(const CsvTable& table, const CsvRow& row, const Moment& m) {
  if (m.power < 0.0)
    throw files::FileError(table.place(row) + ": fan speed or fuel flow is " + files::shortest(m.power) +
                           ", allowed is 0 or more");
  if (!covers_altitude(m.altitude_m) || !covers_offset(m.delta_isa_k) || !(m.mach >= 0.0 && m.mach <= highest_mach))
    throw files::FileError(table.place(row) + ": altitude " + files::shortest(m.altitude_m) + " m, Mach " +
                           files::shortest(m.mach) + ", ISA " + files::shortest(m.delta_isa_k) +
                           " K; allowed are -1000 to 20000 m, Mach 0 to 0.9, -60 to 60 K");
}

std::vector<Moment> moments_of(const CsvTable& table, const MissionOptions& options, bool& by_fuel) {
  const Quantity time(table, {{"time_s", 1.0}}),
      altitude(table, {{"altitude_m", 1.0}, {"altitude_ft", metre_per_foot}, {"pressure_altitude_ft", metre_per_foot}}),
      speed(table, {{"mach", 1.0}, {"true_airspeed_m_s", 1.0}, {"true_airspeed_kt", m_s_per_knot}}),
      power(table, {{"n1_rpm", 1.0}, {"fuel_flow_kg_s", 1.0}, {"fuel_flow_kg_h", kg_s_per_kg_h}}),
      offset(table, {{"delta_isa_k", 1.0}});
  for (const Quantity* q : {&time, &altitude, &speed, &power}) static_cast<void>(q->required());
  by_fuel = !power.is("n1_rpm");
  std::vector<Moment> moments;
  for (const CsvRow& row : table.rows) {
    Moment m{time.of(row), altitude.of(row), speed.of(row), offset.of(row) + options.delta_isa_k, power.of(row)};
    if (!moments.empty() && m.time_s <= moments.back().time_s)
      throw files::FileError(table.place(row) + ": time_s is " + files::shortest(m.time_s) +
                             ", allowed is later than " + files::shortest(moments.back().time_s) +
                             ", as the row before");
    if (!speed.is("mach") && covers_altitude(m.altitude_m) && covers_offset(m.delta_isa_k)) {
      constexpr double gamma_r = 1.4 * 287.053;
      m.mach /= std::sqrt(gamma_r * atmosphere(m.altitude_m, m.delta_isa_k).t_k);
    }
    require_flown(table, row, m);
    moments.push_back(m);
  }
  if (moments.size() < 2) throw files::FileError(table.file + ": has one row, allowed are two or more");
  return moments;
}

/// Means of what lies within each five seconds, at their middle; the first moment as it is.
std::vector<Moment> thinned(const std::vector<Moment>& all) {
  std::vector<Moment> points{all.front()};
  for (std::size_t i = 1; i < all.size();) {
    Moment sum{};
    double n = 0.0;
    const double end_s = all[i].time_s + point_s;
    for (; i < all.size() && all[i].time_s < end_s; ++i, n += 1.0)
      sum = {sum.time_s + all[i].time_s, sum.altitude_m + all[i].altitude_m, sum.mach + all[i].mach,
             sum.delta_isa_k + all[i].delta_isa_k, sum.power + all[i].power};
    points.push_back({sum.time_s / n, sum.altitude_m / n, sum.mach / n, sum.delta_isa_k / n, sum.power / n});
  }
  return points;
}

}  // namespace

std::vector<ProfilePoint> recorded_mission(const std::string& file, const EngineDefinition& engine,
                                           const MissionOptions& options) {
  const CsvTable table = files::read_csv(file);
  bool by_fuel = false;
  std::vector<Moment> points = thinned(moments_of(table, options, by_fuel));
  const DesignPoint& design = engine.data.design;
  const double design_n1_corrected_rpm = design.speeds.n1_rpm / root_theta(engine.data.inlet, design.flight);
  if (by_fuel) {
    const FuelLine line(engine, design_n1_corrected_rpm);
    double greatest = 0.0;
    for (Moment& m : points) {
      const RamRatios ram = ram_ratios(m.altitude_m, m.mach, m.delta_isa_k);
      m.power /= ram.delta * std::sqrt(ram.theta);
      greatest = std::max(greatest, m.power);
    }
    if (!(greatest > 0.0)) throw files::FileError(file + ": no fuel is burnt in it");
    for (Moment& m : points)
      m.power = line.share_at(m.power / greatest * line.take_off_flow(), m.mach) * design_n1_corrected_rpm *
                root_theta(engine.data.inlet, {m.altitude_m, m.mach, m.delta_isa_k});
  }
  std::vector<ProfilePoint> profile;
  const double start_s = points.front().time_s;
  const Offtake taken{options.offtake * 1.0, options.offtake * 80e3};
  for (const Moment& m : points)
    profile.push_back({options.time_scale * (m.time_s - start_s),
                       {m.altitude_m, m.mach, m.delta_isa_k},
                       {DemandKind::n1_rpm, options.power * m.power},
                       {taken.customer_bleed_kg_s * std::min(1.0, m.mach / full_bleed_mach), taken.power_w}});
  return profile;
}

}  // namespace ehm::engine_sim
