// SPDX-License-Identifier: Apache-2.0
// A folder of CSV files: what may be left out, and every mistake with its file and line.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "deploy/runtime/files/file_error.h"
#include "tests/temporary_folder.h"
#include "tests/unit/tuner_design/model_files.h"
#include "tests/unit/tuner_design/test_models.h"
#include "tuner_design/import/import_model.h"

namespace ehm::tuner_design {
namespace {

using ::testing::Contains;
using ::testing::IsEmpty;

class ImportCsv : public testing::Test {
 protected:
  /// One state, two sensors, two health parameters.
  ImportCsv() {
    folder_.file("A.csv", "0.9\n");
    folder_.file("L.csv", "0.1, -0.2\n");
    folder_.file("C.csv", "1\r\n0.5\r\n");
    folder_.file("M.csv", "0,0\n0.7,+1e-1\n");
    folder_.file("settings.csv", "key,value\nTs,0.02\n");
  }
  std::string refusal(const std::string& name, const std::string& text) {
    folder_.file(name, text);
    try {
      import_model(folder_.path(), {});
    } catch (const files::FileError& error) {
      const std::string message = error.what();
      EXPECT_TRUE(message.starts_with(folder_.path())) << message;
      return message.substr(folder_.path().size());
    }
    return "accepted";
  }
  test::TemporaryFolder folder_;
};

TEST_F(ImportCsv, AFullModelIsReadToTheLastBit) {
  const linear_model::LinearModel model = test::made_up_model();
  test::write_csv_folder(folder_.path("full"), model);
  const ImportedModel imported = import_model(folder_.path("full"), {});
  EXPECT_THAT(imported.assumed, IsEmpty());
  EXPECT_EQ(imported.model.M, model.M);
  EXPECT_EQ(imported.model.process_noise, model.process_noise);
  EXPECT_EQ(imported.model.sensor_noise_sigma, model.sensor_noise_sigma);
  EXPECT_EQ(imported.model.auxiliary[1].trim, model.auxiliary[1].trim);
}

TEST_F(ImportCsv, MatricesAloneAreInPercent) {
  const ImportedModel imported = import_model(folder_.path(), {});
  EXPECT_EQ(imported.model.M(1, 1), 0.1);
  EXPECT_EQ(imported.model.sensors[0].unit, "percent");
  EXPECT_EQ(imported.model.health_sigma, Eigen::Vector2d(2.0, 2.0));
}

TEST_F(ImportCsv, EmptyCellsAreNotStatedAndOtherFilesIgnored) {
  folder_.file("channels.csv", "kind,name,unit,trim,sigma\nsensor,T3,K,700,\nsensor,,,,0.4\nstate,N1,rpm,3650,\n");
  folder_.file("B.csv", "");
  folder_.file("notes.txt", "");
  const ImportedModel imported = import_model(folder_.path(), {});
  EXPECT_EQ(imported.model.sensors[0].name, "T3");
  EXPECT_EQ(imported.model.sensors[1].name, "y2");
  EXPECT_EQ(imported.model.sensor_noise_sigma, Eigen::Vector2d(3.5, 0.4)) << "0.5 % of 700 K is assumed";
  EXPECT_THAT(imported.assumed,
              Contains("T3: noise sigma 0.5 % of trim, since sensor_noise_sigma is not stated (--sensor-noise)"));
  EXPECT_THAT(imported.assumed, Contains("not part of a model, ignored: notes.txt"));
}

TEST_F(ImportCsv, ResolutionCountsInTheNoise) {
  folder_.file("channels.csv", "kind,name,unit,trim,sigma,resolution\nsensor,T3,K,700,3,2\nsensor,,,,0.4,\n");
  const ImportedModel imported = import_model(folder_.path(), {});
  EXPECT_DOUBLE_EQ(imported.model.sensor_noise_sigma(0), std::sqrt(9.0 + 4.0 / 12.0));
  EXPECT_EQ(imported.model.sensor_noise_sigma(1), 0.4);
  EXPECT_EQ(imported.model.sensor_resolution, Eigen::Vector2d(2.0, 0.0));
}

TEST_F(ImportCsv, MistakesAreNamedByFileAndLine) {
  EXPECT_EQ(refusal("M.csv", "0,0\n0.7,nan\n"),
            "/M.csv:2: column 2 is 'nan'; allowed: a finite number, point as decimal sign, commas between numbers.");
  EXPECT_THAT(refusal("M.csv", "0,0\n0.7\n"),
              testing::HasSubstr("/M.csv:2: 1 cells found, 2 expected, as many as the first row has"));
  EXPECT_THAT(refusal("M.csv", "0.25,0.15\n0.75,0.1"), testing::HasSubstr("/M.csv:2: the last line has no newline"));
  EXPECT_THAT(
      refusal("M.csv", "0,25,0,05\n0,75,0,10\n"),
      testing::HasSubstr("/M.csv:1: column 4 is '05'; allowed: a number without leading zeros; is it torn off"));
  EXPECT_EQ(refusal("M.csv", "0;0\n0.7;1\n"),
            "/M.csv:1: column 1 is '0;0'; allowed: a finite number, point as decimal sign, commas between numbers.");
  folder_.file("M.csv", "0,0\n0.7,0.1\n");
  EXPECT_EQ(refusal("settings.csv", "key,value\nts,0.02\n"),
            "/settings.csv:2: key is 'ts'; allowed: Ts, sample_time_s, name, engine_type, altitude_m, mach, "
            "delta_isa_k.");
  EXPECT_EQ(refusal("settings.csv", "key,value\nTs,0.02\nTs,0.03\n"), "/settings.csv:3: Ts again.");
  folder_.file("settings.csv", "key,value\nTs,0.02\n");
  EXPECT_EQ(refusal("channels.csv", "kind,name\nsensors,T3\n"),
            "/channels.csv:2: kind is 'sensors'; allowed: state, control, health, sensor, auxiliary.");
  EXPECT_EQ(refusal("channels.csv", "name,unit\nT3,K\n"), "/channels.csv:1: the column kind is missing. Add it.");
  EXPECT_EQ(
      refusal("channels.csv", "kind,units\nsensor,K\n"),
      "/channels.csv:1: a column is 'units'; allowed: kind, name, unit, trim, sigma, resolution, update_period_s.");
  EXPECT_EQ(refusal("channels.csv", "kind,sigma\nstate,2\n"),
            "/channels.csv:2: sigma of a state is '2'; allowed: empty, since only health and sensors have one.");
  EXPECT_EQ(refusal("channels.csv", "kind,name\nsensor,T3\n"),
            ": sensor_names is 1 texts long; allowed: 2. Give one for each row of C.");
}

}  // namespace
}  // namespace ehm::tuner_design
