// SPDX-License-Identifier: Apache-2.0
#pragma once
// Tells of other participants that call themselves as we do: two services that were given one identity. Under shared
// ownership nothing else shows it, and their estimates mix.
//
// Called on threads of the middleware, one at a time a participant. At most `capacity` are remembered.

#include <fastdds/dds/domain/DomainParticipantListener.hpp>
#include <functional>
#include <mutex>
#include <set>
#include <string>

namespace ehm::idl {

class Namesakes {
 public:
  /// Told with true when the first one appears, with false when the last one has gone.
  using Say = std::function<void(bool present)>;
  static constexpr std::size_t capacity = 64;

  Namesakes(std::string name, Say say) : name_(std::move(name)), say_(std::move(say)) {}

  void discovered(const eprosima::fastrtps::rtps::ParticipantDiscoveryInfo& info) {
    using Info = eprosima::fastrtps::rtps::ParticipantDiscoveryInfo;
    if (!say_ || info.info.m_participantName.to_string() != name_) return;
    const std::lock_guard lock(mutex_);
    const bool before = !present_.empty();
    if (info.status == Info::REMOVED_PARTICIPANT || info.status == Info::DROPPED_PARTICIPANT)
      present_.erase(info.info.m_guid);
    else if (info.status == Info::DISCOVERED_PARTICIPANT && present_.size() < capacity)
      present_.insert(info.info.m_guid);
    if (before != !present_.empty()) say_(!before);
  }

 private:
  const std::string name_;
  const Say say_;
  std::mutex mutex_;
  std::set<eprosima::fastrtps::rtps::GUID_t> present_;
};

}  // namespace ehm::idl
