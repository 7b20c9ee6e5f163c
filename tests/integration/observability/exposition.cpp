// SPDX-License-Identifier: Apache-2.0
#include "tests/integration/observability/exposition.h"

#include <algorithm>
#include <cstdlib>
#include <regex>
#include <sstream>
#include <stdexcept>

namespace ehm::test {

namespace {

[[noreturn]] void refuse(const std::string& why, const std::string& line) {
  throw std::runtime_error("exposition: " + why + ": " + line);
}

Labels read_labels(const std::string& text, const std::string& line) {
  static const std::regex label(R"re(([a-zA-Z_][a-zA-Z0-9_]*)="((?:[^"\\\n]|\\[\\"n])*)"(,?))re");
  Labels labels;
  auto begin = text.cbegin();
  bool more = !text.empty();
  for (std::smatch match; more; begin = match.suffix().first) {
    if (!std::regex_search(begin, text.cend(), match, label, std::regex_constants::match_continuous))
      refuse("bad label", line);
    if (!labels.emplace(match[1], match[2]).second) refuse("label twice", line);
    more = match[3].length() == 1;
  }
  if (begin != text.cend()) refuse("text after the labels", line);
  return labels;
}

}  // namespace

Exposition::Exposition(const std::string& text) {
  if (text.empty() || text.back() != '\n') refuse("no line feed at the end", text);
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with('#'))
      read_comment(line);
    else
      read_sample(line);
  for (const auto& [name, family] : families_)
    if (family.type.empty() || family.help.empty() || family.series.empty()) refuse("incomplete family", name);
}

void Exposition::read_comment(const std::string& line) {
  static const std::regex comment(R"(# (HELP|TYPE) ([a-zA-Z_:][a-zA-Z0-9_:]*) (.+))");
  std::smatch match;
  if (!std::regex_match(line, match, comment)) refuse("neither HELP nor TYPE", line);
  const bool known = families_.contains(match[2]);
  MetricFamily& family = families_[match[2]];
  if (known && (match[2] != current_ || !family.series.empty())) refuse("family twice", line);
  current_ = match[2];
  std::string& part = match[1] == "HELP" ? family.help : family.type;
  if (!part.empty()) refuse("twice", line);
  part = match[3];
  if (match[1] == "TYPE" && part != "counter" && part != "gauge") refuse("unexpected type", line);
}

void Exposition::read_sample(const std::string& line) {
  static const std::regex sample(R"(([a-zA-Z_:][a-zA-Z0-9_:]*)(?:\{(.*)\})? (\S+))");
  std::smatch match;
  if (!std::regex_match(line, match, sample)) refuse("no sample", line);
  if (match[1] != current_ || families_[current_].type.empty()) refuse("sample outside its family", line);
  const std::string number = match[3];
  char* end = nullptr;
  const double value = std::strtod(number.c_str(), &end);
  if (*end != '\0') refuse("no number", line);
  if (!families_[current_].series.emplace(read_labels(match[2], line), value).second) refuse("series twice", line);
}

double Exposition::value(const std::string& name, const Labels& labels) const {
  const auto family = families_.find(name);
  if (family == families_.end()) throw std::runtime_error("exposition: no metric " + name);
  const double* found = nullptr;
  for (const auto& [has, value] : family->second.series) {
    if (!std::includes(has.begin(), has.end(), labels.begin(), labels.end())) continue;
    if (found) throw std::runtime_error("exposition: several series of " + name);
    found = &value;
  }
  if (!found) throw std::runtime_error("exposition: no such series of " + name);
  return *found;
}

}  // namespace ehm::test
