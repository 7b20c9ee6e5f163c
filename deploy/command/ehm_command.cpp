// SPDX-License-Identifier: Apache-2.0
// ehm_command: arguments -> order -> who listens -> channel by name -> SimCommand or MonitorCommand -> replies -> exit
// code.

#include <spdlog/fmt/fmt.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <iostream>
#include <string>

#include "deploy/client/client_options.h"
#include "deploy/client/number_check.h"
#include "deploy/command/channel_name.h"
#include "deploy/command/command_link.h"
#include "deploy/command/order.h"
#include "deploy/command/order_answer.h"
#include "deploy/runtime/config/man_page.h"
#include "deploy/runtime/config/usage_answer.h"
#include "deploy/runtime/service/exit_code.h"
#include "deploy/runtime/service/written.h"

namespace {

using namespace ehm;
using namespace ehm::operating;

constexpr const char* purpose =
    "Gives orders to the simulator and to the monitors, and says what became of them.\n"
    "Sensors and health parameters have the names that the running engine describes; capitals need not be right\n"
    "where that leaves one name. Who listens is to answer: 0 is returned if all carried the order out, 1 if one\n"
    "refused or was silent, or if nobody listens.";

struct Options {
  client::ClientOptions client;
  std::uint32_t engine = 1;
  double timeout_s = 5.0;
  bool json = false;
  Order order;
};

/// What was looked for and not found.
template <class Command>
std::string nobody(const CommandLink<Command>& link, const Options& options) {
  std::string text = fmt::format("nobody carries out {} of engine {} on domain {}, partition '{}': within {} s ",
                                 idl::Topic<Command>::name, options.engine, options.client.domain,
                                 options.client.partition, options.timeout_s);
  text += link.readers() == 0 ? "no reader of the topic" : fmt::format("{} reader(s) of the topic", link.readers());
  if (link.addressees().empty())
    text += std::is_same_v<Command, MonitorCommand> ? ", no monitor that describes this engine"
                                                    : ", no simulator that describes this engine";
  for (const std::uint32_t other : link.other_engines())
    text += fmt::format("{}{}", other == *link.other_engines().begin() ? "; there is engine " : ", ", other);
  return text + "; is it running, on this domain and partition?";
}

std::string silence(const Addressee& addressee, double timeout_s) {
  const auto& d = addressee.description;
  return who(d.role(), d.source_id()) +
         (addressee.answers
              ? fmt::format(": no answer within {} s", timeout_s)
              : ": no answer, for it writes no CommandReply (hardware, a replay, or a program of an earlier "
                "version); what it made of the order is not known");
}

template <class Command>
int give(Options& options) {
  idl::Participant participant(client::participant_options(options.client, "ehm_command"));
  CommandLink<Command> link(participant, options.engine);
  if (!link.find(options.timeout_s)) {
    std::cerr << "ehm_command: " << nobody(link, options) << '\n';
    return service::exit_failed;
  }
  const idl::OrderedChannel channel = address(options.order, options.engine, link.descriptions());
  const auto& command = std::get<Command>(options.order.command);
  OrderAnswer report{.topic = idl::Topic<Command>::name,
                     .partition = options.client.partition,
                     .domain = options.client.domain,
                     .engine_id = options.engine,
                     .readers = link.readers(),
                     .order = idl::order_text(command, channel)};
  if (!options.json) std::cout << opening(report) << std::flush;
  link.send(command, options.timeout_s, [&](const CommandReply& reply) {
    report.replies.push_back(reply);
    if (!options.json) std::cout << line(reply) << std::flush;
  });
  for (const auto& [number, addressee] : link.addressees())
    if (!addressee.answered) report.unanswered.push_back(silence(addressee, options.timeout_s));
  if (report.replies.empty() && report.unanswered.empty())
    report.unanswered.push_back(fmt::format("no answer of anybody within {} s", options.timeout_s));
  if (options.json)
    std::cout << json(report);
  else
    for (const auto& text : report.unanswered) std::cout << text << '\n';
  return report.accepted() ? service::exit_ok : service::exit_failed;
}

void add_options(CLI::App& app, Options& options) {
  app.footer(service::exit_code_help);
  client::add_client_options(app, options.client);
  app.add_option("--engine", options.engine,
                 "engine_id that the order is for; 0 is every engine, for reset and publish only")
      ->check(CLI::Range(0u, 4294967295u))
      ->capture_default_str();
  app.add_option("--timeout,--timeout-s", options.timeout_s,
                 "seconds to wait for somebody who listens, and then for the replies")
      ->check(client::finite_number(0.1, 3600.0))
      ->capture_default_str();
  app.add_flag("--json", options.json, "print one JSON object instead of lines");
  app.set_version_flag("--version", std::string("ehm_command " EHM_VERSION));
  config::add_man_flag(app, {.app = &app});
  add_orders(app, options.order);
}

int run(int argc, char** argv) {
  Options options;
  CLI::App app{purpose, "ehm_command"};
  add_options(app, options);
  try {
    app.parse(argc, argv);
    if (options.engine == 0 && std::holds_alternative<SimCommand>(options.order.command))
      throw CLI::ValidationError("--engine",
                                 "0 (every engine) is for reset and publish only; allowed is 1 to 4294967295");
  } catch (const CLI::ParseError& e) {
    return config::usage_answer(app, e);
  }
  try {
    client::check_files(options.client);
  } catch (const idl::DdsError& e) {
    std::cerr << "ehm_command: " << e.what() << '\n';
    return service::exit_usage;
  }
  try {
    const bool for_monitors = std::holds_alternative<MonitorCommand>(options.order.command);
    return for_monitors ? give<MonitorCommand>(options) : give<SimCommand>(options);
  } catch (const UnknownChannel& e) {
    std::cerr << "ehm_command: " << e.what() << '\n';
    return service::exit_usage;
  } catch (const std::exception& e) {
    std::cerr << "ehm_command: " << e.what() << '\n';
    return service::exit_failed;
  }
}

}  // namespace

int main(int argc, char** argv) {
  return ehm::service::written(run(argc, argv), std::cout, std::cerr, "ehm_command");
}
