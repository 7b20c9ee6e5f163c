#pragma once
// Theory of what an experiment measures: the filter's squared error, averaged over the last part of a run that starts
// cold (THEORY section 4; [SG] leaves the theoretical error as future work).
//
// The engine has constant health and is in balance at the first sample; with process noise its state then moves off by
// dx. With Acl = Axq - K C Axq, xhat = 0 before the first sample, and c the sensors' matrix of the n states:
//   mean      M <- Acl M + K H                                     E[xhat] = M h
//   offset    O <- Acl O + K                                       answer to a constant sensor offset
//   spread    S <- J S J^T + [I; K c] Q [I; K c]^T + [0; K] R [0; K]^T,   J = [A, 0; K c A, Acl]
//             of [dx; xhat] about its mean; at the first sample S = [0; K] R [0; K]^T, and with Q = 0 dx stays 0
//   error     (T M - G) Ph (T M - G)^T + [-F, T] S [-F, T]^T       T = Th, G = I, F = 0 for h; Tz, Hz and F for z
//   linearisation   [T O, -e] Lambda [T O, -e]^T                   e = 0 for h, I for z
// averaged over the samples of the window. Scaled units; n states, t tuners, J (2n+t) x (2n+t).

#include "monitor/design/design.h"

namespace ehm::bench {

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

/// Of the design's filter with all sensors.
WindowError finite_window_error(const design::Design& design, const Window& window, bool process_noise);

/// The linear engine's error after endless time. @throws std::runtime_error if the closed loop is not stable.
design::ErrorByChannel settled_error(const design::Design& design, bool process_noise);

}  // namespace ehm::bench
