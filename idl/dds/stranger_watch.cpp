// SPDX-License-Identifier: Apache-2.0
#include "idl/dds/stranger_watch.h"

#include <algorithm>
#include <sstream>
#include <vector>

#include "idl/dds/participant_text.h"

namespace ehm::idl {

namespace rtps = eprosima::fastrtps::rtps;

StrangerWatch::Seen* StrangerWatch::find(const rtps::GUID_t& guid) {
  for (Seen& seen : seen_)
    if (seen.state != State::empty && seen.guid == guid) return &seen;
  return nullptr;
}

void StrangerWatch::remember(Seen seen) {
  seen_[next_] = std::move(seen);
  next_ = (next_ + 1) % seen_.size();
  changed_.notify_all();
}

void StrangerWatch::on_participant_discovery(eprosima::fastdds::dds::DomainParticipant*,
                                             rtps::ParticipantDiscoveryInfo&& info) {
  using Info = rtps::ParticipantDiscoveryInfo;
  const std::lock_guard lock(mutex_);
  Seen* known = find(info.info.m_guid);
  if (info.status == Info::REMOVED_PARTICIPANT || info.status == Info::DROPPED_PARTICIPANT) {
    if (known) known->state = State::empty;
    changed_.notify_all();
  } else if (info.status == Info::DISCOVERED_PARTICIPANT) {
    // Who is turned away at once may be announced after that, by another thread.
    if (known)
      known->description = participant_text(info.info);
    else
      remember({State::pending, info.info.m_guid, participant_text(info.info), Clock::now()});
  }
}

void StrangerWatch::onParticipantAuthentication(eprosima::fastdds::dds::DomainParticipant*,
                                                rtps::ParticipantAuthenticationInfo&& info) {
  const std::string description = settle(info.guid);
  if (say_ && info.status == rtps::ParticipantAuthenticationInfo::UNAUTHORIZED_PARTICIPANT)
    say_("participant " + description + " is kept out: it has no identity that this domain accepts");
}

std::string StrangerWatch::await_proofs() {
  const auto is_pending = [](const Seen& seen) { return seen.state == State::pending; };
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, first_contact, [&] { return next_ > 0; });
  changed_.wait_for(lock, handshake_limit, [&] { return std::none_of(seen_.begin(), seen_.end(), is_pending); });
  const auto pending = std::find_if(seen_.begin(), seen_.end(), is_pending);
  return pending == seen_.end() ? "" : pending->description;
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
  if (!say_) return;
  for (const auto& description : overdue)
    say_("participant " + description + " is kept out: it has not proven who it is (other authority, expired, clock?)");
}

std::string StrangerWatch::settle(const rtps::GUID_t& guid) {
  const std::lock_guard lock(mutex_);
  if (Seen* known = find(guid)) {
    known->state = State::settled;
    changed_.notify_all();
    return known->description;
  }
  std::ostringstream text;
  text << guid;
  remember({State::settled, guid, text.str(), Clock::now()});
  return text.str();
}

}  // namespace ehm::idl
