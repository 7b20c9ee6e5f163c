// SPDX-License-Identifier: Apache-2.0
// Design files: exact round trip, content hash, and refusal of what was damaged or changed.

#include "monitor/design/design_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "deploy/runtime/files/content_hash.h"
#include "deploy/runtime/files/file_error.h"
#include "deploy/runtime/files/json_object.h"
#include "tests/unit/tuner_design/test_models.h"
#include "tuner_design/design/design_tuner.h"

namespace ehm::design {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

std::string text_of(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

std::string message_of(const std::string& path) {
  try {
    read_design(path);
  } catch (const files::FileError& error) {
    return error.what();
  }
  return "accepted";
}

class DesignFile : public ::testing::Test {
 protected:
  void SetUp() override { hash = write_design(design, path); }
  void rewrite(const std::string& text) const { std::ofstream(path) << text; }
  /// Changes the content and gives it a matching hash, as a wrong program would.
  void rewrite_with_hash(files::Json json) const {
    json.erase("hash");
    const std::string new_hash = files::sha256_hex(json.dump());
    json["hash"] = new_hash;
    rewrite(json.dump());
  }
  const Design design = tuner_design::design_tuner(test::made_up_model(), {});
  const std::string path = test::temporary_path("design_file_test.json");
  std::string hash;
};

void expect_equal(const SubsetDesign& a, const SubsetDesign& b) {
  EXPECT_EQ(a.sensors, b.sensors);
  for (const auto matrix :
       {&SubsetDesign::V, &SubsetDesign::W, &SubsetDesign::A, &SubsetDesign::B, &SubsetDesign::C, &SubsetDesign::K,
        &SubsetDesign::P, &SubsetDesign::health_total_covariance, &SubsetDesign::auxiliary_total_covariance,
        &SubsetDesign::health_filter_covariance, &SubsetDesign::auxiliary_filter_covariance,
        &SubsetDesign::health_noise_covariance, &SubsetDesign::auxiliary_noise_covariance}) {
    EXPECT_EQ(a.*matrix, b.*matrix);
  }
  EXPECT_EQ(a.innovation_variance, b.innovation_variance);
  EXPECT_EQ(a.slowest_time_constant_s, b.slowest_time_constant_s);
}

TEST(ContentHash, IsSha256) {
  // FIPS 180-4, example of one block.
  EXPECT_EQ(files::sha256_hex("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST_F(DesignFile, RoundTripIsExact) {
  const Design read = read_design(path);
  EXPECT_EQ(read.hash, hash);
  expect_equal(read.full, design.full);
  ASSERT_EQ(read.missing.size(), design.missing.size());
  for (std::size_t i = 0; i < read.missing.size(); ++i) expect_equal(*read.missing[i], *design.missing[i]);
  EXPECT_EQ(read.ssee.health, design.ssee.health);
  EXPECT_EQ(read.bayes_limit.auxiliary, design.bayes_limit.auxiliary);
  EXPECT_EQ(read.full_map.health, design.full_map.health);
  EXPECT_EQ(read.reduced_map.auxiliary, design.reduced_map.auxiliary);
  EXPECT_EQ(read.scaling.sensor, design.scaling.sensor);
  EXPECT_EQ(read.scaling.auxiliary_unit, design.scaling.auxiliary_unit);
  EXPECT_EQ(read.options.qh_percent2, 1e-3);
  EXPECT_EQ(read.options.tuning, design.options.tuning);
  // Written again it is the same file.
  const std::string again = test::temporary_path("again.json");
  EXPECT_EQ(write_design(read, again), hash);
  EXPECT_EQ(text_of(again), text_of(path));
}

TEST_F(DesignFile, LayoutDoesNotMatterToTheHash) {
  rewrite(files::Json::parse(text_of(path)).dump(7));
  EXPECT_EQ(read_design(path).hash, hash);
}

TEST_F(DesignFile, TruncatedAtAnyTenthIsRefused) {
  const std::string text = text_of(path);
  for (std::size_t tenth = 0; tenth < 10; ++tenth) {
    rewrite(text.substr(0, text.size() * tenth / 10));
    EXPECT_THAT(message_of(path), StartsWith(path + ": is not complete JSON: ")) << tenth;
    EXPECT_THAT(message_of(path), HasSubstr("The file is damaged or truncated"));
  }
}

TEST_F(DesignFile, ChangedByHandIsRefused) {
  files::Json json = files::Json::parse(text_of(path));
  json["designs"]["full"]["K"][0][0] = json["designs"]["full"]["K"][0][0].get<double>() * (1.0 + 1e-15);
  const std::string actual = [&] {
    files::Json content = json;
    content.erase("hash");
    return files::sha256_hex(content.dump());
  }();
  rewrite(json.dump());
  EXPECT_EQ(message_of(path), path + ": hash is \"" + hash + "\"; allowed: \"" + actual +
                                  "\", the SHA-256 of the content. The file was damaged or changed by hand: make the "
                                  "design again with tuner_design design.");
}

TEST_F(DesignFile, OlderSchemaAndOtherFilesAreRefused) {
  files::Json json = files::Json::parse(text_of(path));
  json["schema"] = "ehm-design/2";
  rewrite_with_hash(json);
  EXPECT_EQ(message_of(path),
            path +
                ": schema is \"ehm-design/2\"; allowed: \"ehm-design/3\". Designs of another version have other "
                "standard deviations (before version 3 without the engine's process noise): make it again from its "
                "model, which also stands under its key \"model\", with tuner_design design.");
  json["schema"] = "ehm-linear-model/1";
  rewrite_with_hash(json);
  EXPECT_EQ(message_of(path), path +
                                  ": schema is \"ehm-linear-model/1\"; allowed: \"ehm-design/3\". The file is of "
                                  "another kind: make the design with tuner_design design.");
  rewrite("{}");
  EXPECT_EQ(message_of(path), path + ": key schema is missing. Add it.");
}

TEST_F(DesignFile, AMatchingHashDoesNotExcuseWrongContent) {
  const files::Json good = files::Json::parse(text_of(path));
  files::Json json = good;
  for (auto& row : json["designs"]["full"]["K"]) {
    for (auto& value : row) value = 0.0;
  }
  rewrite_with_hash(json);
  EXPECT_EQ(message_of(path),
            path +
                ": designs.full.K is a gain whose closed loop has the spectral radius 1.0; allowed: below 1. Make the "
                "design again with tuner_design design.");
  json = good;
  json["designs"]["missing"][1]["W"].erase(0);
  rewrite_with_hash(json);
  EXPECT_THAT(message_of(path),
              StartsWith(path + ": designs.missing[1].W is 5 rows high; allowed: 6 rows of 3 numbers."));
  json = good;
  json["designs"]["full"]["sensors"] = {0, 1, 1, 3};
  rewrite_with_hash(json);
  EXPECT_THAT(message_of(path), HasSubstr("designs.full.sensors is [0,1,1,3]; allowed: ascending indices below 4."));
  json = good;
  json["designs"]["full"]["health_total_covariance"][0][0] = -1.0;
  rewrite_with_hash(json);
  EXPECT_THAT(message_of(path), HasSubstr("health_total_covariance is a matrix with the variance -1.0; allowed:"));
  json = good;
  const std::size_t last = json["designs"]["full"]["K"].size() - 1;  // a tuner that fades by itself and hears nothing
  for (const char* matrix : {"K", "A"})
    for (auto& value : json["designs"]["full"][matrix][last]) value = 0.0;
  json["designs"]["full"]["A"][last][last] = 0.5;
  rewrite_with_hash(json);
  EXPECT_THAT(message_of(path), HasSubstr("designs.full.K is a gain that leaves a combination of tuners without noise; "
                                          "allowed: "));
  json = good;
  json["designs"]["full"]["health_readout"] = {{1.0, 2.0}};
  rewrite_with_hash(json);
  EXPECT_THAT(message_of(path), HasSubstr("designs.full.health_readout"));
  json = good;
  json["scaling"]["state"][0] = 1.0;
  rewrite_with_hash(json);
  EXPECT_THAT(message_of(path), HasSubstr("scaling is not the scaling of this model"));
  json = good;
  json["note"] = "mine";
  rewrite_with_hash(json);
  EXPECT_THAT(message_of(path), HasSubstr("key note is unknown"));
  json = good;
  json["designs"]["missing"].erase(0);
  rewrite_with_hash(json);
  EXPECT_THAT(message_of(path), HasSubstr("designs.missing is 3 entries long; allowed: one entry for each of the 4"));
  json = good;
  json["model"]["A"] = {{1.5, 0}, {0, 0.5}};
  rewrite_with_hash(json);
  EXPECT_THAT(message_of(path), HasSubstr("A is unstable"));
}

TEST_F(DesignFile, MissingDesignsMayBeAbsent) {
  Design few = design;
  few.missing[2].reset();
  write_design(few, path);
  EXPECT_FALSE(read_design(path).missing[2].has_value());
}

TEST_F(DesignFile, WritingLeavesNoTemporaryFileAndFailsAsAWhole) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    EXPECT_EQ(entry.path().string().find(".tmp"), std::string::npos) << entry.path();
  }
  Design broken = design;
  broken.full.P(0, 0) = std::numeric_limits<double>::quiet_NaN();
  try {
    write_design(broken, path);
    FAIL() << "NaN was written";
  } catch (const files::FileError& error) {
    EXPECT_EQ(std::string(error.what()),
              path +
                  ": designs.full.P[0][0] is NaN; allowed: a finite number. Nothing was written; find out where the "
                  "number comes from.");
  }
  EXPECT_EQ(read_design(path).hash, hash) << "the old file stays";
  try {
    write_design(design, "/nonexistent/d.json");
    FAIL() << "written into a folder that does not exist";
  } catch (const files::FileError& error) {
    EXPECT_STREQ(
        error.what(),
        "/nonexistent/d.json: cannot be written: No such file or directory. Check the folder and its permissions.");
  }
}

}  // namespace
}  // namespace ehm::design
