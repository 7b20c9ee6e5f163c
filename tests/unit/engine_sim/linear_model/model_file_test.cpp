// SPDX-License-Identifier: Apache-2.0
// Model files: exact round trip, and one message for every defect.

#include "engine_sim/linear_model/model_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <functional>

#include "deploy/runtime/files/file_error.h"
#include "deploy/runtime/files/json_object.h"
#include "engine_sim/linear_model/model_json.h"
#include "tests/unit/tuner_design/test_models.h"

namespace ehm::linear_model {
namespace {

std::string file_with(const std::string& text) {
  const std::string path = test::temporary_path("model_file_test.json");
  std::ofstream(path) << text;
  return path;
}

/// The message of reading `text`, without the path in front.
std::string message_for(const std::string& text) {
  const std::string path = file_with(text);
  try {
    read_model(path);
  } catch (const files::FileError& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.rfind(path + ": ", 0), 0U) << "the message starts with the file: " << message;
    return message.substr(std::min(message.size(), path.size() + 2));
  }
  return "accepted";
}

std::string message_after(const std::function<void(files::Json&)>& spoil) {
  files::Json json = model_to_json(test::made_up_model(), "good");
  spoil(json);
  return message_for(json.dump());
}

TEST(ModelFile, RoundTripIsExact) {
  LinearModel model = test::made_up_model();
  model.operating_point = {10668.0, 0.8, 0.1};
  model.engine_type = "test";
  model.engine_hash = "0123abcd";
  model.A(0, 0) = 0.1 + 0.2;  // not 0.3
  model.health[1].trim = -0.017;
  const std::string path = test::temporary_path("round_trip.json");
  write_model(model, path);
  const LinearModel read = read_model(path);
  EXPECT_EQ(read.name, model.name);
  EXPECT_EQ(read.discrete, model.discrete);
  EXPECT_EQ(read.sample_time_s, model.sample_time_s);
  EXPECT_EQ(read.engine_type, "test");
  EXPECT_EQ(read.engine_hash, "0123abcd");
  EXPECT_EQ(read.operating_point->delta_isa_k, 0.1);
  EXPECT_EQ(read.health[1].trim, -0.017);
  EXPECT_EQ(read.auxiliary[0].unit, "degR");
  for (const auto matrix :
       {&LinearModel::A, &LinearModel::B, &LinearModel::L, &LinearModel::C, &LinearModel::D, &LinearModel::M,
        &LinearModel::F, &LinearModel::G, &LinearModel::N, &LinearModel::process_noise}) {
    EXPECT_EQ(read.*matrix, model.*matrix);
  }
  EXPECT_EQ(read.health_sigma, model.health_sigma);
  EXPECT_EQ(read.sensor_noise_sigma, model.sensor_noise_sigma);
}

// 33 samples of 15 ms are held: R = 33 (3^2 + 2^2 / 12) for noise 3 and steps of 2.
TEST(ModelFile, RoundingAndHoldingCountInTheNoise) {
  const LinearModel plain = test::made_up_model();
  files::Json json = model_to_json(plain, "good");
  json["sample_time_s"] = 0.015;
  json["sensors"][1]["noise_sigma"] = 3.0;
  json["sensors"][1]["resolution"] = 2.0;
  json["sensors"][1]["update_period_s"] = 0.5;
  const LinearModel model = read_model(file_with(json.dump()));
  EXPECT_EQ(model.sensor_noise_sigma(0), plain.sensor_noise_sigma(0));
  EXPECT_NEAR(model.sensor_noise_sigma(1), std::sqrt(33.0 * (9.0 + 4.0 / 12.0)), 1e-12);
  const files::Json again = model_to_json(model, "again");
  EXPECT_NEAR(again["sensors"][1]["noise_sigma"].get<double>(), 3.0, 1e-12);
  EXPECT_EQ(again["sensors"][1]["resolution"], 2.0);
  EXPECT_EQ(again["sensors"][1]["update_period_s"], 0.5);
  EXPECT_EQ(again["sensors"][0].count("resolution"), 0u);
  EXPECT_NEAR(read_model(file_with(again.dump())).sensor_noise_sigma(1), model.sensor_noise_sigma(1), 1e-12);
}

TEST(ModelFile, AuxiliaryAndControlsMayBeEmpty) {
  files::Json json = model_to_json(test::made_up_model(), "good");
  json["auxiliary"] = files::Json::array();
  json["F"] = files::Json::array();
  json.erase("G");
  json["N"] = files::Json::array();
  json["controls"] = files::Json::array();
  json.erase("B");
  json["D"] = {files::Json::array(), files::Json::array(), files::Json::array(), files::Json::array()};
  const LinearModel model = read_model(file_with(json.dump()));
  EXPECT_EQ(model.F.rows(), 0);
  EXPECT_EQ(model.F.cols(), 2);
  EXPECT_EQ(model.B.cols(), 0);
  EXPECT_EQ(model.D.rows(), 4);
}

TEST(ModelFile, TrimOfHealthMayBeLeftOut) {
  files::Json json = model_to_json(test::made_up_model(), "good");
  json["health"][0].erase("trim");
  EXPECT_EQ(read_model(file_with(json.dump())).health[0].trim, 0.0);
}

struct Defect {
  const char* name;
  std::function<void(files::Json&)> spoil;
  const char* message;
};

void PrintTo(const Defect& defect, std::ostream* out) {
  *out << defect.name;
}

class ModelFileDefect : public ::testing::TestWithParam<Defect> {};

TEST_P(ModelFileDefect, HasItsMessage) {
  EXPECT_EQ(message_after(GetParam().spoil), GetParam().message);
}

const Defect defects[] = {
    {"LongName", [](files::Json& j) { j["health"][1]["name"] = std::string(64, 'x'); },
     "health[1].name is 64 characters long; allowed: at most 63. Shorten it."},
    {"MissingKey", [](files::Json& j) { j.erase("A"); }, "key A is missing. Add it."},
    {"MissingSigma", [](files::Json& j) { j["health"][2].erase("sigma"); }, "key health[2].sigma is missing. Add it."},
    {"MissingTrim", [](files::Json& j) { j["sensors"][1].erase("trim"); }, "key sensors[1].trim is missing. Add it."},
    {"UnknownKey", [](files::Json& j) { j["H"] = 1; },
     "key H is unknown; allowed here: A, B, C, D, F, G, L, M, N, auxiliary, controls, engine_hash, engine_type, "
     "health, linearisation_error, name, operating_point, process_noise, sample_time_s, schema, sensors, states, time. "
     "Correct "
     "the spelling or remove "
     "it."},
    {"UnknownChannelKey", [](files::Json& j) { j["states"][0]["sigma"] = 1; },
     "key states[0].sigma is unknown; allowed here: name, trim, unit. Correct the spelling or remove it."},
    {"Resolution", [](files::Json& j) { j["sensors"][1]["resolution"] = 0; },
     "sensors[1].resolution is 0.0; allowed: a number above 0. Correct the value."},
    {"Schema", [](files::Json& j) { j["schema"] = "ehm-linear-model/0"; },
     "schema is \"ehm-linear-model/0\"; allowed: \"ehm-linear-model/1\". Convert the file to this format."},
    {"Time", [](files::Json& j) { j["time"] = "sampled"; },
     "time is \"sampled\"; allowed: \"continuous\" or \"discrete\". Say which form the matrices have."},
    {"SampleTime", [](files::Json& j) { j["sample_time_s"] = 0; },
     "sample_time_s is 0.0; allowed: a number above 0. Correct the value."},
    {"EmptyName", [](files::Json& j) { j["name"] = ""; },
     "name is \"\"; allowed: a text that is not empty. Write it in quotes."},
    {"TextForNumber", [](files::Json& j) { j["states"][0]["trim"] = "3650"; },
     "states[0].trim is \"3650\"; allowed: a finite number. Write the number, or derive the matrix again."},
    {"ObjectForArray", [](files::Json& j) { j["sensors"] = files::Json::object(); },
     "sensors is {}; allowed: an array [...]. Write it in brackets."},
    {"NumberForChannel", [](files::Json& j) { j["sensors"][0] = 7; },
     "sensors[0] is 7; allowed: an object {...}. See the description of the format."},
    {"TooFewRows", [](files::Json& j) { j["C"].erase(3); },
     "C is 3 rows high; allowed: 4 rows of 2 numbers. Check the matrix against the channel lists."},
    {"RaggedRow", [](files::Json& j) { j["M"][1].erase(5); },
     "M[1] is 5 numbers long; allowed: 6 numbers. Check the row against the channel lists."},
    {"FlatMatrix",
     [](files::Json& j) {
       j["A"] = {1, 2};
     },
     "A[0] is 1; allowed: an array of numbers. Write it as [1, 2, ...]."},
    {"NullEntry", [](files::Json& j) { j["L"][1][3] = nullptr; },
     "L[1][3] is null; allowed: a finite number. Write the number, or derive the matrix again."},
    {"NegativeSigma", [](files::Json& j) { j["health"][1]["sigma"] = -0.02; },
     "health[1].sigma is -0.02; allowed: a number above 0. Give the standard deviation over the fleet."},
    {"ZeroNoise", [](files::Json& j) { j["sensors"][3]["noise_sigma"] = 0.0; },
     "sensors[3].noise_sigma is 0.0; allowed: a number above 0. Give the standard deviation of one sample's noise."},
    {"DuplicateName", [](files::Json& j) { j["health"][4]["name"] = "h1"; },
     "health[4].name is \"h1\" again; allowed: each name once in its list. Rename one of the two."},
    {"TooManyStates",
     [](files::Json& j) {
       for (int i = 0; i < 15; ++i)
         j["states"].push_back({{"name", "s" + std::to_string(i)}, {"unit", "-"}, {"trim", 1}});
       j["A"] = j["process_noise"] = std::vector<std::vector<double>>(17, std::vector<double>(17, 0.0));
       j["B"] = std::vector<std::vector<double>>(17, std::vector<double>(1, 0.0));
       j["L"] = std::vector<std::vector<double>>(17, std::vector<double>(6, 0.0));
       j["C"] = std::vector<std::vector<double>>(4, std::vector<double>(17, 0.0));
       j["F"] = std::vector<std::vector<double>>(2, std::vector<double>(17, 0.0));
     },
     "states is 17 channels long; allowed: 1 to 16 channels. Choose the channels that matter most."},
    {"NoHealth",
     [](files::Json& j) {
       for (const char* key : {"health", "L", "M", "N"}) j[key] = files::Json::array();
     },
     "health is 0 channels long; allowed: 1 to 16 channels. Choose the channels that matter most."},
    {"HealthUnit", [](files::Json& j) { j["health"][0]["unit"] = "points"; },
     "health[0].unit is \"points\"; allowed: fraction, -, percent, %. Express the health parameter relative to "
     "nominal."},
    {"ZeroTrim", [](files::Json& j) { j["auxiliary"][1]["trim"] = 0; },
     "auxiliary[1].trim is 0.0; allowed: a number other than 0, since errors in lbf are reported in percent of trim. "
     "Give the value at the trim point."},
    {"AsymmetricNoise", [](files::Json& j) { j["process_noise"][0][1] = 0.1; },
     "process_noise is not symmetric; allowed: a covariance matrix. Give the covariance of w per sample."},
    {"NegativeNoise", [](files::Json& j) { j["process_noise"][0][0] = -0.25; },
     "process_noise is a matrix with the eigenvalue -0.25; allowed: no negative eigenvalue. Give the covariance of w "
     "per "
     "sample."},
    {"UnstableDiscrete",
     [](files::Json& j) {
       j["A"] = {{1.25, 0}, {0, 0.5}};
     },
     "A is unstable: its eigenvalue 1.25 has the modulus 1.25; allowed: below 1 for time \"discrete\". Check the "
     "sample "
     "time, the sign of A, and whether the model is continuous."},
    {"UnstablePair",  // of a rotation by 90 degrees times 2
     [](files::Json& j) {
       j["A"] = {{0, 2}, {-2, 0}};
     },
     "A is unstable: its eigenvalue 0.0 +- 2.0 i has the modulus 2.0; allowed: below 1 for time \"discrete\". Check "
     "the "
     "sample time, the sign of A, and whether the model is continuous."},
    {"UnstableContinuous",
     [](files::Json& j) {
       j["time"] = "continuous";
       j["A"] = {{0.5, 0}, {0, -1}};
     },
     "A is unstable: its eigenvalue 0.5 does not decay; allowed: real part below 0 for time \"continuous\". Check the "
     "sign of A, and whether the model is discrete."},
    {"OperatingPoint",
     [](files::Json& j) {
       j["operating_point"] = {{"altitude_m", 0}, {"mach", 0}};
     },
     "key operating_point.delta_isa_k is missing. Add it."},
};

INSTANTIATE_TEST_SUITE_P(All, ModelFileDefect, ::testing::ValuesIn(defects),
                         [](const auto& defect) { return defect.param.name; });

TEST(ModelFile, WhatIsNotJsonIsRefused) {
  using ::testing::HasSubstr;
  EXPECT_THAT(message_for("{\"name\": \"x\", "), HasSubstr("is not complete JSON: parse error at line 1, column 15"));
  EXPECT_THAT(message_for("{\"A\": [[NaN]]}"), HasSubstr("or holds NaN or Infinity; write it again."));
  EXPECT_THAT(message_for("{\"A\": 1e999}"), HasSubstr("is not complete JSON: number overflow parsing '1e999'"));
  EXPECT_THAT(message_for(""), HasSubstr("is not complete JSON"));
  // Deep enough to end the stack of whoever walks down it.
  EXPECT_THAT(message_for("{\"A\": " + std::string(1'000'000, '[') + std::string(1'000'000, ']') + "}"),
              HasSubstr("is nested deeper than 64 levels"));
  EXPECT_EQ(message_for("[1, 2]"), "holds [1,2]; allowed: one JSON object. Write it again.");
  EXPECT_EQ(message_for("{\"name\": \"a\", \"name\": \"b\"}"),
            "key name occurs twice in one object. Remove one of them.");
}

TEST(ModelFile, AbsentFileIsNamed) {
  try {
    read_model("/nonexistent/m.json");
    FAIL() << "an absent file was read";
  } catch (const files::FileError& error) {
    EXPECT_STREQ(error.what(), "/nonexistent/m.json: no such file. Check the path.");
  }
}

TEST(ModelFile, ADefectiveModelIsNotWritten) {
  LinearModel model = test::made_up_model();
  model.N(0, 0) = std::numeric_limits<double>::quiet_NaN();
  const std::string path = test::temporary_path("never.json");
  EXPECT_THROW(write_model(model, path), files::FileError);
  EXPECT_FALSE(std::ifstream(path).good());
}

}  // namespace
}  // namespace ehm::linear_model
