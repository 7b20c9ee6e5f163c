// SPDX-License-Identifier: Apache-2.0
#pragma once
// A DDS participant of this project and its endpoints, as owners: what is created is deleted, in the right order.
//
// The built-in profile is UDP on the loopback and network interfaces, no shared memory (deploy/docs/architecture.md,
// "Why it is as it is"): it re-matches in under 0.1 s after a crash and works between users. Another transport or a
// discovery server comes from a Fast DDS XML file, security from a directory of certificates, for either profile.
//
// @throws DdsError naming the file, profile, topic or entity that could not be had.

#include <cstdint>
#include <fastdds/dds/core/condition/StatusCondition.hpp>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/DataWriterListener.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "idl/dds/dds_error.h"
#include "idl/dds/hold_watch.h"
#include "idl/dds/middleware_log.h"
#include "idl/dds/qos.h"
#include "idl/dds/unreadable_peers.h"
#include "idl/topics.h"

namespace ehm::idl {

/// What readers of EngineSensors ask of their writers. 0 asks for nothing, so that any plain writer matches; a writer
/// that does not offer what is asked for is excluded, and that is reported.
struct InputRequest {
  double deadline_s = 0.0;  ///< longest time between two samples of an engine
  double lease_s = 0.0;     ///< longest time without a sign of life of a writer
  /// Told, on a middleware thread, of each period without a sample of an engine.
  std::function<void(std::uint32_t engine_id)> on_deadline_missed = {};
  /// Told, on a middleware thread, how many writers more are alive, and how many more are known and not alive.
  std::function<void(int alive_change, int not_alive_change)> on_liveliness_changed = {};
};

struct ParticipantOptions {
  std::uint32_t domain = 0;
  std::string name = "ehm";
  std::string profiles_file;                ///< Fast DDS XML; empty: the built-in profile
  std::string profile = "ehm_participant";  ///< the participant profile to take from that file
  std::string partition;                    ///< "fleet/<group>"; empty is the default partition
  std::string security;                     ///< directory of certificates and permissions (security.h); empty: none
  Redundancy redundancy;
  InputRequest input;
  /// Told, on a middleware thread, when an endpoint of ours and a remote one exclude each other by QoS.
  std::function<void(const std::string&)> on_incompatible;
  /// Told, mostly on a middleware thread, of remote endpoints that no data can pass to or from (unreadable_peers.h).
  UnreadablePeers::Say on_unreadable;
  /// Told, on a middleware thread, of each participant that could not prove who it is.
  std::function<void(const std::string&)> on_stranger;
  /// Told, on a middleware thread, when another participant bears our name, and when none does any more.
  std::function<void(bool present)> on_namesake;
  /// Told, on the middleware's logging thread, of its own warnings and errors, which else go to standard error.
  std::function<void(const MiddlewareMessage&)> on_middleware;
};

/// Does nothing if the named profiles file can be loaded and has the profile, or if none is named. @throws DdsError
void check_profile(const ParticipantOptions& options);

class DiscoveryListener;

class Participant {
 public:
  explicit Participant(ParticipantOptions options);
  ~Participant();
  Participant(const Participant&) = delete;
  Participant& operator=(const Participant&) = delete;

  const ParticipantOptions& options() const { return options_; }

  /// Registers the type once and hands out the topic.
  eprosima::fastdds::dds::Topic* topic(const char* name, eprosima::fastdds::dds::TypeSupport type);
  eprosima::fastdds::dds::Publisher* publisher() { return publisher_; }
  eprosima::fastdds::dds::Subscriber* subscriber() { return subscriber_; }
  /// The error for an endpoint that the middleware did not make.
  DdsError refused(const char* side, const char* topic) const;
  /// Call it about once a second where on_stranger is given.
  void tell_overdue_strangers();
  /// Call it at least once a second, from one thread. Not 0, but the length of the hold in seconds, when this process
  /// was held up for so long that others may have dropped the participant: nothing reaches them any more
  /// (hold_watch.h), it has to be made anew with all its endpoints. Real-time safe: yes.
  double held_up_s() noexcept { return hold_watch_->held_up_s(); }
  UnreadablePeers& unreadable() { return *unreadable_; }
  void report_incompatible(const std::string& topic, const char* side, std::uint32_t policy) const;

 private:
  void create();
  void hear_log();

  ParticipantOptions options_;
  std::shared_ptr<UnreadablePeers> unreadable_;  // the middleware's log may outlive us
  std::unique_ptr<DiscoveryListener> discovery_;
  eprosima::fastdds::dds::DomainParticipant* participant_ = nullptr;
  eprosima::fastdds::dds::Publisher* publisher_ = nullptr;
  eprosima::fastdds::dds::Subscriber* subscriber_ = nullptr;
  std::optional<HoldWatch> hold_watch_;
};

}  // namespace ehm::idl
