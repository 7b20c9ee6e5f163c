// SPDX-License-Identifier: Apache-2.0
#pragma once
// A strict reader of Prometheus' text exposition format 0.0.4, as far as counters and gauges go: HELP and TYPE once and
// before the samples, samples of a family together, no series twice, every line in order.
//
// @throws std::runtime_error with the line that is not.

#include <map>
#include <set>
#include <string>

namespace ehm::test {

using Labels = std::map<std::string, std::string>;

struct MetricFamily {
  std::string help, type;
  std::map<Labels, double> series;
};

class Exposition {
 public:
  explicit Exposition(const std::string& text);

  const std::map<std::string, MetricFamily>& families() const { return families_; }
  bool has(const std::string& name) const { return families_.contains(name); }
  /// The one series of `name` that has all of `labels`, among others. @throws if there is none or several.
  double value(const std::string& name, const Labels& labels = {}) const;

 private:
  void read_comment(const std::string& line);
  void read_sample(const std::string& line);

  std::map<std::string, MetricFamily> families_;
  std::string current_;
};

}  // namespace ehm::test
