// SPDX-License-Identifier: Apache-2.0
#pragma once
// Measured and modelled spectra of the differenced residual d, averaged over narrow bands.
//
//   measured   P(w) = 1/K sum_k X_k X_k^H,   X_k(w) = sum_t s_k(t) d[t] exp(-i w t),   K = 5
//              s_k(t) = sqrt(2/(N+1)) sin(pi k (t+1)/(N+1)): the sine tapers, orthonormal, w = 2 pi b / N
//   expected   S as the tapers blur it: 1/2 (S(w + s) + S(w - s)), s^2 = 11 (pi/N)^2, the second moment of the tapers'
//              windows; exact for spectra that are parabolas over a few bins, as the sensors' noise is near w = 0
//
// P is the Fourier transform of the sample autocovariances of d: to match it is to match all of them, up to N lags.
// Untapered, the noise of the sensors, whose differences are strongest at high frequencies, would leak to the low ones,
// where walks of health are a thousand times weaker. The lowest 4 bins are left out, since the mean was taken out; so
// are 4 below the highest. d is cut into pieces of at most 65536 values, whose bins are independent but for the
// tapers' overlap: N bins tell as much as N / (1 + 1/(2K)) untapered ones (independent_share).
// A band is 5 % of its frequency wide, and one bin at least. Sources: Riedel & Sidorenko, IEEE Trans. Signal Process.
// 43 (1995) 188 (sine tapers); Thomson, Proc. IEEE 70 (1982) 1055. Errors: none.

#include <Eigen/Core>
#include <vector>

#include "tuner_design/identify/noise_spectra.h"

namespace ehm::tuner_design {

inline constexpr int tapers = 5;
inline constexpr double independent_share = 1.0 / (1.0 + 0.5 / tapers);

struct SpectralBand {
  double omega = 0.0;                     ///< mean, per sample
  double bins = 0.0;                      ///< that were averaged
  Eigen::MatrixXcd power;                 ///< measured, m x m
  std::vector<Eigen::MatrixXcd> spectra;  ///< expected of each term of NoiseSpectra per unit of its variance
};

/// `pieces`: m x N each, percent; pieces of fewer than 64 values are passed over.
std::vector<SpectralBand> spectral_bands(const std::vector<Eigen::MatrixXd>& pieces, const NoiseSpectra& spectra);

}  // namespace ehm::tuner_design
