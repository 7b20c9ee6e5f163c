// SPDX-License-Identifier: Apache-2.0
#include "idl/dds/participant.h"

#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>

#include <algorithm>
#include <array>
#include <iostream>
#include <iterator>
#include <limits>
#include <optional>

#include "deploy/runtime/files/file_error.h"
#include "deploy/runtime/files/input_file.h"
#include "idl/dds/descriptors.h"
#include "idl/dds/discovery_listener.h"
#include "idl/dds/security.h"

namespace ehm::idl {

namespace dds = eprosima::fastdds::dds;
namespace rtps = eprosima::fastdds::rtps;
using eprosima::fastrtps::Duration_t;
using eprosima::fastrtps::types::ReturnCode_t;

namespace {

dds::DomainParticipantQos built_in_profile(const ParticipantOptions& options) {
  dds::DomainParticipantQos qos;
  qos.name(options.name);
  qos.transport().use_builtin_transports = false;
  auto udp = std::make_shared<rtps::UDPv4TransportDescriptor>();
  udp->sendBufferSize = 4 * 1024 * 1024;
  udp->receiveBufferSize = 4 * 1024 * 1024;
  qos.transport().user_transports.push_back(udp);
  auto& discovery = qos.wire_protocol().builtin.discovery_config;
  discovery.leaseDuration = Duration_t(5, 0);
  discovery.leaseDuration_announcementperiod = Duration_t(0.5L);  // 3 s to match is the default's price
  return qos;
}

dds::DomainParticipantQos profile_from_file(const ParticipantOptions& options) {
  try {
    files::require_input_file(options.profiles_file, files::profiles_file);
  } catch (const files::FileError& e) {
    throw DdsError(std::string("dds profiles file ") + e.what());
  }
  auto* factory = dds::DomainParticipantFactory::get_instance();
  if (factory->load_XML_profiles_file(options.profiles_file) != ReturnCode_t::RETCODE_OK)
    throw DdsError("dds profiles file '" + options.profiles_file +
                   "' cannot be loaded: check that it exists and is a Fast DDS 2.9 XML file");
  dds::DomainParticipantQos qos;
  if (factory->get_participant_qos_from_profile(options.profile, qos) != ReturnCode_t::RETCODE_OK)
    throw DdsError("dds profiles file '" + options.profiles_file + "' has no participant profile '" + options.profile +
                   "': add one, or name another with --dds-profile");
  qos.name(options.name);
  return qos;
}

dds::DomainParticipant* make_participant(const ParticipantOptions& options, DiscoveryListener& discovery) {
  dds::DomainParticipantQos qos =
      options.profiles_file.empty() ? built_in_profile(options) : profile_from_file(options);
  std::optional<MiddlewareErrors> errors;
  if (!options.security.empty()) {
    auto properties = security_properties(options.security);
    std::move(properties.begin(), properties.end(), std::back_inserter(qos.properties().properties()));
    errors.emplace();
  }
  auto* made = dds::DomainParticipantFactory::get_instance()->create_participant(options.domain, qos, &discovery,
                                                                                 dds::StatusMask::none());
  if (!made)
    throw DdsError("no DDS participant on domain " + std::to_string(options.domain) + ": " +
                   (errors ? "the security files in '" + options.security + "' are refused: " + errors->text()
                           : "the domain must be 0 to 232, and its UDP ports free and permitted"));
  return made;
}

/// How long we may be held up: the last announcement may be as old as a period, and the others' patience is the lease.
double longest_hold_s(const dds::DomainParticipantQos& qos) {
  constexpr double on_the_way_s = 0.1;
  const auto& discovery = qos.wire_protocol().builtin.discovery_config;
  if (discovery.leaseDuration == eprosima::fastrtps::c_TimeInfinite) return std::numeric_limits<double>::infinity();
  const double lease_s = 1e-9 * static_cast<double>(discovery.leaseDuration.to_ns());
  const double period_s = 1e-9 * static_cast<double>(discovery.leaseDuration_announcementperiod.to_ns());
  return std::max(lease_s - period_s - on_the_way_s, 0.5 * lease_s);
}

}  // namespace

void check_profile(const ParticipantOptions& options) {
  if (!options.profiles_file.empty()) profile_from_file(options);
}

Participant::Participant(ParticipantOptions options) : options_(std::move(options)) {
  require_descriptors();
  create();
  dds::PublisherQos publisher_qos;
  dds::SubscriberQos subscriber_qos;
  if (!options_.partition.empty()) {
    publisher_qos.partition().push_back(options_.partition.c_str());
    subscriber_qos.partition().push_back(options_.partition.c_str());
  }
  publisher_ = participant_->create_publisher(publisher_qos);
  subscriber_ = participant_->create_subscriber(subscriber_qos);
  if (!publisher_ || !subscriber_)
    throw DdsError("no DDS publisher or subscriber in partition '" + options_.partition + "'");
  hold_watch_.emplace(longest_hold_s(participant_->get_qos()));
}

void Participant::create() {
  constexpr int joins = 3;
  unreadable_ = std::make_shared<UnreadablePeers>(options_.on_unreadable);
  for (int i = 1;; ++i) {
    discovery_ = std::make_unique<DiscoveryListener>(unreadable_, !options_.security.empty(), options_.on_stranger,
                                                     options_.name, options_.on_namesake);
    participant_ = make_participant(options_, *discovery_);
    const std::string unproven = discovery_->await_proofs();
    if (unproven.empty() || i == joins) break;
    if (options_.on_stranger)
      options_.on_stranger("participant " + unproven + " has not proven who it is: joining anew");
    dds::DomainParticipantFactory::get_instance()->delete_participant(participant_);
  }
  if (options_.on_middleware || options_.on_unreadable) hear_log();
}

void Participant::hear_log() {
  const auto hear = options_.on_middleware;
  hear_middleware(
      [hear, unreadable = unreadable_](const MiddlewareMessage& message) {
        if (is_of_no_concern(message) || unreadable->understands(message.text)) return;
        if (hear)
          hear(message);
        else
          std::cerr << "middleware " << message.category << ": " << message.text << std::endl;
      },
      hear ? MiddlewareLevel::warnings : MiddlewareLevel::errors);
}

DdsError Participant::refused(const char* side, const char* topic) const {
  std::string text = std::string("no DDS ") + side + " on topic '" + topic + "'";
  if (!options_.security.empty())
    text += ": the permissions in '" + options_.security + "' do not allow it on this domain and partition";
  return DdsError(text);
}

void Participant::tell_overdue_strangers() {
  discovery_->tell_overdue_strangers();
}

Participant::~Participant() {
  if (!participant_) return;
  participant_->delete_contained_entities();
  dds::DomainParticipantFactory::get_instance()->delete_participant(participant_);
}

dds::Topic* Participant::topic(const char* name, dds::TypeSupport type) {
  type.register_type(participant_);
  if (auto* known = participant_->lookup_topicdescription(name)) return dynamic_cast<dds::Topic*>(known);
  auto* created = participant_->create_topic(name, type.get_type_name(), dds::TOPIC_QOS_DEFAULT);
  if (!created) throw DdsError(std::string("no DDS topic '") + name + "'");
  return created;
}

void Participant::report_incompatible(const std::string& topic, const char* side, std::uint32_t policy) const {
  // The policies that this project's users get wrong; ids of the DDS specification, table 2.2.3.
  static constexpr std::array<std::pair<std::uint32_t, const char*>, 8> names{{{2, "durability"},
                                                                               {3, "presentation"},
                                                                               {4, "deadline"},
                                                                               {6, "ownership"},
                                                                               {8, "liveliness"},
                                                                               {11, "reliability"},
                                                                               {12, "destination order"},
                                                                               {23, "data representation"}}};
  std::string policy_name = "policy " + std::to_string(policy);
  for (const auto& [id, known] : names)
    if (id == policy) policy_name = known;
  // The redundant profile differs in both from the ordinary one.
  const bool redundancy = policy == 6 || policy == 8;
  const std::string remedy =
      redundancy ? ". Monitors and readers must agree: dds.ownership = \"exclusive\" (ehm_watch: --redundant), or none"
                 : "";
  if (options_.on_incompatible)
    options_.on_incompatible("topic " + topic + ": a remote " + side + " and this one exclude each other by QoS " +
                             policy_name + "; no data flows between them" + remedy);
}

}  // namespace ehm::idl
