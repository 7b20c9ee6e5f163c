// SPDX-License-Identifier: Apache-2.0
#pragma once
// Knows which participants of a secured domain have proven who they are, and tells of those that have not.
//
// The middleware reports a failed proof by GUID only, and nothing at all where it is the stranger who breaks off the
// handshake. So name and address are kept from the announcement, and who has proven nothing within `patience` is told
// of too. A handshake between two that may trust each other can hang as well (Fast DDS 2.9.1 gives up on a step that
// has failed once, and never tries again until one of the two is a new participant): who joins looks whether it gets
// through, and else joins anew (Participant). At most `capacity` participants are remembered, however many come.

#include <array>
#include <chrono>
#include <condition_variable>
#include <fastdds/dds/domain/DomainParticipantListener.hpp>
#include <functional>
#include <mutex>
#include <string>

namespace ehm::idl {

class StrangerWatch : public eprosima::fastdds::dds::DomainParticipantListener {
 public:
  using Clock = std::chrono::steady_clock;
  using Say = std::function<void(const std::string&)>;
  static constexpr std::chrono::seconds patience{5};                 ///< a handshake takes well under a second
  static constexpr std::chrono::milliseconds first_contact{600};     ///< others announce themselves every 500 ms
  static constexpr std::chrono::milliseconds handshake_limit{2500};  ///< of one who joins, before it joins anew
  static constexpr std::size_t capacity = 64;

  explicit StrangerWatch(Say say) : say_(std::move(say)) {}
  /// Waits until everybody who announces himself within the first contact has proven who he is, or was turned away;
  /// else, after handshake_limit, describes one who has not. An empty text is good.
  std::string await_proofs();
  /// Tells of those whose time is over at `now`; call it about once a second.
  void tell_overdue(Clock::time_point now);

 private:
  enum class State { empty, pending, settled };
  struct Seen {
    State state = State::empty;
    eprosima::fastrtps::rtps::GUID_t guid;
    std::string description;
    Clock::time_point since;
  };
  void on_participant_discovery(eprosima::fastdds::dds::DomainParticipant*,
                                eprosima::fastrtps::rtps::ParticipantDiscoveryInfo&& info) override;
  void onParticipantAuthentication(eprosima::fastdds::dds::DomainParticipant*,
                                   eprosima::fastrtps::rtps::ParticipantAuthenticationInfo&& info) override;
  Seen* find(const eprosima::fastrtps::rtps::GUID_t& guid);
  void remember(Seen seen);
  /// Takes it off the pending ones; its description, or its GUID if it is forgotten.
  std::string settle(const eprosima::fastrtps::rtps::GUID_t& guid);

  Say say_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::array<Seen, capacity> seen_;  // a ring: the oldest is forgotten
  std::size_t next_ = 0;
};

}  // namespace ehm::idl
