#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "engine_sim/model/engines/jt9d.h"
#include "engine_sim/model/maps/compressor_table.h"
#include "engine_sim/model/maps/fit_surface.h"
#include "engine_sim/model/spline.h"

namespace ehm::engine {
namespace {

std::vector<double> grid(double from, double to, int count) {
  std::vector<double> g;
  for (int i = 0; i < count; ++i) g.push_back(from + (to - from) * i / (count - 1));
  return g;
}

TEST(FitSurface, ReproducesACubicAndFillsAHoleOfZeroWeight) {
  const std::vector<double> x = grid(0.0, 2.0, 11), y = grid(-1.0, 1.0, 9), breaks_x{0.0, 1.0, 2.0},
                            breaks_y{-1.0, 0.0, 1.0};
  const auto f = [](double u, double v) { return 1.0 + u * v - 0.5 * u * u + 0.3 * v * v; };
  Eigen::MatrixXd z(11, 9), weight = Eigen::MatrixXd::Ones(11, 9);
  for (int i = 0; i < 11; ++i) {
    for (int j = 0; j < 9; ++j) z(i, j) = f(x[static_cast<std::size_t>(i)], y[static_cast<std::size_t>(j)]);
  }
  z(5, 4) = 1e6;
  weight(5, 4) = 0.0;
  const std::vector<double> c = fit_surface(x, y, z, weight, breaks_x, breaks_y, 0.0);
  const SplineBasis bx(breaks_x), by(breaks_y);
  for (double u = 0.0; u <= 2.0; u += 0.13) {
    EXPECT_NEAR(surface(bx.at(u), by.at(0.07), c, by.size()).f, f(u, 0.07), 1e-9);
  }
}

TEST(FitSurface, RefusesMoreBreakPointsThanTheSamplesCarry) {
  const std::vector<double> x = grid(0.0, 1.0, 4), breaks = grid(0.0, 1.0, 8);
  const Eigen::MatrixXd z = Eigen::MatrixXd::Zero(4, 4), w = Eigen::MatrixXd::Ones(4, 4);
  EXPECT_THROW(fit_surface(x, x, z, w, breaks, breaks, 0.0), std::runtime_error);
  EXPECT_THROW(fit_surface(x, grid(0.0, 1.0, 5), z, w, x, x, 0.0), std::invalid_argument);
}

TEST(FittedMaps, AgreeWithTheTablesWhereEnginesOperate) {
  const std::string path = std::string(EHM_REFERENCE_DIR) + "/jt9d_maps.json";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "reference data is absent: set EHM_REFERENCE_DIR";
  std::ifstream in(path);
  const nlohmann::json maps = nlohmann::json::parse(in);
  const std::pair<const char*, const CompressorMap*> fitted[] = {
      {"Fan", &jt9d().fan.map}, {"LPC", &jt9d().lpc.map}, {"HPC", &jt9d().hpc.map}};
  for (const auto& [name, map] : fitted) {
    const CompressorTable table = read_compressor_table(maps.at(name));
    for (std::size_t i = 0; i < table.speed.size(); ++i) {
      for (std::size_t j = 0; j < table.r_line.size(); ++j) {
        const auto row = static_cast<Eigen::Index>(i), column = static_cast<Eigen::Index>(j);
        const double pr = table.pressure_ratio(row, column), eff = table.efficiency(row, column);
        if (sample_weight(table.r_line[j], pr, eff) < 1.0) continue;
        const auto at = map->at(table.speed[i], table.r_line[j]);
        EXPECT_NEAR(at.flow / table.flow(row, column), 1.0, 5e-3) << name << " " << table.speed[i];
        EXPECT_NEAR(at.pressure_ratio / pr, 1.0, 5e-3) << name << " " << table.speed[i];
        EXPECT_NEAR(at.efficiency, eff, 5e-3) << name << " " << table.speed[i];
      }
    }
  }
}

}  // namespace
}  // namespace ehm::engine
