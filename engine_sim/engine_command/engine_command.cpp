// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/engine_command/engine_command.h"

#include <iomanip>
#include <memory>
#include <ostream>
#include <stdexcept>

#include "engine_sim/engine_command/engine_check.h"
#include "engine_sim/engine_command/station_diagram.h"
#include "engine_sim/engines/engine_file.h"
#include "engine_sim/engines/shipped_engines.h"

namespace ehm::engine_sim {
namespace {

using Run = std::function<void(std::ostream&, std::ostream&)>;

struct Arguments {
  std::string engine, out = "-";
};

void export_engine(const Arguments& arguments, std::ostream& out) {
  const auto engine = named_engine(arguments.engine);
  if (arguments.out != "-") return write_engine(*engine, arguments.out);
  if (!(out << engine_text(*engine)).flush()) throw std::runtime_error("standard output: cannot be written");
}

void print_design(const EngineCheck& check, std::ostream& out) {
  if (!check.design_defect.empty()) {
    out << "design point: no steady solution: " << check.design_defect << '\n';
    return;
  }
  out << "design point: solved at the stated fuel flow\n";
  for (const StatedNumber& n : check.design)
    out << "  " << std::left << std::setw(20) << n.name << std::right << std::setw(12) << n.solved << "  stated "
        << std::setw(12) << n.stated << std::fixed << std::setprecision(2) << std::showpos << std::setw(9)
        << 100.0 * n.deviation() << std::noshowpos << " %" << std::defaultfloat << std::setprecision(6)
        << (n.holds() ? "" : "   beyond 2 %") << '\n';
}

void check_and_print(const Arguments& arguments, std::ostream& out) {
  const auto engine = named_engine(arguments.engine);
  out << engine->data.name << ": structure, values and maps are valid, hash " << engine_hash(*engine) << '\n';
  const EngineCheck check = check_engine(engine->data);
  print_design(check, out);
  out << "envelope: " << check.points - check.failed.size() << " of " << check.points << " points converge\n";
  for (const std::string& text : check.failed) out << "  " << text << '\n';
  for (const std::string& text : check.surging) out << "  " << text << '\n';
  out.flush();
  if (!check.passed()) throw std::runtime_error(engine->data.name + ": the engine does not run as its file states");
}

/// One of the three: NAME|FILE and what it does.
CLI::App* add_action(CLI::App& engine, const std::shared_ptr<Arguments>& arguments, Run& run, const char* name,
                     const char* description, void (*action)(const Arguments&, std::ostream&)) {
  CLI::App* command = engine.add_subcommand(name, description);
  command->add_option("engine", arguments->engine, "A shipped engine's name, or an engine file")
      ->required()
      ->type_name("NAME|FILE");
  command->callback([arguments, action, &run] {
    run = [arguments, action](std::ostream& out, std::ostream&) { action(*arguments, out); };
  });
  return command;
}

}  // namespace

void add_engine_command(CLI::App& app, Run& run) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("engine", "Engine files: write a shipped one, check one, show one");
  command->require_subcommand(1);
  command->footer("Shipped engines: " + shipped_engine_names() + ". An engine file is described in engine_files.md.");
  add_action(*command, arguments, run, "export", "Write an engine as a file", export_engine)
      ->add_option("--out", arguments->out, "File to write; - is the standard output")
      ->type_name("FILE.json")
      ->capture_default_str();
  add_action(*command, arguments, run, "check",
             "Is the file valid, does the design point close, does the envelope converge?", check_and_print);
  add_action(*command, arguments, run, "show", "Station diagram with the values of the design point",
             [](const Arguments& a, std::ostream& out) { print_engine(*named_engine(a.engine), out); });
}

}  // namespace ehm::engine_sim
