// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/deck/deck_command.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <ostream>
#include <thread>

#include "deploy/runtime/files/atomic_file.h"
#include "deploy/runtime/files/file_error.h"
#include "deploy/runtime/long_work/progress_bar.h"
#include "deploy/runtime/service/stop_signal.h"
#include "engine_sim/deck/deck.h"
#include "engine_sim/deck/deck_columns.h"
#include "engine_sim/engines/shipped_engines.h"

namespace ehm::engine_sim {
namespace {

using files::FileError;

struct Arguments {
  std::string cases, out, engine = "jt9d";
  unsigned threads = std::max(1u, std::thread::hardware_concurrency());
  bool verbose = false;
};

/// The deck's file, or the standard output.
class DeckOut {
 public:
  DeckOut(const std::string& path, std::ostream& out) : out_(out) {
    if (path != "-") file_.emplace(path);
  }
  void write(std::string_view text) {
    if (file_) return file_->write(text);
    if (!(out_ << text)) throw std::runtime_error("standard output: cannot be written");
  }
  void commit() {
    if (file_) return file_->commit();
    if (!out_.flush()) throw std::runtime_error("standard output: cannot be written");
  }

 private:
  std::ostream& out_;
  std::optional<files::AtomicFile> file_;
};

void require_other_file(const Arguments& arguments) {
  std::error_code absent;
  if (std::filesystem::equivalent(arguments.cases, arguments.out, absent) &&
      std::filesystem::is_regular_file(arguments.out, absent))
    throw FileError(arguments.out + ": --out is the file of the cases itself; name another file for the deck");
}

void print_speed(const DeckSummary& summary, unsigned threads, double elapsed_s, std::ostream& err) {
  const auto converged = static_cast<double>(std::max<std::size_t>(1, summary.cases - summary.not_converged));
  const double points_s = static_cast<double>(summary.cases) / elapsed_s;
  err << summary.cases << " cases in " << elapsed_s << " s on " << threads << " threads: " << points_s
      << " points a second, " << points_s / threads << " a thread; "
      << static_cast<double>(summary.newton_iterations) / converged << " Newton iterations a converged case\n";
}

void make_deck(const Arguments& arguments, std::ostream& out, std::ostream& err) {
  require_other_file(arguments);
  const Turbofan engine(named_engine(arguments.engine)->data);
  const DeckCases cases = read_deck_cases(files::read_csv(arguments.cases));
  const service::StopSignal stop;
  DeckOut deck(arguments.out, out);
  long_work::ProgressBar bar(err, isatty(STDERR_FILENO) == 1, cases.cases.size());
  const auto start = std::chrono::steady_clock::now();
  const DeckSummary summary = write_deck(engine, cases, arguments.threads,
                                         {.write = [&](std::string_view text) { deck.write(text); },
                                          .failed =
                                              [&](const DeckCase& one, const std::string& reason) {
                                                bar.clear();
                                                err << cases.file << ':' << one.line << ": no steady point: " << reason
                                                    << '\n';
                                              },
                                          .progress = [&](std::size_t done) { bar.show(done); },
                                          .stopped = [&] { return stop.requested(); }});
  deck.commit();
  bar.clear();
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  if (summary.not_converged > 0) err << summary.not_converged << " of " << summary.cases << " cases did not converge\n";
  if (summary.beyond_surge > 0) err << summary.beyond_surge << " rows lie beyond a surge line (a stall margin < 0)\n";
  if (summary.beyond_ratings > 0) err << summary.beyond_ratings << " rows lie above maximum power\n";
  if (arguments.verbose) print_speed(summary, arguments.threads, elapsed.count(), err);
}

std::string column_help() {
  std::string text = "Columns of the cases, in any order, each a number from ... to:\n";
  for (const DeckInput& input : deck_inputs()) {
    text += "  " + input.name + std::string(28 - input.name.size(), ' ') + files::shortest(input.lowest) + " to " +
            files::shortest(input.highest) + (input.required ? "   required" : "") +
            (input.demand ? "   exactly one of these" : "") + "\n";
  }
  return text + "The deck repeats them and adds converged (1 or 0; 0 leaves the rest of the row empty), flow, total\n" +
         "pressure and temperature of each station, speeds, fuel flow, thrust, stall margins (percent) and EGT margin.";
}

}  // namespace

void add_deck_command(CLI::App& app, std::function<void(std::ostream&, std::ostream&)>& run) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("deck", "Performance deck: one steady point a row");
  command->add_option("--cases", arguments->cases, "Cases, CSV with a header; - is the standard input")
      ->required()
      ->type_name("FILE.csv");
  command->add_option("--out", arguments->out, "Deck to write, CSV; - is the standard output")
      ->required()
      ->type_name("FILE.csv");
  command->add_option("--engine", arguments->engine, "Engine: a shipped one (" + shipped_engine_names() + ") or a file")
      ->type_name("NAME|FILE")
      ->capture_default_str();
  command->add_option("--threads", arguments->threads, "Threads; the deck does not depend on their number")
      ->check(CLI::Range(1u, 1024u))
      ->capture_default_str();
  command->add_flag("--verbose", arguments->verbose, "Say how many points a second were solved");
  command->footer(column_help());
  command->callback([arguments, &run] {
    run = [arguments](std::ostream& out, std::ostream& err) { make_deck(*arguments, out, err); };
  });
}

}  // namespace ehm::engine_sim
