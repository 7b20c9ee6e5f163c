// SPDX-License-Identifier: Apache-2.0
// MATLAB files with objects (strings in double quotes, tables, ss ...) and with what linmod returns. The objects are
// written byte by byte, as MATLAB's files have them: libmatio cannot.

#include <array>
#include <fstream>
#include <iterator>

#include "tests/unit/tuner_design/import/least_mat.h"

namespace ehm::tuner_design {
namespace {

using testing::Contains;
using testing::HasSubstr;

std::string word(std::uint32_t value) {
  std::string bytes;
  for (unsigned i = 0; i < 4; ++i) bytes += static_cast<char>(value >> 8U * i & 0xffU);
  return bytes;
}

std::string element(std::uint32_t type, std::string data) {
  const std::string tag = word(type) + word(static_cast<std::uint32_t>(data.size()));
  data.resize((data.size() + 7) / 8 * 8, '\0');
  return tag + data;
}

std::string flags(std::uint32_t of_class) {
  return element(6, word(of_class) + word(0));
}

/// miMATRIX of class 17: name, "MCOS", class, and a reference into data that nobody else understands.
std::string object(const std::string& name, const std::string& of_class) {
  const std::string reference = flags(13) + element(5, word(6) + word(1)) + element(1, "") +
                                element(6, word(0xdd000000) + word(2) + word(1) + word(1) + word(1) + word(1));
  return element(14, flags(17) + element(1, name) + element(1, "MCOS") + element(1, of_class) + element(14, reference));
}

std::string number_array(const std::string& name, const std::string& value_of_8_bytes) {
  return element(14, flags(6) + element(5, word(1) + word(1)) + element(1, name) + element(9, value_of_8_bytes));
}

/// A structure with a field A, a number, and a field that is an object.
std::string structure(const std::string& name, const std::string& field, const std::string& of_class) {
  std::string names = "A", second = field;
  names.resize(32, '\0');
  second.resize(32, '\0');
  return element(14, flags(2) + element(5, word(1) + word(1)) + element(1, name) + word(4U << 16U | 5U) + word(32) +
                         element(1, names + second) + number_array("", std::string(8, '\0')) + object("", of_class));
}

void append(const std::string& bytes) {
  std::ofstream(mat_path(), std::ios::binary | std::ios::app) << bytes;
}

/// What the import says to the least model with more behind it.
std::string refused_with(const std::string& bytes) {
  {
    MatWriter mat(mat_path());
    write_least(mat);
  }
  append(bytes);
  return message([] { import_model(mat_path(), {}); });
}

TEST(ImportMatObjects, TextsInDoubleQuotesAreRefusedWithTheRemedy) {
  EXPECT_EQ(refused_with(object("sensor_units", "string")),
            ": sensor_units is an object of class string; allowed: a matrix of numbers, a text, or a cell array of "
            "texts. Save it as sensor_units = cellstr(sensor_units).");
  // The names of two objects are told apart: no "MCOS is there twice".
  EXPECT_THAT(refused_with(object("notes", "string") + object("auxiliary_units", "string")),
              HasSubstr("auxiliary_units = cellstr(auxiliary_units)"));
}

TEST(ImportMatObjects, MatricesThatAreObjectsAreRefusedWithTheRemedy) {
  EXPECT_THAT(refused_with(object("Q", "gpuArray")),
              HasSubstr("Q is an object of class gpuArray; allowed: a matrix of "));
  EXPECT_THAT(refused_with(object("Q", "gpuArray")), HasSubstr("Save it as Q = gather(Q)"));
  EXPECT_THAT(refused_with(object("R", "table")), HasSubstr("Save it as R = table2array(R)"));
  EXPECT_THAT(refused_with(object("sensor_trim", "timeseries")),
              HasSubstr("Save it as sensor_trim = sensor_trim.Data"));
  EXPECT_THAT(refused_with(object("B", "my.Own")), HasSubstr("Save what it holds as a matrix of numbers"));
}

TEST(ImportMatObjects, ObjectsBesideAGoodModelAreIgnoredByTheirNames) {
  {
    MatWriter mat(mat_path());
    write_least(mat);
  }
  append(object("sys", "ss") + object("log", "timetable"));
  for (const bool compressed : {false, true}) {
    if (compressed) test::compress(mat_path());
    const ImportedModel imported = import_model(mat_path(), {});
    EXPECT_EQ(imported.model.A, Least().A);
    EXPECT_THAT(imported.assumed,
                Contains("not part of a model, ignored: sys (an object of class ss), log (an object of "
                         "class timetable)"));
  }
}

TEST(ImportMatObjects, AFieldThatIsAnObjectIsRefusedWithTheRemedy) {
  {
    MatWriter mat(mat_path());
    mat.number("Ts", 0.02);
  }
  append(structure("engine", "sensor_names", "string"));
  EXPECT_EQ(
      message([] { import_model(mat_path(), {}); }),
      ": engine.sensor_names is an object of class string; allowed: a matrix of numbers, a text, or a cell array of "
      "texts. Save it as sensor_names = cellstr(sensor_names).");
}

TEST(ImportMatObjects, WhatTheModelLacksIsNotPassedOverBesideItsStructure) {
  const auto beside = [](const std::function<void(MatWriter&)>& write, const std::string& bytes) {
    {
      MatWriter mat(mat_path());
      write(mat);
      mat.begin_structure("engine");
      write_least(mat);
    }
    append(bytes);
    return message([] { import_model(mat_path(), {}); });
  };
  const auto nothing = [](MatWriter&) {};
  const std::string why =
      " stands beside the structure engine, which holds the model and has no sensor_units; allowed: all of the model "
      "in "
      "one place. Save it as engine.sensor_units, or leave it out of the file.";
  EXPECT_EQ(beside(nothing, object("sensor_units", "string")), ": sensor_units (an object of class string)" + why);
  EXPECT_EQ(beside([](MatWriter& mat) { mat.cells("sensor_units", {"K", "K"}); }, ""), ": sensor_units" + why);
  EXPECT_THAT(beside([](MatWriter& mat) { mat.number("Q", 1.0); }, ""), HasSubstr(": Q stands beside the structure"));
  // What the structure has, and what no model has, does not matter there.
  EXPECT_EQ(beside([](MatWriter& mat) { mat.number("Ts", 3.0); }, object("log", "timetable")), "accepted");
  EXPECT_THAT(import_model(mat_path(), {}).assumed,
              Contains("not part of a model, ignored: log (an object of class timetable)"));
}

TEST(ImportMatObjects, ASystemWithoutItsMatricesIsNamed) {
  {
    MatWriter mat(mat_path());
    mat.number("Ts", 0.02);
  }
  append(object("plant", "ss"));
  EXPECT_EQ(message([] { import_model(mat_path(), {}); }),
            ": A is missing or empty, and plant is an object of class ss. Save its matrices: [A, B, C, D] = "
            "ssdata(plant), and L and M, the effect of health on states and sensors.");
}

void write_linmod(MatWriter& mat) {
  const Least least;
  mat.numbers("a", least.A);
  mat.numbers("b", Eigen::MatrixXd::Constant(1, 1, 0.2));
  mat.numbers("c", least.C);
  mat.numbers("d", Eigen::MatrixXd::Zero(2, 1));
}

TEST(ImportMatObjects, WhatLinmodReturnsIsExplained) {
  const std::string explained =
      " has a, b, c, d, as linmod returns them, which are A, B, C, D here; a model also needs L "
      "and M, the effect of health on states and sensors.";
  EXPECT_THAT(refusal(write_linmod), HasSubstr(": the file" + explained));
  EXPECT_THAT(refusal([](MatWriter& mat) {
                mat.begin_structure("sys");
                write_linmod(mat);
                mat.cells("StateName", {"engine/N1"});
              }),
              HasSubstr(": sys" + explained));
}

TEST(ImportMatObjects, WhatLinmodReturnsIsUnderstoodWithTheHealthBeside) {
  const ImportedModel imported = import([](MatWriter& mat) {
    const Least least;
    write_linmod(mat);
    mat.cells("OutputName", {"engine/N1", "engine/T30"});
    mat.numbers("L", least.L);
    mat.numbers("M", least.M);
    mat.number("Ts", 0.02);
  });
  EXPECT_EQ(imported.model.A, Least().A);
  EXPECT_EQ(imported.model.B(0, 0), 0.2);
  EXPECT_EQ(imported.model.C, Least().C);
  EXPECT_EQ(imported.model.sensors[1].name, "engine/T30");
}

}  // namespace
}  // namespace ehm::tuner_design
