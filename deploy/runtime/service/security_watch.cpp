// SPDX-License-Identifier: Apache-2.0
#include "deploy/runtime/service/security_watch.h"

#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

#include "deploy/runtime/service/last_catch.h"
#include "idl/dds/middleware_log.h"

namespace ehm::service {

using std::chrono::steady_clock;

void IncidentBox::put(const std::string& text) {
  const std::lock_guard lock(mutex_);
  if (const auto known = waiting_.find(text); known != waiting_.end())
    ++known->second;
  else if (waiting_.size() < texts)
    waiting_.emplace(text, 1);
  else
    ++dropped_;
}

std::map<std::string, std::uint64_t> IncidentBox::take(std::uint64_t& dropped) {
  const std::lock_guard lock(mutex_);
  dropped += std::exchange(dropped_, 0);
  return std::exchange(waiting_, {});
}

namespace {

/// "topic not found in allow rule. (./src/cpp/...:1247)": the middleware's source lines tell an operator nothing.
std::string without_source_line(std::string text) {
  if (const auto begin = text.find(" (./src"); begin != std::string::npos)
    if (const auto end = text.find(')', begin); end != std::string::npos) text.erase(begin, end + 1 - begin);
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

/// Refusals come as errors; while keys are exchanged, messages that cannot be read yet come as warnings.
void sort(IncidentBox& box, const idl::MiddlewareMessage& message) {
  const bool security = message.category.starts_with("SECURITY");
  // An endpoint that was closed while its partner greeted it.
  const bool gone = message.text.find("Cannot find local") != std::string::npos;
  if (security && message.error && !gone)
    box.put("refused by the security rules: " + without_source_line(message.text));
  else if (message.error && !security)
    spdlog::debug("middleware {}: {}", message.category, message.text);
}

}  // namespace

std::shared_ptr<IncidentBox> receive_incidents(idl::ParticipantOptions& options) {
  auto box = std::make_shared<IncidentBox>();
  if (options.security.empty()) return box;
  options.on_stranger = [box](const std::string& text) { box->put(text); };
  options.on_middleware = [box](const idl::MiddlewareMessage& message) { sort(*box, message); };
  return box;
}

std::string security_text(const std::string& directory) {
  return directory.empty() ? "WITHOUT security: anybody may join" : "secured by " + directory;
}

std::string incident_text(const std::string& text, std::uint64_t times) {
  return "security: " + text + (times > 1 ? " (" + std::to_string(times) + " times)" : "");
}

SecurityWatch::SecurityWatch(idl::Participant& participant, std::shared_ptr<IncidentBox> box, Say say,
                             std::int64_t expires_s)
    : participant_(participant),
      box_(std::move(box)),
      say_(std::move(say)),
      minute_(steady_clock::now()),
      expires_s_(expires_s),
      thread_([this] { run(); }) {}

SecurityWatch::~SecurityWatch() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

void SecurityWatch::run() {
  for (bool last = false; !last;) {
    {
      std::unique_lock lock(mutex_);
      last = wake_.wait_for(lock, std::chrono::milliseconds(200), [this] { return stop_; });
    }
    survive("security watch", [this] { turn(); });
  }
}

std::string expiry_text(double seconds_left) {
  constexpr double day_s = 86400.0;
  const std::string remedy =
      ": make_security.sh --renew makes a new one; copy the folder and restart, or reload, the service";
  if (seconds_left <= 0.0)
    return "the certificate of this service has expired: who joins from now on will not trust it" + remedy;
  if (seconds_left > 30.0 * day_s) return {};
  return fmt::format("the certificate of this service expires in {:.1f} days", seconds_left / day_s) + remedy;
}

/// Once at start, then once a day.
void SecurityWatch::watch_expiry() {
  const std::int64_t now_s =
      std::chrono::duration_cast<std::chrono::seconds>(std::chrono::system_clock::now().time_since_epoch()).count();
  if (expires_s_ == 0 || now_s - expiry_said_s_ < 86400) return;
  expiry_said_s_ = now_s;
  if (const std::string text = expiry_text(static_cast<double>(expires_s_ - now_s)); !text.empty()) say_(text, 1);
}

void SecurityWatch::turn() {
  watch_expiry();
  participant_.tell_overdue_strangers();
  if (steady_clock::now() - minute_ >= std::chrono::minutes(1)) {
    minute_ = steady_clock::now();
    for (const auto& [text, times] : std::exchange(pending_, {}))
      if (times > 0) say_(text, times);
    if (const auto dropped = std::exchange(dropped_, 0); dropped > 0)
      say_("further incidents, too many to name", dropped);
  }
  for (const auto& [text, times] : box_->take(dropped_)) {
    if (const auto known = pending_.find(text); known != pending_.end()) {
      known->second += times;
    } else if (pending_.size() < texts_a_minute) {
      say_(text, times);
      pending_.emplace(text, 0);
    } else {
      dropped_ += times;
    }
  }
}

}  // namespace ehm::service
