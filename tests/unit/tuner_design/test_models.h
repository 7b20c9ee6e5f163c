// SPDX-License-Identifier: Apache-2.0
#pragma once
// Linear models for tests: one made up here, the JT9D at cruise from the repository's fixture, and the other reference
// engines, which need the reference data; all converted to LinearModel.

#include <cstdint>
#include <optional>
#include <random>
#include <string>

#include "engine_sim/linear_model/linear_model.h"

namespace ehm::test {

/// Uniform and normal numbers that are the same with every standard library.
class Random {
 public:
  explicit Random(std::uint64_t seed) : generator_(seed) {}
  double uniform(double low, double high);
  double normal();
  Eigen::VectorXd normal_vector(Eigen::Index size);
  Eigen::MatrixXd normal_matrix(Eigen::Index rows, Eigen::Index cols);

 private:
  std::mt19937_64 generator_;
};

/// Stable discrete engine with 2 states, 1 control, `health` and `sensors` as asked, auxiliary T40 (degR) and Fn (lbf).
/// Sensors 0 and 1 measure the states. Deterministic.
linear_model::LinearModel made_up_model(int sensors = 4, int health = 6);

/// JT9D at cruise with the settings of theory.md, section 5, from tests/unit/engine_sim/fixtures/jt9d_linear_points.json.
/// Temperatures in degR, pressures in psia, thrust in lbf.
linear_model::LinearModel jt9d_cruise();

/// Its points alt35000_MN0.8_PC100 (cruise), alt35000_MN0.8_PC80, alt0_MN0_PC100 from the reference data; nullopt where
/// they are absent.
std::optional<linear_model::LinearModel> jt9d_point(const std::string& name);

/// MAPSS military engine with the given sensors (all eleven if empty); nullopt where the reference data are absent.
std::optional<linear_model::LinearModel> mapss(const std::vector<int>& sensors = {});

inline constexpr const char* no_reference = "reference data absent: set EHM_REFERENCE_DIR to their folder";

/// A path in the test's own temporary folder.
std::string temporary_path(const std::string& name);

}  // namespace ehm::test
