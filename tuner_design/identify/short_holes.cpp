// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/identify/short_holes.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "deploy/runtime/numbers/index.h"

namespace ehm::tuner_design {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr Index longest_hole = 3;
constexpr double most_holes = 0.02;

enum class Between { line, hold };

class Mending {
 public:
  explicit Mending(const RecordedSamples& record)
      : gap_after_(as_size(record.sensors.cols()), false), mended_(as_size(record.sensors.cols()), false) {
    for (const Index k : record.gap_after) gap_after_[as_size(k)] = true;
  }

  void mend(MatrixXd& channels, Between between) {
    for (Index i = 0; i < channels.rows(); ++i) {
      const auto lacking = static_cast<double>((!channels.row(i).array().isFinite()).count());
      if (lacking > 0.0 && lacking <= most_holes * static_cast<double>(channels.cols())) mend(channels.row(i), between);
    }
  }
  Index samples() const { return std::count(mended_.begin(), mended_.end(), true); }

 private:
  void mend(MatrixXd::RowXpr values, Between between) {
    for (Index k = 1; k < values.size(); ++k) {
      if (std::isfinite(values(k)) || !std::isfinite(values(k - 1))) continue;
      Index end = k;
      while (end < values.size() && !std::isfinite(values(end))) ++end;
      if (end == values.size() || end - k > longest_hole || broken(k - 1, end)) continue;
      const double slope =
          between == Between::hold ? 0.0 : (values(end) - values(k - 1)) / static_cast<double>(end - k + 1);
      for (; k < end; ++k) {
        values(k) = values(k - 1) + slope;
        mended_[as_size(k)] = true;
      }
    }
  }

  /// A gap of unknown length lies between.
  bool broken(Index first, Index last) const {
    return std::find(gap_after_.begin() + first, gap_after_.begin() + last, true) != gap_after_.begin() + last;
  }

  std::vector<bool> gap_after_, mended_;
};

}  // namespace

Index mend_short_holes(RecordedSamples& record) {
  Mending mending(record);
  mending.mend(record.sensors, Between::line);
  mending.mend(record.controls, Between::hold);
  mending.mend(record.flight, Between::hold);
  return mending.samples();
}

}  // namespace ehm::tuner_design
