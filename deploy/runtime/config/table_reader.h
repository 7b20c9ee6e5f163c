// SPDX-License-Identifier: Apache-2.0
#pragma once
// Reads one TOML table strictly: every key is asked for, ranges are checked, and what nobody asked for is an error.
//
// @throws ConfigError with file, line, key, value, allowed range.

#include <toml++/toml.h>
#include <string>
#include <vector>

namespace ehm::config {

/// Parses a TOML file; a syntax error names file, line and column.
toml::table parse_toml_file(const std::string& file);
/// "file:line"
std::string where(const std::string& file, const toml::node& node);
/// Shortest text that reads back as the same number.
std::string number_text(double value);
/// "; did you mean 'x'?" for the nearest known key, or where the known ones are listed.
std::string suggestion(const std::string& key, const std::vector<std::string>& known);

class TableReader {
 public:
  TableReader(std::string file, std::string name, const toml::table& table);

  double real(const std::string& key, double min, double max);
  double real_or(const std::string& key, double fallback, double min, double max);
  std::int64_t integer(const std::string& key, std::int64_t min, std::int64_t max);
  bool flag(const std::string& key);
  std::string text(const std::string& key);
  std::string text_or(const std::string& key, const std::string& fallback);
  std::string choice(const std::string& key, const std::vector<std::string>& allowed);
  std::vector<std::int64_t> integers(const std::string& key, std::int64_t min, std::int64_t max);
  bool has(const std::string& key) const { return table_.contains(key); }
  bool is_text(const std::string& key) const { return table_[key].is_string(); }
  /// "file:line" of the table
  std::string place() const { return where(file_, table_); }
  /// Refuses keys that nobody asked for. Call last.
  void finish() const;

 private:
  const toml::node& require(const std::string& key, const std::string& allowed);
  [[noreturn]] void refuse(const std::string& key, const std::string& what, const std::string& allowed) const;

  std::string file_, name_;
  const toml::table& table_;
  std::vector<std::string> asked_;
};

}  // namespace ehm::config
