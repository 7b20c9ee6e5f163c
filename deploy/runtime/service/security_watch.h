// SPDX-License-Identifier: Apache-2.0
#pragma once
// What a service says of those who were kept out of its secured domain: in its log, and wherever else it publishes.
//
// Incidents come from middleware threads and wait in a bounded box; one slow thread throttles and says them. The same
// text is said once a minute, with how often it came; all together at most `texts_a_minute` different ones. What does
// not fit is counted and said: a flood costs neither memory nor the disk.

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "idl/dds/participant.h"

namespace ehm::service {

/// Where incidents wait. Thread-safe.
class IncidentBox {
 public:
  void put(const std::string& text);
  /// Everything since the last call: text and how often; then the number that did not fit.
  std::map<std::string, std::uint64_t> take(std::uint64_t& dropped);

 private:
  static constexpr std::size_t texts = 256;
  std::mutex mutex_;
  std::map<std::string, std::uint64_t> waiting_;
  std::uint64_t dropped_ = 0;
};

/// Fills the hooks of `options` when they ask for security; call it before the Participant is made.
std::shared_ptr<IncidentBox> receive_incidents(idl::ParticipantOptions& options);

/// What a service says of itself at its start: "secured by DIRECTORY", or that it is not.
std::string security_text(const std::string& directory);
/// What is to be said of a certificate that has so long to live; empty while that is more than 30 days.
std::string expiry_text(double seconds_left);
/// "security: " and the text, and how often it came if more than once.
std::string incident_text(const std::string& text, std::uint64_t times);

class SecurityWatch {
 public:
  static constexpr int texts_a_minute = 30;
  /// `say` is called on the watch's own thread with each text, and how often it came.
  using Say = std::function<void(const std::string& text, std::uint64_t times)>;
  /// `expires_s`: of the own certificate, seconds since 1970; said once a day in its last 30 days.
  SecurityWatch(idl::Participant& participant, std::shared_ptr<IncidentBox> box, Say say, std::int64_t expires_s);
  ~SecurityWatch();
  SecurityWatch(const SecurityWatch&) = delete;
  SecurityWatch& operator=(const SecurityWatch&) = delete;

 private:
  void run();
  void turn();
  void watch_expiry();

  idl::Participant& participant_;
  std::shared_ptr<IncidentBox> box_;
  Say say_;
  std::map<std::string, std::uint64_t> pending_;  ///< of this minute: said at once, then counted until its end
  std::uint64_t dropped_ = 0;
  std::chrono::steady_clock::time_point minute_;
  std::int64_t expires_s_, expiry_said_s_ = 0;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool stop_ = false;
  std::thread thread_;
};

}  // namespace ehm::service
