// SPDX-License-Identifier: Apache-2.0
#pragma once
// How an impairment is told what to do while it runs: lines "NAME VALUE" on standard input or, with a time before
// them, in a schedule file. One table of names serves the command line as well.
//
//   loss 0.2        any setting of ImpairmentSettings
//   pause 2         hold everything for 2 s, then send it at once
//   cut 2           drop everything for 2 s
//   clear 0         every setting back to nothing
//   12.5 loss 0.2   in a schedule: 12.5 s after the first sample

#include <string>
#include <vector>

#include "tests/tools/impair/impairment.h"

namespace ehm::test {

struct SettingName {
  const char* name;
  double ImpairmentSettings::*value;
  double min, max;
  const char* description;
};

const std::vector<SettingName>& setting_names();

/// Obeys one line at `now_s`; empty lines and comments (#) do nothing.
/// @throws std::invalid_argument naming the line and what is allowed.
void obey(const std::string& line, double now_s, Impairment& impairment);

/// Lines of a schedule file in order of time, each obeyed once its time has come.
class Schedule {
 public:
  Schedule() = default;
  /// @throws std::invalid_argument with file and line number if a line cannot be obeyed or time runs backwards.
  explicit Schedule(const std::string& file);
  /// `since_first_s`: seconds since the first sample; `now_s`: on the impairment's clock.
  void run(double since_first_s, double now_s, Impairment& impairment);

 private:
  struct Entry {
    double time_s;
    std::string line;
  };
  std::vector<Entry> entries_;
  std::size_t next_ = 0;
};

}  // namespace ehm::test
