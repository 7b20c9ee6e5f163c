// SPDX-License-Identifier: Apache-2.0
#include "deploy/runtime/config/usage_answer.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <optional>

#include "deploy/runtime/config/nearest_name.h"
#include "deploy/runtime/service/exit_code.h"

namespace ehm::config {

namespace {

/// The program, or its command that was being parsed: "tuner_design design".
struct Parser {
  const CLI::App* app;
  std::string name;

  /// The command behind it on the command line.
  std::optional<Parser> command() const {
    const auto commands = app->get_subcommands();
    if (commands.empty()) return std::nullopt;
    return Parser{commands.back(), name + " " + commands.back()->get_name()};
  }
  std::optional<std::string> unknown_word() const {
    const auto words = app->remaining();
    const auto word = std::find_if(words.begin(), words.end(), [](const std::string& w) { return w != "--"; });
    return word == words.end() ? std::nullopt : std::optional(*word);
  }
};

/// Options with their dashes, those of the groups too.
std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_group().empty()) continue;  // hidden
    for (const auto& name : option->get_lnames()) names.push_back("--" + name);
    for (const auto& name : option->get_snames()) names.push_back("-" + name);
  }
  for (const CLI::App* group : app.get_subcommands([](const CLI::App* sub) { return sub->get_name().empty(); })) {
    const auto more = option_names(*group);
    names.insert(names.end(), more.begin(), more.end());
  }
  return names;
}

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App* sub) { return !sub->get_name().empty(); }))
    names.push_back(command->get_name());
  return names;
}

/// Near as a whole, or without its section: --domain is near --dds-domain.
std::string nearest_option(const std::string& written, const std::vector<std::string>& known) {
  if (std::string whole = nearest_name(written, known); !whole.empty()) return whole;
  std::vector<std::string> without_section;
  for (const auto& name : known) {
    const auto dash = name.find('-', 2);
    without_section.push_back(dash == std::string::npos ? "" : "--" + name.substr(dash + 1));
  }
  const std::string near = nearest_name(written, without_section);
  if (near.empty()) return near;
  return known[static_cast<std::size_t>(std::find(without_section.begin(), without_section.end(), near) -
                                        without_section.begin())];
}

std::string meant_text(const std::string& near) {
  return near.empty() ? "." : "; did you mean " + near + "?";
}

std::string unknown_text(const CLI::App& app, const std::string& word) {
  if (!word.starts_with('-') || word == "-")
    return "unexpected argument '" + word + "'" + meant_text(nearest_name(word, command_names(app)));
  const std::string option = word.substr(0, word.find('='));
  return "unknown option " + option + meant_text(nearest_option(option, option_names(app)));
}

/// As CLI11 says it, as one sentence.
std::string sentence(std::string text) {
  while (!text.empty() && (text.back() == '.' || text.back() == '\n')) text.pop_back();
  return text + ".";
}

}  // namespace

int usage_answer(const CLI::App& app, const CLI::ParseError& error, std::ostream& out, std::ostream& err) {
  if (error.get_exit_code() == 0) return app.exit(error, out, err);
  Parser at{&app, std::filesystem::path(app.get_name()).filename()};
  auto word = at.unknown_word();
  for (auto next = at.command(); !word && next; next = at.command()) {
    at = *next;
    word = at.unknown_word();
  }
  err << at.name << ": " << (word ? unknown_text(*at.app, *word) : sentence(error.what())) << " See " << at.name
      << " --help" << std::endl;
  return service::exit_usage;
}

int usage_answer(const CLI::App& app, const CLI::ParseError& error) {
  return usage_answer(app, error, std::cout, std::cerr);
}

std::string unknown_command(const std::string& program, const std::string& word,
                            const std::vector<std::string>& commands, const std::string& besides) {
  std::string allowed;
  for (const auto& command : commands) allowed += (allowed.empty() ? "" : ", ") + command;
  return program + ": unknown command '" + word + "'" + meant_text(nearest_name(word, commands)) + " Allowed are " +
         allowed + (besides.empty() ? "" : ", or " + besides) + ". See " + program + " --help\n";
}

}  // namespace ehm::config
