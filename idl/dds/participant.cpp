#include "idl/dds/participant.h"

#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>

#include "idl/dds/security.h"
#include "idl/dds/stranger_watch.h"

namespace ehm::wire {

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

}  // namespace

Participant::Participant(ParticipantOptions options) : options_(std::move(options)) {
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
}

void Participant::create() {
  dds::DomainParticipantQos qos =
      options_.profiles_file.empty() ? built_in_profile(options_) : profile_from_file(options_);
  std::optional<MiddlewareErrors> errors;
  if (!options_.security.empty()) {
    auto properties = security_properties(options_.security);
    std::move(properties.begin(), properties.end(), std::back_inserter(qos.properties().properties()));
    errors.emplace();
  }
  if (options_.on_stranger) strangers_ = std::make_unique<StrangerWatch>(options_.on_stranger);
  participant_ = dds::DomainParticipantFactory::get_instance()->create_participant(
      options_.domain, qos, strangers_.get(), dds::StatusMask::none());
  if (!participant_)
    throw DdsError("no DDS participant on domain " + std::to_string(options_.domain) + ": " +
                   (errors ? "the security files in '" + options_.security + "' are refused: " + errors->text()
                           : "the domain must be 0 to 232, and its UDP ports free and permitted"));
  errors.reset();
  if (options_.on_middleware) hear_middleware(options_.on_middleware);
}

DdsError Participant::refused(const char* side, const char* topic) const {
  std::string text = std::string("no DDS ") + side + " on topic '" + topic + "'";
  if (!options_.security.empty())
    text += ": the permissions in '" + options_.security + "' do not allow it on this domain and partition";
  return DdsError(text);
}

void Participant::tell_overdue_strangers() {
  if (strangers_) strangers_->tell_overdue(StrangerWatch::Clock::now());
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

}  // namespace ehm::wire
