// SPDX-License-Identifier: Apache-2.0
// What a MATLAB file may not state: one message each, with the variable, the entry, what is allowed, what to do.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "tests/unit/tuner_design/import/least_mat.h"

namespace ehm::tuner_design {
namespace {

using ::testing::StartsWith;

struct Defect {
  const char* name;
  std::function<void(MatWriter&)> write;
  const char* message;
};

void PrintTo(const Defect& defect, std::ostream* out) {
  *out << defect.name;
}

/// The least model with one of its variables in another form.
std::function<void(MatWriter&)> with(const char* name, const std::function<void(MatWriter&)>& write) {
  return [=](MatWriter& mat) {
    const Least least;
    const std::string changed = name;
    if (changed != "A") mat.numbers("A", least.A);
    if (changed != "L") mat.numbers("L", least.L);
    if (changed != "C") mat.numbers("C", least.C);
    if (changed != "M") mat.numbers("M", least.M);
    if (changed != "Ts") mat.number("Ts", 0.02);
    write(mat);
  };
}

class ImportMatDefects : public testing::TestWithParam<Defect> {};

TEST_P(ImportMatDefects, AreRefusedWithOneMessage) {
  EXPECT_EQ(refusal(GetParam().write), GetParam().message);
}

const Eigen::MatrixXd nan_at_2_3 = [] {
  Eigen::MatrixXd M = Least().M;
  M(1, 2) = std::numeric_limits<double>::quiet_NaN();
  return M;
}();

const Eigen::Matrix2d correlated = (Eigen::Matrix2d() << 1.0, 0.1, 0.1, 1.0).finished();

INSTANTIATE_TEST_SUITE_P(
    All, ImportMatDefects,
    testing::Values(
        Defect{"Missing", with("L", [](MatWriter&) {}),
               ": L is missing or empty; a model needs A, L, C and M. Give the effect of health on the states, n x p, "
               "zeros if none."},
        Defect{"NotSquare", with("A", [](MatWriter& mat) { mat.numbers("A", Eigen::MatrixXd::Ones(2, 1)); }),
               ": A is 2 x 1; allowed: 2 x 2, square. Check how it was derived, or the matrix that it must fit."},
        Defect{"Transposed", with("M", [](MatWriter& mat) { mat.numbers("M", Least().M.transpose()); }),
               ": M is 3 x 2; allowed: 2 x 3, rows as C, columns as L. Transpose it."},
        Defect{"DWithoutB", with("D", [](MatWriter& mat) { mat.numbers("D", Eigen::Vector2d::Ones()); }),
               ": D is 2 x 1; allowed: 2 x 0, rows as C; without B there are no controls. Check how it was derived, or "
               "the matrix that it must fit."},
        Defect{"FWithoutN", with("F", [](MatWriter& mat) { mat.number("F", 1.0); }),
               ": N is missing or empty; auxiliary outputs need both F (r x n) and N (r x p). Give it, zeros if it has "
               "no effect, or leave out both."},
        Defect{"NaN", with("M", [](MatWriter& mat) { mat.numbers("M", nan_at_2_3); }),
               ": M(2,3) is NaN; allowed: a finite number. Derive it again, or leave the variable out if it is "
               "optional."},
        Defect{"Complex", with("C", [](MatWriter& mat) { mat.complex("C", Least().C, Eigen::MatrixXd::Ones(2, 1)); }),
               ": C(1,1) is complex; allowed: real numbers. Give its real part, if the rest is round-off."},
        Defect{"TextForNumbers", with("A", [](MatWriter& mat) { mat.text("A", "0.9"); }),
               ": A is a text; allowed: a matrix of numbers. Give the numbers."},
        Defect{"NumbersForNames", with("", [](MatWriter& mat) { mat.number("sensor_names", 2.0); }),
               ": sensor_names is numeric; allowed: a cell array of texts, {'N1', 'N2'}, or a character matrix. "
               "cellstr() makes one of strings."},
        Defect{"NamesTooFew", with("", [](MatWriter& mat) { mat.cells("sensor_names", {"y"}); }),
               ": sensor_names is 1 texts long; allowed: 2. Give one for each row of C."},
        Defect{"NameTwice",
               with("",
                    [](MatWriter& mat) {
                      mat.cells("sensor_names", {"y", "y"});
                    }),
               ": sensors[1].name is \"y\" again; allowed: each name once in its list. Rename one of the two."},
        Defect{"TrimsTooMany", with("", [](MatWriter& mat) { mat.numbers("sensor_trim", Eigen::Vector3d::Ones()); }),
               ": sensor_trim is 3 x 1; allowed: a vector of 2. Give one number for each row of C."},
        Defect{"SigmaZero", with("", [](MatWriter& mat) { mat.numbers("health_sigma", Eigen::Vector3d(1, 0, 1)); }),
               ": health_sigma(2) is 0.0; allowed: above 0. Give a standard deviation in the channel's unit."},
        Defect{"SingularR", with("", [](MatWriter& mat) { mat.numbers("R", Eigen::Vector2d(1.0, 0.0).asDiagonal()); }),
               ": R(2,2) is 0.0; allowed: above 0. R is singular; give the variance of one sample's noise, or leave "
               "the sensor out."},
        Defect{"CorrelatedR", with("", [](MatWriter& mat) { mat.numbers("R", correlated); }),
               ": R(1,2) is 0.1; allowed: 0 off the diagonal. The filter takes the sensors' noise as independent; give "
               "sensor_noise_sigma."},
        Defect{"NegativeQ", with("", [](MatWriter& mat) { mat.number("Q", -1.0); }),
               ": process_noise is a matrix with the eigenvalue -1.0; allowed: no negative eigenvalue. Give the "
               "covariance of w per sample."},
        Defect{"NoSampleTime", with("Ts", [](MatWriter&) {}),
               ": the sample time is missing. Give the variable sample_time_s (continuous model) or Ts (discrete "
               "model), or --sample-time, in seconds."},
        Defect{"TwoSampleTimes", with("", [](MatWriter& mat) { mat.number("sample_time_s", 0.03); }),
               ": sample_time_s is 0.03; allowed: Ts = 0.02 of the discrete model. Remove one of the two; a discrete "
               "model keeps its sample time."},
        Defect{"Unstable", with("A", [](MatWriter& mat) { mat.number("A", 1.02); }),
               ": A is unstable: its eigenvalue 1.02 has the modulus 1.02; allowed: below 1 for time \"discrete\". "
               "Check the sample time, the sign of A, and whether the model is continuous."},
        Defect{"NoTrimNoNoise",
               with("",
                    [](MatWriter& mat) {
                      mat.cells("sensor_units", {"K", "percent"});
                    }),
               ": the noise of sensor y1 (K) is not stated, and cannot be assumed in percent of trim, since its trim "
               "is not stated, 0, or a gauge pressure. Give sensor_noise_sigma or R."},
        Defect{"OperatingPoint", with("", [](MatWriter& mat) { mat.number("altitude_m", 1e4); }),
               ": mach is missing; an operating point is altitude_m, mach and delta_isa_k. Add it."},
        Defect{"ForeignLetters", with("", [](MatWriter& mat) { mat.text("name", "\x01"); }),
               ": name has a character outside ASCII; allowed: letters, digits, signs. Write degC, alpha, ..."}),
    [](const auto& defect) { return defect.param.name; });

TEST(ImportMat, TooManyChannelsForTheWire) {
  const std::string text = refusal([](MatWriter& mat) {
    mat.number("A", 0.9);
    mat.numbers("L", Eigen::MatrixXd::Ones(1, 17));
    mat.number("C", 1.0);
    mat.numbers("M", Eigen::MatrixXd::Ones(1, 17));
    mat.number("Ts", 0.02);
  });
  EXPECT_EQ(text, ": health is 17 channels long; allowed: 1 to 16 channels. Choose the channels that matter most.");
}

TEST(ImportMat, AsymmetricQIsNamedByItsEntry) {
  const std::string text = refusal([](MatWriter& mat) {
    test::write_all(mat, [] {
      linear_model::LinearModel model = test::made_up_model();
      model.process_noise(1, 0) = 0.01;
      return model;
    }());
  });
  EXPECT_THAT(text, StartsWith(": Q(2,1) is 0.01; allowed: 0.0 as Q(1,2). A covariance is symmetric"));
}

}  // namespace
}  // namespace ehm::tuner_design
