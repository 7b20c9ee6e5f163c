// SPDX-License-Identifier: Apache-2.0
#include "deploy/runtime/config/man_page.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cctype>
#include <sstream>

namespace ehm::config {

namespace {

/// Text as roff: a backslash is none of its commands, a minus stays one, and a line that starts like a request is text.
/// A list without blanks, as that of an option's values, may break behind each comma.
std::string roff(const std::string& text) {
  std::string out;
  bool line_start = true;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (line_start && (c == '.' || c == '\'')) out += "\\&";
    line_start = c == '\n';
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else
      out += c;
    if (c == ',' && i + 1 < text.size() && text[i + 1] != ' ' && text[i + 1] != '\n') out += "\\:";
  }
  return out;
}

std::string bold(const std::string& text) {
  return "\\fB" + roff(text) + "\\fR";
}

/// One paragraph that keeps the text's own lines.
void paragraph(std::ostream& out, const std::string& text) {
  std::istringstream lines(text);
  std::string request = ".PP\n";
  for (std::string line; std::getline(lines, line); request = ".br\n")
    if (!line.empty()) out << request << roff(line) << '\n';
}

/// "Flies a turbofan. More." is "flies a turbofan".
std::string name_line(const CLI::App& app) {
  std::string text = app.get_description();
  text = text.substr(0, std::min(text.find('\n'), text.find(". ")));
  if (text.ends_with('.')) text.pop_back();
  if (!text.empty()) text[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(text[0])));
  return text;
}

/// The commands, or the option groups, which CLI11 keeps as commands without a name.
std::vector<const CLI::App*> subcommands(const CLI::App& app, bool groups) {
  return app.get_subcommands([&](const CLI::App* sub) { return sub->get_name().empty() == groups; });
}

/// As --help writes it; the keys of a schema have a section of their own.
void options(std::ostream& out, const CLI::App& app, bool with_configuration) {
  const CLI::Formatter format;
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_group().empty() || (!with_configuration && option->get_group() == Schema::flag_group)) continue;
    const bool positional = option->get_positional();
    out << ".TP\n"
        << bold(format.make_option_name(option, positional)) << roff(format.make_option_opts(option)) << '\n'
        << roff(option->get_description()) << '\n';
  }
  for (const CLI::App* group : subcommands(app, true)) options(out, *group, with_configuration);
}

/// One section a command, those of a command behind it.
void command_sections(std::ostream& out, const CLI::App& app, const std::string& before) {
  for (const CLI::App* command : subcommands(app, false)) {
    const std::string name = before + command->get_name();
    out << ".SS " << roff(name) << '\n';
    paragraph(out, command->get_description());
    options(out, *command, true);
    if (command->get_footer() != app.get_footer()) paragraph(out, command->get_footer());  // inherited otherwise
    command_sections(out, *command, name + " ");
  }
}

void commands(std::ostream& out, const CLI::App& app) {
  if (subcommands(app, false).empty()) return;
  out << ".SH COMMANDS\n";
  command_sections(out, app, "");
}

void configuration(std::ostream& out, const Schema& schema) {
  out << ".SH CONFIGURATION\n"
      << roff(
             "A key is set in the TOML file of --config, by its environment variable, or by its flag; the later ones "
             "win.\n");
  std::string section;
  for (const auto& key : schema.keys()) {
    const std::string its_section = key.name.substr(0, key.name.find('.'));
    if (its_section != section) out << ".SS [" << roff(its_section) << "]\n";
    section = its_section;
    out << ".TP\n"
        << bold(key.name) << " = " << roff(key.default_text) << '\n'
        << roff(key.description) << ": " << roff(key.allowed) << ".\n.br\n"
        << bold(flag_name(key.name)) << ", " << (key.alias.empty() ? "" : bold(key.alias) + ", ")
        << bold(environment_name(key.name)) << '\n';
  }
  for (const auto& table : schema.table_keys())
    out << ".SS [[" << roff(table.name) << "]]\n" << roff(table.description) << ".\n";
}

void files(std::ostream& out, const std::string& program) {
  std::string unit = "ehm-" + program;
  std::replace(unit.begin(), unit.end(), '_', '-');
  out << ".SH FILES\n.TP\n"
      << bold("/etc/ehm/" + program + ".toml") << "\nconfiguration of the packaged service " << roff(unit)
      << ".service\n.TP\n"
      << bold("/etc/default/" + unit) << "\nits environment\n";
}

void see_also(std::ostream& out, const std::string& program) {
  constexpr std::array pages{std::pair{"ehm_command", 1}, std::pair{"ehm_watch", 1}, std::pair{"engine_sim", 8},
                             std::pair{"monitor", 8}, std::pair{"tuner_design", 1}};
  out << ".SH SEE ALSO\n";
  std::string separator;
  for (const auto& [name, section] : pages) {
    if (name == program) continue;
    out << separator << bold(name) << '(' << section << ')';
    separator = ",\n";
  }
  out << '\n';
}

}  // namespace

std::string man_page(const ManPage& page) {
  const CLI::App& app = *page.app;
  const CLI::App& with_commands = page.commands ? *page.commands : app;
  const std::string name = app.get_name();
  std::ostringstream out;
  out << ".TH " << name << ' ' << (page.schema ? 8 : 1) << " \"\" \"" << name << ' ' << EHM_VERSION
      << "\" \"Engine health monitor\"\n"
      << ".nh\n.ad l\n"  // names and keys are neither hyphenated nor spread over the line
      << ".SH NAME\n"
      << name << " \\- " << roff(name_line(app)) << '\n'
      << ".SH SYNOPSIS\n"
      << bold(name) << " [OPTIONS]\n";
  if (!subcommands(with_commands, false).empty()) out << ".br\n" << bold(name) << " COMMAND [OPTIONS]\n";
  out << ".SH DESCRIPTION\n";
  paragraph(out, app.get_description());
  out << ".SH OPTIONS\n";
  options(out, app, false);
  commands(out, with_commands);
  if (page.schema) configuration(out, *page.schema);
  out << ".SH EXIT STATUS\n";
  paragraph(out, app.get_footer());
  if (page.schema) files(out, name);
  see_also(out, name);
  return out.str();
}

void add_man_flag(CLI::App& app, const ManPage& page) {
  app.add_flag_callback(
      "--man",
      [page] {
        std::string text = man_page(page);
        text.pop_back();  // the line end comes with the printing
        throw CLI::CallForVersion(text, 0);
      },
      "print the manual page in roff, and exit; read it with: man -l");
}

}  // namespace ehm::config
