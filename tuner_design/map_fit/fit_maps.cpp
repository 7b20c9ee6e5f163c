// fit_maps MAPS.json OUT.cpp: fits the smooth maps of compressor_map.h and turbine_map.h to tables on (speed, R-line)
// and (speed, expansion ratio), writes them as one source file and prints the deviation from the tables. Weights and
// the continuation beyond the tables: compressor_table.h.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "engine_sim/model/compressor_map.h"
#include "engine_sim/model/turbine_map.h"
#include "tuner_design/map_fit/compressor_table.h"
#include "tuner_design/map_fit/fit_surface.h"

namespace {

using ehm::bench::CompressorTable;
using ehm::bench::CompressorTarget;
using ehm::bench::Corner;
using ehm::bench::fit_curve;
using ehm::bench::fit_surface;
using ehm::bench::StraightPath;
using Table = Eigen::MatrixXd;
using Numbers = std::vector<double>;

struct CompressorSettings {
  std::string name;  ///< in the JSON file
  double flow_exponent, pressure_exponent;
  Numbers speed_breaks, r_line_breaks, surge_flow_breaks;
  std::optional<Corner> corner;             ///< a bend of the table to be moved
  StraightPath flow_wear, efficiency_wear;  ///< where the surfaces are kept straight
};
struct TurbineSettings {
  std::string name;
  double choking_rate;
  Numbers speed_breaks, pressure_ratio_breaks;
};

constexpr double smoothing = 1e-6;

/// From the fan's leftmost working line towards choke, the way on which a loss of flow capacity of 2 % moves it: 0.14
/// to 0.28 in R, 0.07 in n for each unit of R. Straight there, its slopes predict such a loss; the table's curvature of
/// flow and efficiency is spread over the neighbourhood (0.5 %, 0.5 points).
StraightPath fan_wear(double weight) {
  constexpr double speed_by_r_line = 0.07, step = 0.05, reach = 0.35;
  StraightPath path{{}, speed_by_r_line * step, step, weight};
  for (int i = 0; i <= 14; ++i) {
    const double n = 0.86 + 0.01 * i;
    const double r_line = 1.95 + (2.36 - 1.95) * std::max(0.0, (n - 0.94) / (1.0 - 0.94));
    for (int k = 0; k <= 4; ++k) {
      const double along = 0.25 * k * reach;
      path.points.emplace_back(n + speed_by_r_line * along, r_line + along);
    }
  }
  return path;
}

// Break points lie closer where the engine operates between idle and maximum.
const CompressorSettings compressors[] = {
    {"Fan",
     1.0,
     2.2,
     {0.05, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95, 1.0, 1.05, 1.15, 1.34},
     {1.0, 1.4, 1.8, 2.0, 2.2, 2.4, 2.6, 3.2, 4.0},
     {1129.0825, 1636.0, 2049.0, 2562.0, 2954.0, 3275.6797},
     {},
     fan_wear(0.1),
     fan_wear(0.08)},
    {"LPC",
     1.05,
     2.05,
     {0.03, 0.3, 0.4, 0.5, 0.7, 0.8, 0.9, 1.0, 1.1, 1.25, 1.45},
     {1.0, 1.4, 1.6, 1.8, 2.0, 2.2, 2.4, 2.6, 3.2, 4.0},
     {38.0744, 87.0, 125.0, 165.0, 227.8569},
     {},
     {},
     {}},
    {"HPC",
     1.6,
     2.8,
     {0.05, 0.5, 0.6, 0.7, 0.8, 0.85, 0.9, 0.925, 0.95, 0.975, 1.0, 1.01, 1.02, 1.035, 1.05, 1.224},
     {1.0, 1.4, 1.8, 2.0, 2.2, 2.4, 2.6, 3.0, 3.8},
     {22.7411, 56.0, 89.0, 138.0, 181.0, 202.0, 216.6847},
     // dWc/dn falls from 740 to 246 at n = 1, and the engine cruises at 0.994 to 1: the reference's dynamics are those
     // of the steep side, and the slopes predict a wear of 2 % (n up to 1.007) if it reaches a little beyond n = 1
     Corner{1.0, 1.008},
     {},
     {}}};
const TurbineSettings turbines[] = {
    {"HPT", 3.0, {60.0, 80.0, 90.0, 100.0, 110.0}, {3.0, 3.5, 4.0, 4.5, 5.0, 5.5, 6.0, 6.5, 8.0}},
    {"LPT", 3.0, {60.0, 80.0, 90.0, 100.0, 110.0, 120.0}, {3.0, 3.5, 4.0, 4.5, 5.0, 5.5, 6.0, 6.5, 8.0}}};

/// Largest and rms deviation of the samples of full weight.
struct Deviation {
  double sum = 0.0, largest = 0.0;
  int count = 0;
  void add(double d) {
    sum += d * d;
    largest = std::max(largest, std::abs(d));
    ++count;
  }
  std::string text() const {
    std::ostringstream out;
    out.precision(3);
    out << "rms " << std::sqrt(sum / std::max(count, 1)) << " max " << largest;
    return out.str();
  }
};

void write_array(std::ostream& out, const std::string& name, const Numbers& numbers) {
  out << "constexpr double " << name << "[] = {";
  for (std::size_t i = 0; i < numbers.size(); ++i) out << (i % 10 == 0 ? "\n    " : " ") << numbers[i] << ",";
  out << "};\n";
}

std::string lower(std::string s) {
  std::transform(s.begin(), s.end(), s.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return s;
}

struct CompressorFit {
  Numbers flow, pressure, efficiency, surge;
};

CompressorFit fit_compressor(const CompressorSettings& s, const CompressorTable& table) {
  const CompressorTarget t = ehm::bench::fit_target(s.corner ? ehm::bench::move_corner(table, *s.corner) : table,
                                                    s.flow_exponent, s.pressure_exponent);
  const double size = t.phi.mean();
  CompressorFit fit;
  StraightPath flow_wear = s.flow_wear;
  flow_wear.weight /= size;
  fit.flow = fit_surface(t.speed, t.r_line, t.phi, t.flow_weight, s.speed_breaks, s.r_line_breaks,
                         smoothing / (size * size), flow_wear);
  fit.pressure = fit_surface(t.speed, t.r_line, t.psi, t.pressure_weight, s.speed_breaks, s.r_line_breaks, smoothing);
  fit.efficiency = fit_surface(t.speed, t.r_line, t.efficiency, t.efficiency_weight, s.speed_breaks, s.r_line_breaks,
                               smoothing, s.efficiency_wear);
  const Eigen::VectorXd surge_flow = table.flow.col(0), surge_pressure = table.pressure_ratio.col(0);
  fit.surge = fit_curve(Numbers(surge_flow.begin(), surge_flow.end()),
                        Numbers(surge_pressure.begin(), surge_pressure.end()), s.surge_flow_breaks, smoothing);
  return fit;
}

void write_compressor(std::ostream& out, const CompressorSettings& s, const nlohmann::json& map) {
  const CompressorTable table = ehm::bench::read_compressor_table(map);
  const Numbers &n = table.speed, &r = table.r_line;
  const Table &wc = table.flow, &pr = table.pressure_ratio, &eff = table.efficiency;
  const CompressorFit fit = fit_compressor(s, table);

  const ehm::engine::CompressorMap fitted({s.flow_exponent, s.pressure_exponent, s.speed_breaks, s.r_line_breaks,
                                           fit.flow, fit.pressure, fit.efficiency, s.surge_flow_breaks, fit.surge,
                                           r.back()});
  Deviation flow, pressure, efficiency, surge;
  for (Eigen::Index i = 0; i < wc.rows(); ++i) {
    surge.add(100.0 * (fitted.surge_pressure_ratio(wc(i, 0)) / pr(i, 0) - 1.0));
    for (Eigen::Index j = 0; j < wc.cols(); ++j) {
      const double r_line = r[static_cast<std::size_t>(j)];
      if (ehm::bench::sample_weight(r_line, pr(i, j), eff(i, j)) < 1.0) continue;
      const auto at = fitted.at(n[static_cast<std::size_t>(i)], r_line);
      flow.add(100.0 * (at.flow / wc(i, j) - 1.0));
      pressure.add(100.0 * (at.pressure_ratio / pr(i, j) - 1.0));
      efficiency.add(100.0 * (at.efficiency - eff(i, j)));
    }
  }
  const std::string report = s.name + ": flow " + flow.text() + " %, PR " + pressure.text() + " %, efficiency " +
                             efficiency.text() + " points, surge PR " + surge.text() + " %";
  std::cout << report << "\n";
  const std::string prefix = lower(s.name) + "_";
  out << "\n// " << report << "\n";
  write_array(out, prefix + "speed_breaks", s.speed_breaks);
  write_array(out, prefix + "r_line_breaks", s.r_line_breaks);
  write_array(out, prefix + "flow", fit.flow);
  write_array(out, prefix + "pressure", fit.pressure);
  write_array(out, prefix + "efficiency", fit.efficiency);
  write_array(out, prefix + "surge_flow_breaks", s.surge_flow_breaks);
  write_array(out, prefix + "surge_pressure_ratio", fit.surge);
  out << "constexpr double " << prefix << "last_r_line = " << r.back() << ";\n";
}

void write_turbine(std::ostream& out, const TurbineSettings& s, const nlohmann::json& map) {
  const Numbers n = map.at("NcVec").at(0), p = map.at("PRVec").at(0);
  const Table wp = ehm::bench::read_rows(map.at("WcArray")), eff = ehm::bench::read_rows(map.at("EffArray"));
  Table g = wp;
  for (Eigen::Index i = 0; i < wp.rows(); ++i) {
    for (Eigen::Index j = 0; j < wp.cols(); ++j) {
      g(i, j) /= std::sqrt(1.0 - std::exp(-s.choking_rate * (p[static_cast<std::size_t>(j)] - 1.0)));
    }
  }
  const Table ones = Table::Ones(wp.rows(), wp.cols());
  const Numbers flow =
      fit_surface(n, p, g, ones / g.mean(), s.speed_breaks, s.pressure_ratio_breaks, smoothing / (g.mean() * g.mean()));
  const Numbers efficiency = fit_surface(n, p, eff, ones, s.speed_breaks, s.pressure_ratio_breaks, smoothing);

  const ehm::engine::TurbineMap fitted({s.choking_rate, s.speed_breaks, s.pressure_ratio_breaks, flow, efficiency});
  Deviation flow_deviation, efficiency_deviation;
  for (Eigen::Index i = 0; i < wp.rows(); ++i) {
    for (Eigen::Index j = 0; j < wp.cols(); ++j) {
      const auto at = fitted.at(n[static_cast<std::size_t>(i)], p[static_cast<std::size_t>(j)]);
      flow_deviation.add(100.0 * (at.flow / wp(i, j) - 1.0));
      efficiency_deviation.add(100.0 * (at.efficiency - eff(i, j)));
    }
  }
  const std::string report =
      s.name + ": flow " + flow_deviation.text() + " %, efficiency " + efficiency_deviation.text() + " points";
  std::cout << report << "\n";
  const std::string prefix = lower(s.name) + "_";
  out << "\n// " << report << "\n";
  write_array(out, prefix + "speed_breaks", s.speed_breaks);
  write_array(out, prefix + "pressure_ratio_breaks", s.pressure_ratio_breaks);
  write_array(out, prefix + "flow", flow);
  write_array(out, prefix + "efficiency", efficiency);
}

void write_accessors(std::ostream& out) {
  out << "\n}  // namespace\n";
  for (const auto& s : compressors) {
    const std::string m = lower(s.name);
    out << "\nCompressorMapData " << m << "() {\n  return {" << s.flow_exponent << ", " << s.pressure_exponent << ", "
        << m << "_speed_breaks, " << m << "_r_line_breaks, " << m << "_flow, " << m << "_pressure,\n          " << m
        << "_efficiency, " << m << "_surge_flow_breaks, " << m << "_surge_pressure_ratio, " << m
        << "_last_r_line};\n}\n";
  }
  for (const auto& s : turbines) {
    const std::string m = lower(s.name);
    out << "\nTurbineMapData " << m << "() {\n  return {" << s.choking_rate << ", " << m << "_speed_breaks, " << m
        << "_pressure_ratio_breaks, " << m << "_flow, " << m << "_efficiency};\n}\n";
  }
  out << "\n}  // namespace ehm::engine::jt9d_maps\n";
}

void run(const std::string& maps_path, const std::string& out_path) {
  std::ifstream in(maps_path);
  if (!in) throw std::runtime_error(maps_path + ": cannot be read; give the path of the map tables (JSON)");
  const nlohmann::json maps = nlohmann::json::parse(in);
  std::ostringstream out;
  out.precision(9);
  out << "// Generated by fit_maps (tuner_design/map_fit/fit_maps.cpp) from the tables of the public JT9D model of\n"
         "// nasa/T-MATS (Apache-2.0), file jt9d_maps.json. Do not edit: change the break points there and run it "
         "again.\n"
         "// Penalised least squares, cubic B-splines; deviations are those of the samples of full weight.\n"
         "// clang-format off\n"
         "#include \"engine_sim/model/maps/jt9d_maps.h\"\n\nnamespace ehm::engine::jt9d_maps {\nnamespace {\n";
  for (const auto& s : compressors) write_compressor(out, s, maps.at(s.name));
  for (const auto& s : turbines) write_turbine(out, s, maps.at(s.name));
  write_accessors(out);
  std::ofstream file(out_path);
  if (!(file << out.str()).flush()) throw std::runtime_error(out_path + ": cannot be written");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: fit_maps MAPS.json OUT.cpp\n";
    return 2;
  }
  try {
    run(argv[1], argv[2]);
  } catch (const std::exception& e) {
    std::cerr << "fit_maps: " << e.what() << "\n";
    return 1;
  }
  return 0;
}
