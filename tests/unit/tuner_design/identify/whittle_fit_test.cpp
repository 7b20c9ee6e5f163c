// SPDX-License-Identifier: Apache-2.0
// The parts of the identification: least squares without negative unknowns, spectra of the noises against their
// autocovariances, tapered spectra against what is expected of them, the fit against a closed form.

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "deploy/runtime/numbers/decompositions.h"
#include "deploy/runtime/numbers/index.h"
#include "engine_sim/linear_model/discretise.h"
#include "engine_sim/linear_model/scaling.h"
#include "tests/unit/tuner_design/test_models.h"
#include "tuner_design/identify/nonnegative_fit.h"
#include "tuner_design/identify/whittle_fit.h"

namespace ehm::tuner_design {
namespace {

using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXd;

linear_model::LinearModel scaled_model() {
  const auto model = test::made_up_model();
  return linear_model::scaled(model, linear_model::scaling_of(model));
}

TEST(NonnegativeFit, MeetsTheConditionsOfKuhnAndTuckerOnRandomProblems) {
  test::Random random(3);
  for (int trial = 0; trial < 200; ++trial) {
    const Index k = 1 + trial % 12;
    const MatrixXd root = random.normal_matrix(k + trial % 4, k);
    const MatrixXd F = root.transpose() * root + 1e-6 * MatrixXd::Identity(k, k);
    const VectorXd b = random.normal_vector(k);
    const VectorXd x = nonnegative_fit(F, b), slope = b - F * x;
    const double tolerance = 1e-7 * (1.0 + F.norm() * x.norm());
    for (Index i = 0; i < k; ++i) {
      EXPECT_GE(x(i), 0.0);
      EXPECT_LE(slope(i), tolerance);
      if (x(i) > 0.0) {
        EXPECT_NEAR(slope(i), 0.0, tolerance);
      }
    }
  }
}

/// Spectrum of the moving average of d to one unit of a noise, by its response in time: sum_k a_k exp(-i w k).
MatrixXcd by_response(const linear_model::LinearModel& m, const NoiseTerm& term, double omega) {
  constexpr int long_enough = 3000;
  VectorXd x = VectorXd::Zero(m.A.rows()), h = VectorXd::Zero(m.L.cols());
  VectorXd before = VectorXd::Zero(m.C.rows());
  Eigen::VectorXcd a = Eigen::VectorXcd::Zero(m.C.rows());
  for (int k = 0; k < long_enough; ++k) {
    VectorXd y = m.C * x + m.M * h;
    if (term.kind == NoiseKind::sensor && k == 0) y(term.channel) += 1.0;
    a += (y - before) * std::polar(1.0, -omega * k);
    before = y;
    x = m.A * x + m.L * h;
    if (k == 0 && term.kind == NoiseKind::motion) x(term.channel) += 1.0;
    if (k == 0 && term.kind == NoiseKind::walk) h(term.channel) += 1.0;
  }
  return a * a.adjoint();
}

TEST(NoiseSpectra, AreThoseOfTheModelsResponseToEachNoise) {
  const auto model = scaled_model();
  const NoiseSpectra spectra(model);
  ASSERT_EQ(spectra.terms().size(), 4U + 2U + 6U);
  for (const double omega : {0.003, 0.1, 1.5, 3.0}) {
    std::vector<MatrixXcd> sums(spectra.terms().size(), MatrixXcd::Zero(4, 4));
    spectra.add_at(omega, 2.0, sums);
    for (std::size_t t = 0; t < sums.size(); ++t) {
      const MatrixXcd expected = by_response(model, spectra.terms()[t], omega);
      EXPECT_LE((sums[t] / 2.0 - expected).norm(), 1e-9 * expected.norm()) << "term " << t << " at " << omega;
    }
  }
}

TEST(NoiseSpectra, ASensorThatHoldsItsValuesHasThePowerThatTheFilterCountsWithAtLowFrequencies) {
  auto model = scaled_model();
  model.sensor_update_period_s = VectorXd::Zero(4);
  model.sensor_update_period_s(1) = 5 * model.sample_time_s;
  const NoiseSpectra spectra(model);
  EXPECT_NEAR(spectra.highest_omega(), std::numbers::pi / 5.0, 1e-15);
  std::vector<MatrixXcd> sums(spectra.terms().size(), MatrixXcd::Zero(4, 4));
  spectra.add_at(0.001, 1.0, sums);
  EXPECT_NEAR(sums[1](1, 1).real() / sums[0](0, 0).real(), 1.0, 1e-5);
  spectra.add_at(0.5, 1.0, sums);
  EXPECT_LT(sums[1](1, 1).real() / sums[0](0, 0).real(), 0.6);
}

TEST(NoiseSpectra, AProcessNoiseWithCovariancesIsOneTermAndOneThatIsZeroIsAskedForEachState) {
  auto model = scaled_model();
  model.process_noise << 1.0, 0.5, 0.5, 1.0;
  EXPECT_EQ(NoiseSpectra(model).terms().size(), 4U + 1U + 6U);
  model.process_noise.setZero();
  EXPECT_EQ(NoiseSpectra(model).terms().size(), 4U + 2U + 6U);
  model.process_noise(1, 1) = 1.0;  // the metal follows the gas without noise of its own
  EXPECT_EQ(NoiseSpectra(model).terms().size(), 4U + 1U + 6U);
}

/// d of sensors that only make noise.
MatrixXd noise_alone(Index samples, std::uint64_t seed) {
  test::Random random(seed);
  const MatrixXd v = random.normal_matrix(4, samples + 1);
  MatrixXd d = v.rightCols(samples) - v.leftCols(samples);
  d.colwise() -= d.rowwise().mean().eval();
  return d;
}

TEST(SpectralBands, AreWhatTheTapersMakeOfNoiseDownToTheLowestBand) {
  const NoiseSpectra spectra(scaled_model());
  VectorXd lowest = VectorXd::Zero(4);
  constexpr int records = 200;
  for (int i = 0; i < records; ++i) {
    const auto bands = spectral_bands({noise_alone(1000, 100 + as_size(i))}, spectra);
    for (Index s = 0; s < 4; ++s)
      lowest(s) += bands.front().power(s, s).real() / bands.front().spectra[as_size(s)](s, s).real() / records;
  }
  // 800 values of a chi-square with 2 * 5 degrees of freedom over its mean: standard error 0.016
  EXPECT_NEAR(lowest.mean(), 1.0, 0.05);
}

TEST(SpectralBands, CountEveryBinOnceAndSmoothOverTheHighOnes) {
  const NoiseSpectra spectra(scaled_model());
  const auto bands = spectral_bands({noise_alone(5000, 1), noise_alone(2100, 2)}, spectra);
  double bins = 0.0;
  for (std::size_t b = 0; b < bands.size(); ++b) {
    bins += bands[b].bins;
    if (b > 0) {
      EXPECT_GT(bands[b].omega, bands[b - 1].omega);
    }
  }
  // of 5000 and 2048 (2100 is no product of 2, 3 and 5 only), without 4 at each end: 2492 + 1016 + 2 * ... each
  EXPECT_NEAR(bins, 2500.0 + 1025.0, 20.0);
  EXPECT_LT(bands.size(), 150U);
}

TEST(WhittleFit, OfNoiseAloneIsItsMeanPowerWithItsStandardError) {
  const NoiseSpectra spectra(scaled_model());
  const MatrixXd d = noise_alone(20000, 7);
  const auto bands = spectral_bands({d}, spectra);
  const NoiseGroups groups{{0}, {1}, {2}, {3}};
  const WhittleFit fit = whittle_fit(bands, groups, VectorXd::Constant(4, 0.3));
  // The differences of unit noise: variance 1, known to sqrt(2/N) by whoever knows that it is white.
  for (Index i = 0; i < 4; ++i) {
    EXPECT_NEAR(fit.theta(i), 1.0, 4.0 * fit.standard_error(i));
    EXPECT_NEAR(fit.standard_error(i), std::sqrt(2.0 / 20000.0 / independent_share), 3e-4);
  }
  EXPECT_LT(fit.iterations, 10);
}

TEST(WhittleFit, EndsWhereTheLikelihoodIsFlat) {
  const NoiseSpectra spectra(scaled_model());
  const auto bands = spectral_bands({noise_alone(5000, 7)}, spectra);
  NoiseGroups groups;
  for (std::size_t t = 0; t < spectra.terms().size(); ++t) groups.push_back({t});
  const VectorXd start = VectorXd::Constant(as_index(groups.size()), 1e-3);
  const WhittleFit fit = whittle_fit(bands, groups, start);
  // No single variance can be moved by a tenth of its standard error to the fit's advantage.
  for (Index g = 0; g < fit.theta.size(); ++g) {
    for (const double by : {-0.1, 0.1}) {
      VectorXd moved = fit.theta;
      moved(g) += by * fit.standard_error(g);
      if (moved(g) < 0.0) continue;
      double deviance = 0.0;
      for (const SpectralBand& band : bands) {
        const MatrixXcd S = spectrum(band, groups, moved);
        deviance += 2.0 * independent_share * band.bins *
                    (std::log(S.determinant().real()) + (S.inverse() * band.power).trace().real());
      }
      EXPECT_GE(deviance, fit.deviance - 1e-6) << "variance " << g;
    }
  }
}

}  // namespace
}  // namespace ehm::tuner_design
