// SPDX-License-Identifier: Apache-2.0
#pragma once
// Hands what a participant discovers to those who watch it.

#include <fastdds/dds/domain/DomainParticipantListener.hpp>
#include <memory>
#include <optional>

#include "idl/dds/namesakes.h"
#include "idl/dds/stranger_watch.h"
#include "idl/dds/unreadable_peers.h"

namespace ehm::idl {

class DiscoveryListener : public eprosima::fastdds::dds::DomainParticipantListener {
 public:
  /// Where the domain is not secured nobody watches who proves who they are.
  DiscoveryListener(std::shared_ptr<UnreadablePeers> unreadable, bool secured, const StrangerWatch::Say& on_stranger,
                    const std::string& name, const Namesakes::Say& on_namesake)
      : unreadable_(std::move(unreadable)), namesakes_(name, on_namesake) {
    if (secured) strangers_.emplace(on_stranger);
  }
  std::string await_proofs() { return strangers_ ? strangers_->await_proofs() : std::string(); }
  void tell_overdue_strangers() {
    if (strangers_) strangers_->tell_overdue(StrangerWatch::Clock::now());
  }

 private:
  using Participant = eprosima::fastdds::dds::DomainParticipant;
  using Listener = eprosima::fastdds::dds::DomainParticipantListener;

  void on_participant_discovery(Participant* us, eprosima::fastrtps::rtps::ParticipantDiscoveryInfo&& info) override {
    unreadable_->discovered(info);
    namesakes_.discovered(info);
    if (strangers_) static_cast<Listener&>(*strangers_).on_participant_discovery(us, std::move(info));
  }
  void onParticipantAuthentication(Participant* us,
                                   eprosima::fastrtps::rtps::ParticipantAuthenticationInfo&& info) override {
    if (strangers_) static_cast<Listener&>(*strangers_).onParticipantAuthentication(us, std::move(info));
  }
  void on_publisher_discovery(Participant*, eprosima::fastrtps::rtps::WriterDiscoveryInfo&& info) override {
    unreadable_->discovered(info);
  }
  void on_subscriber_discovery(Participant*, eprosima::fastrtps::rtps::ReaderDiscoveryInfo&& info) override {
    unreadable_->discovered(info);
  }

  std::shared_ptr<UnreadablePeers> unreadable_;
  Namesakes namesakes_;
  std::optional<StrangerWatch> strangers_;
};

}  // namespace ehm::idl
