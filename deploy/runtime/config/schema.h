// SPDX-License-Identifier: Apache-2.0
#pragma once
// One configuration schema a program: key, default, range, unit and description stand once, and the TOML file, the
// environment, the command line, the validation messages, --help and the printed reference all come from it.
//
// Precedence, lowest first: default, TOML file, environment (EHM_<SECTION>_<KEY>), command line (--section-key).
//
// @throws ConfigError with origin (file and line, variable or flag), key, value, allowed range.

#include <toml++/impl/forward_declarations.h>

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "deploy/runtime/config/config_error.h"

namespace CLI {
class App;
}

namespace ehm::config {

class Schema {
 public:
  /// Each value already holds its default. Keys are "section.name" with words joined by '_'.
  void real(const std::string& key, double& value, double min, double max, const std::string& unit,
            const std::string& description);
  void integer(const std::string& key, std::int64_t& value, std::int64_t min, std::int64_t max, const std::string& unit,
               const std::string& description);
  void text(const std::string& key, std::string& value, const std::string& description);
  void flag(const std::string& key, bool& value, const std::string& description);
  void choice(const std::string& key, std::string& value, const std::vector<std::string>& allowed,
              const std::string& description);
  /// A short flag that means the same as the key's own, such as "--record" for record.file.
  void alias(const std::string& key, const std::string& flag);
  /// A structured section (array of tables) that the program parses itself, see table_reader.h; after all keys, on
  /// whose values it may depend.
  void tables(const std::string& key, const std::string& description,
              const std::function<void(const std::string& file, const toml::array&)>& parse);

  /// Adds one --section-key option per key; their values wait until load() has run.
  void add_flags(CLI::App& app);
  /// Default, file (skipped if empty), environment, flags, in this order.
  void load(const std::string& file);
  /// Keys that load() has found anywhere, then the structured sections that the file has.
  std::vector<std::string> given() const;
  static constexpr const char* flag_group = "Configuration";  ///< of the options that add_flags() makes

  struct KeyText {
    std::string name, description, allowed, default_text;
    std::string alias;  ///< short flag; empty: none
  };
  std::vector<KeyText> keys() const;
  /// Name and description of the structured sections.
  std::vector<KeyText> table_keys() const;
  /// The present text of each key, tables apart: to tell what a second load changed.
  std::map<std::string, std::string> values() const;
  /// The complete TOML file with defaults, ranges, units and descriptions as comments.
  std::string reference() const;

 private:
  struct Entry {
    std::string key, unit, description;
    std::variant<double*, std::int64_t*, std::string*, bool*> value;
    double min = 0, max = 0;
    std::vector<std::string> allowed;
    std::string default_text;
    std::string alias;
    std::string flag_text;  // as given on the command line
    bool flag_given = false;
    bool given = false;
    std::string allowed_text() const;
    std::string value_text() const;
  };
  struct Tables {
    std::string key, description;
    std::function<void(const std::string&, const toml::array&)> parse;
    bool given = false;
  };

  void add(Entry entry);
  void refuse_misspelt_environment() const;
  void parse_tables(const std::string& file, const toml::table& content);
  void load_table(const std::string& file, const std::string& prefix, const toml::table& table);
  static void assign(Entry& entry, const toml::node& node, const std::string& origin);
  static void assign_text(Entry& entry, const std::string& text, const std::string& origin);
  static void check(const Entry& entry, double number, const std::string& origin);

  std::vector<Entry> entries_;
  std::vector<Tables> tables_;
};

/// "section.some_key" as --section-some-key and as EHM_SECTION_SOME_KEY.
std::string flag_name(const std::string& key);
std::string environment_name(const std::string& key);

}  // namespace ehm::config
