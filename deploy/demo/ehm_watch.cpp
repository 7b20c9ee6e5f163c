// SPDX-License-Identifier: Apache-2.0
// ehm_watch: shows the monitor's estimates of one engine, beside their truth where its source tells it, live, and judges
// the run at its end.

#include <unistd.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <chrono>
#include <fastdds/dds/core/condition/WaitSet.hpp>
#include <functional>
#include <iostream>
#include <memory>
#include <optional>

#include "deploy/client/client_options.h"
#include "deploy/demo/terminal_width.h"
#include "deploy/demo/watch_csv.h"
#include "deploy/demo/watch_output.h"
#include "deploy/runtime/config/man_page.h"
#include "deploy/runtime/config/usage_answer.h"
#include "deploy/runtime/service/exit_code.h"
#include "deploy/runtime/service/stop_signal.h"
#include "deploy/runtime/service/written.h"
#include "idl/dds/endpoint.h"
#include "idl/wire_values.h"

namespace {

using namespace ehm;
using Clock = std::chrono::steady_clock;

struct Options {
  client::ClientOptions client;
  std::uint32_t engine = 1;
  double seconds = 0.0;
  double timeout_s = 30.0;
  bool json = false, redundant = false;
  std::string csv;
};

idl::ParticipantOptions participant_options(const Options& options) {
  auto participant = client::participant_options(options.client, "ehm_watch");
  participant.redundancy.exclusive = options.redundant;
  return participant;
}

/// One reader a topic, all emptied into the data.
class Ears {
 public:
  explicit Ears(const Options& options)
      : engine_(options.engine),
        participant_(participant_options(options)),
        truth_(participant_),
        health_(participant_),
        auxiliary_(participant_),
        descriptions_(participant_),
        status_(participant_),
        events_(participant_) {
    wait_set_.attach_condition(health_.condition());
  }
  /// `on_estimate` is called after every health estimate; the auxiliary one of the same sample is mostly there by then.
  void listen(demo::WatchData& data, double seconds, const std::function<void()>& on_estimate) {
    wait_set_.wait(triggered_, eprosima::fastrtps::Duration_t(static_cast<long double>(seconds)));
    take(descriptions_, data);
    take(truth_, data);
    take(auxiliary_, data);
    take(health_, data, on_estimate);
    take(status_, data);
    take(events_, data);
    take(truth_, data);  // of the estimate that came last: it was sent before it
  }
  /// Nobody sends to us any more: stopped (Ctrl-Z) or suspended for so long that we were dropped.
  bool deaf() { return participant_.held_up_s() > 0.0; }

 private:
  template <class T>
  void take(idl::Reader<T>& reader, demo::WatchData& data, const std::function<void()>& then = {}) {
    T sample;
    while (reader.take(sample)) {
      if (sample.engine_id() != engine_) continue;
      if constexpr (requires { data.hear(sample, reader.participant()); })
        data.hear(sample, reader.participant());
      else
        data.hear(sample);
      if (then) then();
    }
  }
  std::uint32_t engine_;
  idl::Participant participant_;
  idl::Reader<EngineTruth> truth_;
  idl::Reader<EngineHealth> health_;
  idl::Reader<EngineAuxiliary> auxiliary_;
  idl::Reader<EngineDescription> descriptions_;
  idl::Reader<MonitorStatus> status_;
  idl::Reader<HealthEvent> events_;
  eprosima::fastdds::dds::WaitSet wait_set_;
  eprosima::fastdds::dds::ConditionSeq triggered_;
};

constexpr double overtime_s = 2.0;

/// Over when the time has passed and the source has ended then, and the monitor has accounted for its last sample if
/// truth tells which that is; if the flight goes on, when that is plain.
bool over(const demo::WatchData& data, const Options& options) {
  if (options.seconds > 0.0 && data.flight_time_s() > options.seconds + overtime_s) return true;
  return options.seconds > 0.0 && data.flight_time_s() > options.seconds - 0.1 &&
         (data.accounted() || data.published() == 0) && data.received() > 0 &&
         data.status()->level() >= static_cast<std::uint32_t>(idl::StatusLevel::stale);
}

void watch(demo::WatchData& data, const Options& options) {
  auto ears = std::make_unique<Ears>(options);
  const service::StopSignal stop;
  const bool terminal = isatty(STDOUT_FILENO) && !options.json;
  const auto period = std::chrono::milliseconds(terminal ? 200 : 1000);
  const auto deadline = Clock::now() + std::chrono::duration<double>(options.seconds + options.timeout_s);
  auto next = Clock::now();
  std::optional<demo::WatchCsv> csv;
  if (!options.csv.empty()) csv.emplace(options.csv);
  const auto on_estimate = [&] {
    if (csv) csv->write(data);
  };
  if (terminal) std::cout << "\033[2J";
  bool told = false;
  while (!stop.requested() && !over(data, options)) {
    if (options.seconds > 0.0 && Clock::now() > deadline) return;
    if (ears->deaf()) {
      ears.reset();
      ears = std::make_unique<Ears>(options);
    }
    ears->listen(data, 0.05, on_estimate);
    if (const std::string what = demo::ignored_truth(data, options.engine); !told && !what.empty()) {
      std::cerr << "ehm_watch: " << what << '\n';
      told = true;
    }
    if (Clock::now() < next || options.json) continue;
    next = Clock::now() + period;
    const int columns = demo::terminal_width(STDOUT_FILENO);
    if (terminal || data.status() || data.estimates() > 0)
      std::cout << (terminal ? demo::table(data, columns) : demo::line(data, columns)) << std::flush;
  }
}

void declare(CLI::App& app, Options& options) {
  app.footer(service::exit_code_help);
  client::add_client_options(app, options.client);
  app.add_flag("--redundant", options.redundant, "ask for exclusive ownership, as monitors with a standby offer it");
  app.add_option("--engine", options.engine, "engine_id to show")
      ->check(CLI::Range(1u, 4294967295u))
      ->capture_default_str();
  app.add_option(
         "--seconds", options.seconds,
         "judge the run after so much flight, at its end: 1 is returned when a sample was lost or withheld, the "
         "monitor said ERROR, or an estimate is outside 3 published sigmas of its truth, where the engine's own "
         "source publishes that (else accuracy is not judged); 0 watches until Ctrl-C")
      ->check(CLI::Range(0.0, 1e9));
  app.add_option("--timeout", options.timeout_s, "seconds beyond that after which it gives up")
      ->check(CLI::Range(0.0, 1e9))
      ->capture_default_str();
  app.add_flag("--json", options.json, "print nothing but the summary, as one JSON object");
  app.add_option("--csv", options.csv, "write every estimate, beside its truth where there is one, to this file");
  app.set_version_flag("--version", std::string("ehm_watch " EHM_VERSION));
  config::add_man_flag(app, {.app = &app});
}

/// What the run was worth, on standard output and error; returns the exit code.
int check(const demo::WatchData& data, const Options& options) {
  std::cout << (options.json ? demo::json(data) : demo::summary(data, demo::terminal_width(STDOUT_FILENO)));
  if (options.seconds <= 0.0) return service::exit_ok;
  std::string verdict = over(data, options) ? "" : "the flight did not come to its end";
  if (const std::string why = demo::verdict(data, 3.0); !why.empty()) verdict += (verdict.empty() ? "" : "; ") + why;
  if (verdict.empty()) return service::exit_ok;
  std::cerr << "ehm_watch: " << verdict << '\n';
  return service::exit_failed;
}

int run(int argc, char** argv) {
  Options options;
  CLI::App app{"Shows the estimates of one engine, beside their truth where its own source publishes it, live.",
               "ehm_watch"};
  declare(app, options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return config::usage_answer(app, e);
  }

  try {
    client::check_files(options.client);
  } catch (const idl::DdsError& e) {
    std::cerr << "ehm_watch: " << e.what() << '\n';
    return service::exit_usage;
  }

  try {
    demo::WatchData data;
    watch(data, options);
    return check(data, options);
  } catch (const std::exception& e) {
    std::cerr << "ehm_watch: " << e.what() << '\n';
    return service::exit_failed;
  }
}

}  // namespace

int main(int argc, char** argv) {
  return ehm::service::written(run(argc, argv), std::cout, std::cerr, "ehm_watch");
}
