// SPDX-License-Identifier: Apache-2.0
#include "monitor/reload/reloader.h"

#include <malloc.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <string_view>

#include "deploy/runtime/config/config_error.h"
#include "deploy/runtime/service/last_catch.h"
#include "idl/wire_values.h"

namespace ehm::monitor {

namespace {

constexpr std::chrono::milliseconds poll{50};

/// What the engine table is made of; everything else belongs to entities that live as long as the service.
bool may_change(std::string_view key) {
  constexpr std::array<std::string_view, 8> changeable{
      "monitor.design", "monitor.max_engines", "checks.", "validity.", "shift.", "faults.", "fleet.", "log.level"};
  return std::any_of(changeable.begin(), changeable.end(), [&](std::string_view c) { return key.starts_with(c); });
}

}  // namespace

std::string refused_changes(const std::map<std::string, std::string>& flying,
                            const std::map<std::string, std::string>& wanted) {
  std::string text;
  const auto refuse = [&](const std::string& key, const std::string& what) {
    text += (text.empty() ? "" : "; ") + ("'" + key + "' " + what);
  };
  for (const auto& [key, value] : wanted) {
    const std::string& now = flying.at(key);
    if (value == now) continue;
    if (!may_change(key))
      refuse(key, "is " + now + " and cannot become " + value + " while flying: restart the monitor");
    else if (key == "monitor.max_engines" && std::atoll(value.c_str()) < std::atoll(now.c_str()))
      refuse(key, "is " + now + " and can only grow while flying, not become " + value);
  }
  return text;
}

Reloader::Reloader(const ReloadSource& source, std::unique_ptr<EngineTable> table, TableExchange& exchange,
                   NoticeBoard& notices, Hooks hooks)
    : read_(source.read),
      hooks_(std::move(hooks)),
      exchange_(exchange),
      notices_(notices),
      flying_(source.flying),
      current_(std::move(table)),
      thread_([this] { run(); }) {}

Reloader::~Reloader() {
  stop_.store(true, std::memory_order_relaxed);
  thread_.join();
}

void Reloader::run() {
  while (!stop_.load(std::memory_order_relaxed)) {
    if (signal_.take()) service::survive("reload", [this] { reload(); });
    std::this_thread::sleep_for(poll);
  }
}

/// A fleet's table takes megabytes: they go back to the system, or a service that is reloaded every day would seem to
/// leak.
void Reloader::retire(std::unique_ptr<EngineTable> table) {
  hooks_.await_reported();
  table.reset();
  malloc_trim(0);
}

void Reloader::reload() {
  std::unique_ptr<EngineTable> table;
  LoadedConfig wanted;
  try {
    wanted = read_();
    if (const std::string refused = refused_changes(flying_, wanted.values); !refused.empty())
      throw config::ConfigError(refused);
    table = std::make_unique<EngineTable>(wanted.config, current_.get());
    if (table->shadows() != current_->shadows())
      throw config::ConfigError(
          "'shadow' of the [[engine]] tables: the topics of shadow estimators cannot change while flying: restart the "
          "monitor");
    hooks_.before(*table);
  } catch (const std::exception& e) {
    exchange_.refused.fetch_add(1, std::memory_order_relaxed);
    notices_.post({.kind = idl::EventKind::configuration,
                   .raised = true,
                   .text = std::string("reload refused, the old configuration flies on: ") + e.what()});
    return;
  }
  exchange_.next.store(table.get(), std::memory_order_release);
  while (!exchange_.retired.exchange(nullptr, std::memory_order_acquire)) {
    // Never taken: the service is stopping, and the cycle thread turns no more.
    if (stop_.load(std::memory_order_relaxed)) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  std::swap(current_, table);
  retire(std::move(table));
  flying_ = std::move(wanted.values);
  spdlog::set_level(spdlog::level::from_str(wanted.config.log_level));
  exchange_.reloads.fetch_add(1, std::memory_order_relaxed);
  notices_.post(
      {.kind = idl::EventKind::configuration,
       .text = "configuration and designs reloaded, filters for " + std::to_string(current_->size()) + " engines"});
}

}  // namespace ehm::monitor
