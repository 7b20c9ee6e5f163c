// SPDX-License-Identifier: Apache-2.0
#include "monitor/history/history_command.h"

#include <CLI/CLI.hpp>
#include <ostream>
#include <string>

#include "deploy/runtime/config/usage_answer.h"
#include "deploy/runtime/files/file_error.h"
#include "deploy/runtime/service/exit_code.h"
#include "monitor/history/history_folder.h"
#include "monitor/history/history_text.h"
#include "monitor/realtime/clock.h"

namespace ehm::monitor {

struct HistoryQuestion {
  std::uint32_t engine = 0, flight = 0;
  std::string directory, note;
  double egt_limit_k = 0.0;
  bool json = false, wash = false, replacement = false;
};

namespace {

const Flight& flight_of(const FlightHistory& history, const HistoryQuestion& question) {
  std::uint32_t last = 0;
  for (auto it = history.entries.rbegin(); it != history.entries.rend(); ++it) {
    if (!it->flight) continue;
    if (it->flight->number == question.flight) return *it->flight;
    last = std::max(last, it->flight->number);
  }
  throw files::FileError(flights_path(question.directory, question.engine) + ": has no flight " +
                         std::to_string(question.flight) + ", the latest is " + std::to_string(last));
}

void note_maintenance(const HistoryQuestion& question, std::ostream& out) {
  const auto kind = question.wash ? Maintenance::Kind::wash : Maintenance::Kind::replacement;
  add_to_history(question.directory, question.engine, to_line(Maintenance{kind, wall_clock_ns(), question.note}));
  out << "noted; a monitor takes it into account when it starts\n";
}

void answer(const HistoryQuestion& question, std::ostream& out) {
  if (question.wash || question.replacement) return note_maintenance(question, out);
  const FlightHistory history = read_history(question.directory, question.engine);
  if (question.json) {
    for (const HistoryEntry& entry : history.entries)
      out << (entry.flight ? to_line(*entry.flight) : to_line(*entry.maintenance));
  } else if (question.flight != 0) {
    out << flight_text(flight_of(history, question));
  } else {
    out << history_text(question.engine, history, question.egt_limit_k);
  }
}

}  // namespace

std::shared_ptr<HistoryQuestion> add_history_command(CLI::App& app) {
  auto question = std::make_shared<HistoryQuestion>();
  CLI::App* command = app.add_subcommand(
      "history", "The flights of an engine, its EGT margin over them, and what is due; or notes maintenance");
  command->add_option("engine", question->engine, "Its engine_id")->required()->check(CLI::Range(1u, 4294967295u));
  command->add_option("--directory", question->directory, "The monitor's history.directory")
      ->required()
      ->envname("EHM_HISTORY_DIRECTORY")
      ->check(CLI::ExistingDirectory)
      ->type_name("DIR");
  auto* flight = command->add_option("--flight", question->flight, "The summary of this flight instead of the table")
                     ->check(CLI::Range(1u, 4294967295u));
  command->add_option("--egt-limit", question->egt_limit_k, "EGT margin at which the engine is to be taken off, K")
      ->check(CLI::Range(-200.0, 200.0))
      ->capture_default_str();
  auto* json = command->add_flag("--json", question->json, "The lines as they are kept, one JSON object each");
  auto* wash = command->add_flag("--wash", question->wash, "Note that the engine has been washed now");
  auto* replacement =
      command->add_flag("--replacement", question->replacement, "Note that parts of the engine are others now");
  command->add_option("--note", question->note, "What to remember of the maintenance")->type_name("TEXT");
  flight->excludes(json)->excludes(wash)->excludes(replacement);
  wash->excludes(replacement)->excludes(json);
  replacement->excludes(json);
  return question;
}

std::optional<int> run_command(int argc, const char* const* argv, std::ostream& out, std::ostream& err) {
  const std::string command = argc > 1 ? argv[1] : "-";
  if (command.starts_with('-')) return std::nullopt;
  if (command != "history") {
    err << config::unknown_command("monitor", command, {"history"}, "the service's options");
    return service::exit_usage;
  }
  CLI::App app("The engine health monitor.", "monitor");
  app.require_subcommand(1);
  app.footer(service::exit_code_help);
  const auto question = add_history_command(app);
  try {
    app.parse(argc, argv);
    if (!question->note.empty() && !question->wash && !question->replacement)
      throw CLI::ValidationError("--note", "goes with --wash or --replacement");
  } catch (const CLI::ParseError& error) {
    return config::usage_answer(app, error, out, err);
  }
  try {
    answer(*question, out);
    return service::exit_ok;
  } catch (const files::FileError& error) {
    err << "monitor history: " << error.what() << '\n';
    return service::exit_usage;
  }
}

}  // namespace ehm::monitor
