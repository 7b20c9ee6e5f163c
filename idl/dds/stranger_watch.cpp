#include "idl/dds/stranger_watch.h"

#include <fastdds/rtps/builtin/data/ParticipantProxyData.h>

#include <sstream>
#include <vector>

namespace ehm::wire {

namespace rtps = eprosima::fastrtps::rtps;

namespace {

std::string describe(const rtps::ParticipantProxyData& participant) {
  std::ostringstream text;
  text << "'" << participant.m_participantName.c_str() << "'";
  const auto& addresses = participant.metatraffic_locators.unicast;
  if (!addresses.empty()) text << " at " << addresses[0];
  return text.str();
}

}  // namespace

void StrangerWatch::on_participant_discovery(eprosima::fastdds::dds::DomainParticipant*,
                                             rtps::ParticipantDiscoveryInfo&& info) {
  using Info = rtps::ParticipantDiscoveryInfo;
  if (info.status == Info::DISCOVERED_PARTICIPANT) {
    const std::lock_guard lock(mutex_);
    seen_[next_] = {State::pending, info.info.m_guid, describe(info.info), Clock::now()};
    next_ = (next_ + 1) % seen_.size();
  } else if (info.status == Info::REMOVED_PARTICIPANT || info.status == Info::DROPPED_PARTICIPANT) {
    settle(info.info.m_guid);
  }
}

void StrangerWatch::onParticipantAuthentication(eprosima::fastdds::dds::DomainParticipant*,
                                                rtps::ParticipantAuthenticationInfo&& info) {
  const std::string description = settle(info.guid);
  if (info.status == rtps::ParticipantAuthenticationInfo::UNAUTHORIZED_PARTICIPANT)
    say_("participant " + description + " is kept out: it has no identity that this domain accepts");
}

void StrangerWatch::tell_overdue(Clock::time_point now) {
  std::vector<std::string> overdue;
  {
    const std::lock_guard lock(mutex_);
    for (Seen& seen : seen_) {
      if (seen.state != State::pending || now - seen.since < patience) continue;
      seen.state = State::settled;
      overdue.push_back(seen.description);
    }
  }
  for (const auto& description : overdue)
    say_("participant " + description + " is kept out: it has not proven who it is (other authority, expired, clock?)");
}

std::string StrangerWatch::settle(const rtps::GUID_t& guid) {
  const std::lock_guard lock(mutex_);
  for (Seen& seen : seen_) {
    if (seen.state == State::empty || !(seen.guid == guid)) continue;
    seen.state = State::settled;
    return seen.description;
  }
  std::ostringstream text;
  text << guid;
  return text.str();
}

}  // namespace ehm::wire
