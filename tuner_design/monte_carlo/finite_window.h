// SPDX-License-Identifier: Apache-2.0
#pragma once
// Theory of what an experiment measures: the filter's squared error, averaged over the last part of a run that starts
// cold (theory.md, section 4; [SG] leaves the theoretical error as future work).
//
// The engine has constant health and moves by dx about its balance, driven by w with the model's covariance Q, or stays
// in it without process noise; it has done so before the first sample. With Acl = Axq - K C Axq, Qw = blkdiag(Q, 0),
// and xhat = 0 before the first sample:
//   mean      M <- Acl M + K H                                     E[xhat] = M h
//   offset    O <- Acl O + K                                       answer to a constant sensor offset
//   spread    S <- Acl S Acl^T + K R K^T + (I - K Cxq) Qw (I - K Cxq)^T     of xhat - [dx; 0] about its mean;
//             before the first sample blkdiag(cov(dx), 0) with the stationary cov(dx)
//   error     (T M - G) Ph (T M - G)^T + T S T^T                   T = Th, G = I for h; Tz and Hz for z
//   linearisation   [T O, -e] Lambda [T O, -e]^T                   e = 0 for h, I for z
// averaged over the samples of the window. Scaled units. What is published at the same sample is the root of the sum:
// M, S and O are those of monitor/estimation/error_propagation.h.

#include "monitor/design/design.h"

namespace ehm::tuner_design {

/// The last `averaged` samples of a run of `samples`.
struct Window {
  int samples = 0, averaged = 0;
  int first() const { return samples - averaged; }
};

/// @throws std::invalid_argument if the window has no sample or is longer than the run, or the run longer than a
///         million samples.
Window window_of(double seconds, double window_s, double sample_time_s);

struct WindowError {
  design::ErrorByChannel linear;         ///< of the linear engine
  design::ErrorByChannel linearisation;  ///< what the model's linearisation_error adds to it
};

/// Of the design's filter with all sensors; without `process_noise` the truth is in balance: Q = 0, in a filter that
/// was made for Q.
WindowError finite_window_error(const design::Design& design, const Window& window, bool process_noise);

/// The linear engine's error after endless time. @throws std::runtime_error if the closed loop is not stable.
design::ErrorByChannel settled_error(const design::Design& design, bool process_noise);

}  // namespace ehm::tuner_design
