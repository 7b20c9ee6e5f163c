// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/identify/spectral_bands.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <unsupported/Eigen/FFT>

#include "deploy/runtime/numbers/index.h"

namespace ehm::tuner_design {
namespace {

using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using std::numbers::pi;

constexpr Index longest = 65536, shortest = 64, left_out = 4;
constexpr double band_width = 0.05;

/// The largest product of powers of 2, 3 and 5 that is not above `length`: a fast Fourier transform has no other
/// factors.
Index smooth_length(Index length) {
  Index best = 1;
  for (Index two = 1; two <= length; two *= 2)
    for (Index three = two; three <= length; three *= 3)
      for (Index five = three; five <= length; five *= 5) best = std::max(best, five);
  return best;
}

/// X_k, m x (N/2 + 1), for each taper k.
std::vector<MatrixXcd> tapered_transforms(const MatrixXd& d) {
  const Index N = d.cols();
  Eigen::FFT<double> transform;
  transform.SetFlag(Eigen::FFT<double>::HalfSpectrum);
  std::vector<MatrixXcd> all;
  for (int k = 1; k <= tapers; ++k) {
    MatrixXcd X(d.rows(), N / 2 + 1);
    for (Index i = 0; i < d.rows(); ++i) {
      std::vector<double> tapered(as_size(N));
      for (Index t = 0; t < N; ++t)
        tapered[as_size(t)] = std::sqrt(2.0 / static_cast<double>(N + 1)) *
                              std::sin(pi * k * static_cast<double>(t + 1) / static_cast<double>(N + 1)) * d(i, t);
      std::vector<std::complex<double>> bins;
      transform.fwd(bins, tapered);
      for (Index b = 0; b < X.cols(); ++b) X(i, b) = bins[as_size(b)];
    }
    all.push_back(std::move(X));
  }
  return all;
}

class BandSums {
 public:
  BandSums(const NoiseSpectra& spectra, Index longest_piece)
      : spectra_(spectra), narrowest_(2.0 * pi / static_cast<double>(longest_piece)) {}

  void add(const MatrixXd& d) {
    const auto N = static_cast<double>(d.cols());
    const std::vector<MatrixXcd> X = tapered_transforms(d);
    const double blur = std::sqrt(11.0) * pi / N;
    for (Index b = left_out; b + left_out < d.cols() / 2; ++b) {
      const double omega = 2.0 * pi * static_cast<double>(b) / N;
      if (omega > spectra_.highest_omega()) break;
      SpectralBand& band = band_of(omega);
      band.omega += omega;
      band.bins += 1.0;
      for (const MatrixXcd& x : X) band.power.noalias() += x.col(b) * x.col(b).adjoint() / tapers;
      spectra_.add_at(omega + blur, 0.5, band.spectra);
      spectra_.add_at(omega - blur, 0.5, band.spectra);
    }
  }

  std::vector<SpectralBand> means() {
    std::vector<SpectralBand> all;
    for (auto& [number, band] : bands_) {
      band.omega /= band.bins;
      band.power /= band.bins;
      for (MatrixXcd& each : band.spectra) each /= band.bins;
      all.push_back(std::move(band));
    }
    return all;
  }

 private:
  /// Bands are one bin wide up to `even`, and grow with the frequency above it.
  SpectralBand& band_of(double omega) {
    const double even = narrowest_ / band_width;
    const auto number = omega < even ? std::lround(omega / narrowest_)
                                     : std::lround(1.0 / band_width + std::log(omega / even) / std::log1p(band_width));
    const auto [at, is_new] = bands_.try_emplace(number);
    if (is_new) {
      const Index m = spectra_.sensors();
      at->second.power = MatrixXcd::Zero(m, m);
      at->second.spectra.assign(spectra_.terms().size(), MatrixXcd::Zero(m, m));
    }
    return at->second;
  }

  const NoiseSpectra& spectra_;
  double narrowest_;
  std::map<long, SpectralBand> bands_;
};

}  // namespace

std::vector<SpectralBand> spectral_bands(const std::vector<MatrixXd>& pieces, const NoiseSpectra& spectra) {
  std::vector<MatrixXd> cut;
  Index longest_piece = 1;
  for (const MatrixXd& piece : pieces) {
    const Index parts = (piece.cols() + longest - 1) / longest;
    for (Index part = 0; part < parts; ++part) {
      const Index begin = part * piece.cols() / parts, end = (part + 1) * piece.cols() / parts;
      const Index length = smooth_length(end - begin);
      if (length < shortest) continue;
      cut.emplace_back(piece.middleCols(begin, length));
      longest_piece = std::max(longest_piece, length);
    }
  }
  BandSums sums(spectra, longest_piece);
  for (const MatrixXd& piece : cut) sums.add(piece);
  return sums.means();
}

}  // namespace ehm::tuner_design
