// SPDX-License-Identifier: Apache-2.0
#include "tests/tools/impair/control.h"

#include <fstream>
#include <sstream>
#include <stdexcept>

namespace ehm::test {

const std::vector<SettingName>& setting_names() {
  using S = ImpairmentSettings;
  static const std::vector<SettingName> names{
      {"loss", &S::loss, 0, 1, "share of samples that vanish"},
      {"duplicate", &S::duplicate, 0, 1, "share of samples sent twice"},
      {"reorder", &S::reorder, 0, 1, "share of samples held back by reorder_ms, so that later ones overtake"},
      {"reorder_ms", &S::reorder_ms, 0, 60000, "how long those are held back"},
      {"delay_ms", &S::delay_ms, 0, 60000, "delay of every sample"},
      {"jitter_ms", &S::jitter_ms, 0, 60000, "further delay of each sample, uniform from 0"},
      {"ordered", &S::ordered, 0, 1, "1: no sample overtakes another"},
      {"nan", &S::nan, 0, 1, "share of samples with one sensor NaN"},
      {"bit_flip", &S::bit_flip, 0, 1, "share of samples with one bit of one sensor flipped"},
      {"clock_offset_s", &S::clock_offset_s, -1e9, 1e9, "added to the source time"}};
  return names;
}

namespace {

[[noreturn]] void refuse(const std::string& line, const std::string& why) {
  throw std::invalid_argument("'" + line + "': " + why);
}

std::string range(double min, double max) {
  std::ostringstream text;
  text << "allowed is a number from " << min << " to " << max;
  return text.str();
}

std::string known_names() {
  std::string text = "allowed are pause, cut, clear";
  for (const auto& s : setting_names()) text += std::string(", ") + s.name;
  return text;
}

}  // namespace

void obey(const std::string& line, double now_s, Impairment& impairment) {
  std::istringstream words(line);
  std::string name, rest;
  if (!(words >> name) || name.front() == '#') return;
  double value = 0.0;
  if (!(words >> value) || words >> rest) refuse(line, "a line is a name and a number, such as 'loss 0.2'");
  if (name == "clear") {
    impairment.settings = {};
    return;
  }
  if (name == "pause" || name == "cut") {
    if (!(value >= 0.0 && value <= 3600.0)) refuse(line, range(0, 3600) + " s");
    name == "pause" ? impairment.pause(now_s + value) : impairment.cut(now_s + value);
    return;
  }
  for (const auto& setting : setting_names()) {
    if (name != setting.name) continue;
    if (!(value >= setting.min && value <= setting.max)) refuse(line, range(setting.min, setting.max));
    impairment.settings.*setting.value = value;
    return;
  }
  refuse(line, known_names());
}

Schedule::Schedule(const std::string& file) {
  std::ifstream in(file);
  if (!in) throw std::invalid_argument(file + ": no such file");
  std::string text;
  for (int number = 1; std::getline(in, text); ++number) {
    std::istringstream words(text);
    std::string first;
    if (!(words >> first) || first.front() == '#') continue;
    try {
      const Entry entry{std::stod(first), text.substr(text.find(first) + first.size())};
      if (!entries_.empty() && entry.time_s < entries_.back().time_s) refuse(text, "times must not run backwards");
      Impairment trial(0);
      obey(entry.line, 0.0, trial);
      entries_.push_back(entry);
    } catch (const std::exception& e) {
      throw std::invalid_argument(file + ":" + std::to_string(number) + ": " + e.what());
    }
  }
}

void Schedule::run(double since_first_s, double now_s, Impairment& impairment) {
  for (; next_ < entries_.size() && entries_[next_].time_s <= since_first_s; ++next_)
    obey(entries_[next_].line, now_s, impairment);
}

}  // namespace ehm::test
