// SPDX-License-Identifier: Apache-2.0
#include "deploy/runtime/config/schema.h"

#include <toml++/toml.h>
#include <unistd.h>

#include <CLI/App.hpp>
#include <algorithm>
#include <cassert>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <sstream>

#include "deploy/runtime/config/nearest_name.h"
#include "deploy/runtime/config/table_reader.h"

namespace ehm::config {

std::string flag_name(const std::string& key) {
  std::string name = "--" + key;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c == '.' || c == '_'; }, '-');
  return name;
}

std::string environment_name(const std::string& key) {
  std::string name = "EHM_" + key;
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return c == '.' ? '_' : static_cast<char>(std::toupper(c)); });
  return name;
}

std::string Schema::Entry::allowed_text() const {
  if (!allowed.empty()) {
    std::string text;
    for (const auto& a : allowed) text += (text.empty() ? "" : ", ") + a;
    return "one of " + text;
  }
  if (std::holds_alternative<bool*>(value)) return "true or false";
  if (std::holds_alternative<std::string*>(value)) return "a text";
  const bool whole = std::holds_alternative<std::int64_t*>(value);
  return std::string(whole ? "a whole number" : "a number") + " from " + number_text(min) + " to " + number_text(max) +
         (unit.empty() ? "" : " " + unit);
}

std::string Schema::Entry::value_text() const {
  if (auto* const* v = std::get_if<double*>(&value)) return number_text(**v);
  if (auto* const* v = std::get_if<std::int64_t*>(&value)) return std::to_string(**v);
  if (auto* const* v = std::get_if<bool*>(&value)) return **v ? "true" : "false";
  return '"' + *std::get<std::string*>(value) + '"';
}

void Schema::add(Entry entry) {
  entry.default_text = entry.value_text();
  entries_.push_back(std::move(entry));
}

void Schema::real(const std::string& key, double& value, double min, double max, const std::string& unit,
                  const std::string& description) {
  add({key, unit, description, &value, min, max, {}, {}, {}, {}, false, false});
}

void Schema::integer(const std::string& key, std::int64_t& value, std::int64_t min, std::int64_t max,
                     const std::string& unit, const std::string& description) {
  add({key,
       unit,
       description,
       &value,
       static_cast<double>(min),
       static_cast<double>(max),
       {},
       {},
       {},
       {},
       false,
       false});
}

void Schema::text(const std::string& key, std::string& value, const std::string& description) {
  add({key, "", description, &value, 0, 0, {}, {}, {}, {}, false, false});
}

void Schema::flag(const std::string& key, bool& value, const std::string& description) {
  add({key, "", description, &value, 0, 0, {}, {}, {}, {}, false, false});
}

void Schema::choice(const std::string& key, std::string& value, const std::vector<std::string>& allowed,
                    const std::string& description) {
  add({key, "", description, &value, 0, 0, allowed, {}, {}, {}, false, false});
}

void Schema::alias(const std::string& key, const std::string& flag) {
  const auto entry = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& e) { return e.key == key; });
  assert(entry != entries_.end());
  entry->alias = flag;
}

void Schema::tables(const std::string& key, const std::string& description,
                    const std::function<void(const std::string&, const toml::array&)>& parse) {
  tables_.push_back({key, description, parse, false});
}

void Schema::add_flags(CLI::App& app) {
  for (auto& entry : entries_) {
    // Entries may move while the schema grows: flags are added last, so a pointer to the entry is stable here.
    Entry* target = &entry;
    CLI::Option* option = app.add_option_function<std::string>(
                                 flag_name(entry.key) + (entry.alias.empty() ? "" : "," + entry.alias),
                                 [target](const std::string& text) {
                                   const bool alone = text.empty() && std::holds_alternative<bool*>(target->value);
                                   target->flag_text = alone ? "true" : text;  // a switch
                                   target->flag_given = true;
                                 },
                                 entry.description + " [" + entry.allowed_text() + "; default " + entry.default_text +
                                     "; " + environment_name(entry.key) + "]")
                              ->type_name("")
                              ->take_last()
                              ->group(flag_group);
    if (std::holds_alternative<bool*>(entry.value)) option->expected(0, 1);
  }
}

void Schema::load(const std::string& file) {
  const toml::table content = file.empty() ? toml::table() : parse_toml_file(file);
  load_table(file, "", content);
  refuse_misspelt_environment();
  for (auto& entry : entries_)
    if (const char* text = std::getenv(environment_name(entry.key).c_str()))
      assign_text(entry, text, "environment variable " + environment_name(entry.key));
  for (auto& entry : entries_)
    if (entry.flag_given) assign_text(entry, entry.flag_text, "flag " + flag_name(entry.key));
  parse_tables(file, content);
}

void Schema::parse_tables(const std::string& file, const toml::table& content) {
  for (Tables& tables : tables_)
    if (const auto node = content.at_path(tables.key)) {
      tables.given = true;
      tables.parse(file, *node.as_array());
    }
}

/// A typing error in the name of EHM_DDS_SECURITY must not mean that the service flies without security. Names that are
/// far from all known ones belong to another program.
void Schema::refuse_misspelt_environment() const {
  std::vector<std::string> known;
  for (const auto& entry : entries_) known.push_back(environment_name(entry.key));
  for (char** variable = environ; *variable != nullptr; ++variable) {
    const std::string text = *variable;
    const std::string name = text.substr(0, text.find('='));
    if (!name.starts_with("EHM_") || std::find(known.begin(), known.end(), name) != known.end()) continue;
    if (const std::string meant = nearest_name(name, known); !meant.empty())
      throw ConfigError("environment variable " + name + ": unknown; did you mean '" + meant + "'?");
  }
}

void Schema::load_table(const std::string& file, const std::string& prefix, const toml::table& table) {
  for (const auto& [name, node] : table) {
    const std::string key = prefix + std::string(name.str());
    const std::string origin = where(file, node);
    const auto entry = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& e) { return e.key == key; });
    if (entry != entries_.end()) {
      assign(*entry, node, origin);
      continue;
    }
    const auto tables = std::find_if(tables_.begin(), tables_.end(), [&](const Tables& t) { return t.key == key; });
    if (tables != tables_.end()) {
      if (!node.is_array_of_tables())
        throw ConfigError(origin + ": '" + key + "' must be tables, written [[" + key + "]]");
      continue;
    }
    const std::string section = key + ".";
    const bool is_section =
        std::any_of(entries_.begin(), entries_.end(), [&](const Entry& e) { return e.key.starts_with(section); }) ||
        std::any_of(tables_.begin(), tables_.end(), [&](const Tables& t) { return t.key.starts_with(section); });
    if (is_section && node.is_table()) {
      load_table(file, section, *node.as_table());
      continue;
    }
    std::vector<std::string> known;
    for (const auto& e : entries_) known.push_back(e.key);
    for (const auto& t : tables_) known.push_back(t.key);
    throw ConfigError(origin + ": unknown key '" + key + "'" + suggestion(key, known));
  }
}

void Schema::check(const Entry& entry, double number, const std::string& origin) {
  if (!(number >= entry.min && number <= entry.max))
    throw ConfigError(origin + ": '" + entry.key + "' is " + number_text(number) + ", allowed is " +
                      entry.allowed_text());
}

void Schema::assign(Entry& entry, const toml::node& node, const std::string& origin) {
  entry.given = true;
  const auto wrong_type = [&] {
    return ConfigError(origin + ": '" + entry.key + "' has the wrong type, allowed is " + entry.allowed_text());
  };
  if (auto* real_value = std::get_if<double*>(&entry.value)) {
    const auto number = node.value<double>();
    if (!number || node.is_boolean()) throw wrong_type();
    check(entry, *number, origin);
    **real_value = *number;
  } else if (auto* whole = std::get_if<std::int64_t*>(&entry.value)) {
    if (!node.is_integer()) throw wrong_type();
    check(entry, static_cast<double>(*node.value<std::int64_t>()), origin);
    **whole = *node.value<std::int64_t>();
  } else if (auto* boolean = std::get_if<bool*>(&entry.value)) {
    if (!node.is_boolean()) throw wrong_type();
    **boolean = *node.value<bool>();
  } else {
    if (!node.is_string()) throw wrong_type();
    assign_text(entry, *node.value<std::string>(), origin);
  }
}

void Schema::assign_text(Entry& entry, const std::string& text, const std::string& origin) {
  entry.given = true;
  const auto wrong = [&] {
    return ConfigError(origin + ": '" + entry.key + "' is '" + text + "', allowed is " + entry.allowed_text());
  };
  if (auto* string_value = std::get_if<std::string*>(&entry.value)) {
    if (!entry.allowed.empty() && std::find(entry.allowed.begin(), entry.allowed.end(), text) == entry.allowed.end())
      throw wrong();
    **string_value = text;
  } else if (auto* boolean = std::get_if<bool*>(&entry.value)) {
    if (text != "true" && text != "false") throw wrong();
    **boolean = text == "true";
  } else if (auto* whole = std::get_if<std::int64_t*>(&entry.value)) {
    std::int64_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size()) throw wrong();
    check(entry, static_cast<double>(number), origin);
    **whole = number;
  } else {
    double number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size()) throw wrong();
    check(entry, number, origin);
    *std::get<double*>(entry.value) = number;
  }
}

std::vector<Schema::KeyText> Schema::keys() const {
  std::vector<KeyText> list;
  for (const auto& e : entries_) list.push_back({e.key, e.description, e.allowed_text(), e.default_text, e.alias});
  return list;
}

std::vector<Schema::KeyText> Schema::table_keys() const {
  std::vector<KeyText> list;
  for (const auto& t : tables_) list.push_back({t.key, t.description, "", "", ""});
  return list;
}

std::map<std::string, std::string> Schema::values() const {
  std::map<std::string, std::string> values;
  for (const Entry& entry : entries_) values[entry.key] = entry.value_text();
  return values;
}

std::vector<std::string> Schema::given() const {
  std::vector<std::string> keys;
  for (const Entry& entry : entries_)
    if (entry.given) keys.push_back(entry.key);
  for (const Tables& tables : tables_)
    if (tables.given) keys.push_back(tables.key);
  return keys;
}

std::string Schema::reference() const {
  std::ostringstream out;
  std::string section;
  for (const auto& entry : entries_) {
    const auto dot = entry.key.find('.');
    const std::string its_section = entry.key.substr(0, dot);
    if (its_section != section) {
      out << (section.empty() ? "" : "\n") << '[' << its_section << "]\n";
      section = its_section;
    }
    out << "# " << entry.description << " (" << entry.allowed_text() << ")\n"
        << entry.key.substr(dot + 1) << " = " << entry.default_text << '\n';
  }
  for (const auto& t : tables_) out << "\n# [[" << t.key << "]]: " << t.description << '\n';
  return out.str();
}

}  // namespace ehm::config
