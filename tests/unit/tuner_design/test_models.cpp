// SPDX-License-Identifier: Apache-2.0
#include "tests/unit/tuner_design/test_models.h"

#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numeric>

#include "deploy/runtime/numbers/index.h"

namespace ehm::test {
namespace {

using linear_model::LinearModel;
using Json = nlohmann::json;

std::optional<Json> reference(const std::string& name) {
  std::ifstream stream(std::string(EHM_REFERENCE_DIR) + "/" + name);
  if (!stream) return std::nullopt;
  return Json::parse(stream);
}

/// Lives as long as the test program.
struct TemporaryFolder {
  TemporaryFolder() { std::filesystem::create_directories(path); }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("ehm_test_" + std::to_string(::getpid()));
};

Eigen::MatrixXd matrix(const Json& rows) {
  Eigen::MatrixXd result(rows.size(), rows.at(0).size());
  for (Eigen::Index i = 0; i < result.rows(); ++i) {
    for (Eigen::Index j = 0; j < result.cols(); ++j) {
      result(i, j) = rows[as_size(i)][as_size(j)].get<double>();
    }
  }
  return result;
}

/// A point of a file of the reference data's form.
LinearModel jt9d_model(const Json& file, const std::string& name) {
  const Json& point = file.at("models").at(name);
  const Json& trim = point.at("trim");
  const auto channel = [&](const std::string& key, const std::string& unit) {
    return linear_model::Channel{key, unit, trim.at(key).get<double>()};
  };
  LinearModel model;
  model.name = name;
  model.discrete = false;
  model.sample_time_s = 0.015;
  model.states = {channel("Nf", "rpm"), channel("Nc", "rpm")};
  model.controls = {channel("Wf", "lbm/s")};
  for (const Json& health : file.at("health")) model.health.push_back({health.get<std::string>(), "fraction", 0.0});
  model.sensors = {channel("Nf", "rpm"),   channel("Nc", "rpm"),   channel("P24", "psia"), channel("T24", "degR"),
                   channel("P30", "psia"), channel("T30", "degR"), channel("T48", "degR")};
  model.auxiliary = {channel("T40", "degR"), channel("T50", "degR"), channel("Fn", "lbf"), channel("SmLPC", "percent")};
  for (const auto& [key, target] : {std::pair<const char*, Eigen::MatrixXd*>{"A", &model.A},
                                    {"B", &model.B},
                                    {"L", &model.L},
                                    {"C", &model.C},
                                    {"D", &model.D},
                                    {"M", &model.M},
                                    {"F", &model.F},
                                    {"G", &model.G},
                                    {"N", &model.N}}) {
    *target = matrix(point.at(key));
  }
  model.health_sigma = Eigen::VectorXd::Constant(10, 0.02);
  model.sensor_noise_sigma.resize(7);
  const double percent[] = {0.25, 0.25, 0.5, 0.75, 0.5, 0.75, 0.75};
  for (std::size_t i = 0; i < 7; ++i) {
    model.sensor_noise_sigma(as_index(i)) = percent[i] / 100.0 * model.sensors[i].trim;
  }
  // (0.01 % of trim)^2 a sample, that is 1e-4 percent^2
  model.process_noise = (1e-4 * Eigen::Vector2d(model.states[0].trim, model.states[1].trim)).cwiseAbs2().asDiagonal();
  return model;
}

}  // namespace

double Random::uniform(double low, double high) {
  return low + (high - low) * (static_cast<double>(generator_() >> 11U) + 0.5) * 0x1p-53;
}

double Random::normal() {
  return std::sqrt(-2.0 * std::log(uniform(0.0, 1.0))) * std::cos(2.0 * std::acos(-1.0) * uniform(0.0, 1.0));
}

Eigen::VectorXd Random::normal_vector(Eigen::Index size) {
  return normal_matrix(size, 1);
}

Eigen::MatrixXd Random::normal_matrix(Eigen::Index rows, Eigen::Index cols) {
  return Eigen::MatrixXd::NullaryExpr(rows, cols, [this] { return normal(); });
}

LinearModel made_up_model(int sensors, int health) {
  Random random(17);
  LinearModel model;
  model.name = "made up";
  model.sample_time_s = 0.015;
  model.states = {{"N1", "rpm", 3650.0}, {"N2", "rpm", 7370.0}};
  model.controls = {{"Wf", "kg/s", 0.8}};
  model.auxiliary = {{"T40", "degR", 2350.0}, {"Fn", "lbf", 10700.0}};
  for (int i = 0; i < health; ++i) model.health.push_back({"h" + std::to_string(i), "fraction", 0.0});
  for (int i = 0; i < sensors; ++i) model.sensors.push_back({"y" + std::to_string(i), "K", 500.0 + 100.0 * i});
  model.sensors[0] = {"N1", "rpm", 3650.0};
  if (sensors > 1) model.sensors[1] = {"N2", "rpm", 7370.0};
  const Eigen::Vector2d speed(36.5, 73.7);  // one percent
  Eigen::VectorXd one_percent(sensors);
  for (int i = 0; i < sensors; ++i) one_percent(i) = model.sensors[as_size(i)].trim / 100.0;
  model.A = (Eigen::Matrix2d() << 0.97, 0.013, 0.008, 0.93).finished();
  model.B = speed.asDiagonal() * Eigen::Vector2d(0.3, 0.25);
  model.L = speed.asDiagonal() * (2.0 * random.normal_matrix(2, health));
  model.C = one_percent.asDiagonal() * random.normal_matrix(sensors, 2) * speed.cwiseInverse().asDiagonal();
  model.D = one_percent.asDiagonal() * random.normal_matrix(sensors, 1);
  model.M = one_percent.asDiagonal() * (100.0 * random.normal_matrix(sensors, health));
  const Eigen::Index direct = std::min(2, sensors);
  model.C.topRows(direct) = Eigen::Matrix2d::Identity().topRows(direct);
  model.D.topRows(direct).setZero();
  model.M.topRows(direct).setZero();
  model.F = random.normal_matrix(2, 2);
  model.G = 100.0 * random.normal_matrix(2, 1);
  model.N = 1000.0 * random.normal_matrix(2, health);
  model.health_sigma = Eigen::VectorXd::Constant(health, 0.02);
  model.sensor_noise_sigma = 0.5 * one_percent;
  model.process_noise = (0.01 * speed).cwiseAbs2().asDiagonal();
  return model;
}

LinearModel jt9d_cruise() {
  const std::string path = std::string(EHM_SOURCE_DIR) + "/tests/unit/engine_sim/fixtures/jt9d_linear_points.json";
  std::ifstream stream(path);
  LinearModel model = jt9d_model(Json::parse(stream), "alt35000_MN0.8_PC100");
  model.name = "JT9D cruise reference";
  return model;
}

std::optional<LinearModel> jt9d_point(const std::string& name) {
  const std::optional<Json> file = reference("jt9d_linear_models.json");
  if (!file) return std::nullopt;
  return jt9d_model(*file, name);
}

std::optional<LinearModel> mapss(const std::vector<int>& chosen) {
  const std::optional<Json> file = reference("mapss_linear_model.json");
  if (!file) return std::nullopt;
  // Their names: B and D are the health columns, Bu and Du the actuators'; augmented rows of Bu belong to health.
  std::vector<int> sensors = chosen;
  if (sensors.empty()) {
    sensors.resize(11);
    std::iota(sensors.begin(), sensors.end(), 0);
  }
  LinearModel model;
  model.name = "MAPSS reference";
  model.sample_time_s = 0.04;  // the file does not say; only time constants depend on it
  for (int i = 0; i < 3; ++i) model.states.push_back({"x" + std::to_string(i), "-", 0.0});
  for (int i = 0; i < 3; ++i) model.controls.push_back({"u" + std::to_string(i), "-", 0.0});
  for (int i = 0; i < 8; ++i) model.health.push_back({"h" + std::to_string(i), "fraction", 0.0});
  for (const int i : sensors) model.sensors.push_back({"y" + std::to_string(i), "-", 0.0});
  model.A = matrix(file->at("A"));
  model.B = matrix(file->at("Bu")).topRows(3);
  model.L = matrix(file->at("B"));
  model.C = matrix(file->at("C"))(sensors, Eigen::all);
  model.D = matrix(file->at("Du"))(sensors, Eigen::all);
  model.M = matrix(file->at("D"))(sensors, Eigen::all);
  model.F.resize(0, 3);
  model.G.resize(0, 3);
  model.N.resize(0, 8);
  model.process_noise = matrix(file->at("Q")).topLeftCorner(3, 3);
  model.sensor_noise_sigma = Eigen::VectorXd(matrix(file->at("R")).diagonal())(sensors).cwiseSqrt();
  model.health_sigma = Eigen::VectorXd::Constant(8, 0.02);
  return model;
}

std::string temporary_path(const std::string& name) {
  static const TemporaryFolder folder;
  return (folder.path / name).string();
}

}  // namespace ehm::test
