// SPDX-License-Identifier: Apache-2.0
#include "deploy/runtime/config/table_reader.h"

#include <algorithm>
#include <charconv>
#include <sstream>

#include "deploy/runtime/config/nearest_name.h"
#include "deploy/runtime/config/schema.h"
#include "deploy/runtime/files/file_error.h"
#include "deploy/runtime/files/input_file.h"

namespace ehm::config {

toml::table parse_toml_file(const std::string& file) {
  try {
    return toml::parse(files::read_input_file(file, files::configuration_file), file);
  } catch (const files::FileError& e) {
    throw ConfigError(e.what());
  } catch (const toml::parse_error& e) {
    std::ostringstream message;
    message << file << ':' << e.source().begin.line << ':' << e.source().begin.column
            << ": not valid TOML: " << e.description();
    throw ConfigError(message.str());
  }
}

std::string where(const std::string& file, const toml::node& node) {
  return file + ":" + std::to_string(node.source().begin.line);
}

std::string number_text(double value) {
  char buffer[32];
  const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, value);
  return error == std::errc() ? std::string(buffer, end) : std::string("?");
}

std::string suggestion(const std::string& key, const std::vector<std::string>& known) {
  const std::string best = nearest_name(key, known);
  return best.empty() ? "; the reference lists the known ones (--print-config)" : "; did you mean '" + best + "'?";
}

TableReader::TableReader(std::string file, std::string name, const toml::table& table)
    : file_(std::move(file)), name_(std::move(name)), table_(table) {}

void TableReader::refuse(const std::string& key, const std::string& what, const std::string& allowed) const {
  const toml::node* node = table_.get(key);
  throw ConfigError(where(file_, node ? *node : static_cast<const toml::node&>(table_)) + ": '" + name_ + "." + key +
                    "' " + what + ", allowed is " + allowed);
}

const toml::node& TableReader::require(const std::string& key, const std::string& allowed) {
  asked_.push_back(key);
  const toml::node* node = table_.get(key);
  if (!node) refuse(key, "is missing", allowed);
  return *node;
}

double TableReader::real(const std::string& key, double min, double max) {
  const std::string allowed = "a number from " + number_text(min) + " to " + number_text(max);
  const toml::node& node = require(key, allowed);
  if (!node.is_number()) refuse(key, "is not a number", allowed);
  const double value = *node.value<double>();
  if (!(value >= min && value <= max)) refuse(key, "is " + number_text(value), allowed);
  return value;
}

double TableReader::real_or(const std::string& key, double fallback, double min, double max) {
  asked_.push_back(key);
  return has(key) ? real(key, min, max) : fallback;
}

std::int64_t TableReader::integer(const std::string& key, std::int64_t min, std::int64_t max) {
  const std::string allowed = "a whole number from " + std::to_string(min) + " to " + std::to_string(max);
  const toml::node& node = require(key, allowed);
  if (!node.is_integer()) refuse(key, "is not a whole number", allowed);
  const auto value = *node.value<std::int64_t>();
  if (value < min || value > max) refuse(key, "is " + std::to_string(value), allowed);
  return value;
}

bool TableReader::flag(const std::string& key) {
  const toml::node& node = require(key, "true or false");
  if (!node.is_boolean()) refuse(key, "is neither true nor false", "true or false");
  return *node.value<bool>();
}

std::string TableReader::text(const std::string& key) {
  const toml::node& node = require(key, "a text");
  if (!node.is_string()) refuse(key, "is not a text", "a text");
  return *node.value<std::string>();
}

std::string TableReader::text_or(const std::string& key, const std::string& fallback) {
  asked_.push_back(key);
  return has(key) ? text(key) : fallback;
}

std::string TableReader::choice(const std::string& key, const std::vector<std::string>& allowed) {
  std::string list = "one of";
  for (const auto& a : allowed) list += (a == allowed.front() ? " " : ", ") + a;
  const toml::node& node = require(key, list);
  if (!node.is_string()) refuse(key, "is not a text", list);
  const std::string value = *node.value<std::string>();
  if (std::find(allowed.begin(), allowed.end(), value) == allowed.end()) refuse(key, "is '" + value + "'", list);
  return value;
}

std::vector<std::int64_t> TableReader::integers(const std::string& key, std::int64_t min, std::int64_t max) {
  const std::string allowed = "an array of whole numbers from " + std::to_string(min) + " to " + std::to_string(max);
  const toml::node& node = require(key, allowed);
  if (!node.is_array()) refuse(key, "is not an array", allowed);
  std::vector<std::int64_t> values;
  for (const auto& element : *node.as_array()) {
    if (!element.is_integer()) refuse(key, "has an element that is no whole number", allowed);
    const auto value = *element.value<std::int64_t>();
    if (value < min || value > max) refuse(key, "has " + std::to_string(value), allowed);
    values.push_back(value);
  }
  return values;
}

void TableReader::finish() const {
  for (const auto& [name, node] : table_) {
    const std::string key(name.str());
    if (std::find(asked_.begin(), asked_.end(), key) == asked_.end())
      throw ConfigError(where(file_, node) + ": unknown key '" + name_ + "." + key + "'" + suggestion(key, asked_));
  }
}

}  // namespace ehm::config
