// SPDX-License-Identifier: Apache-2.0
#pragma once
// Remote endpoints of our topics that no data can ever pass to or from, and why. The middleware passes over them in
// silence (Fast DDS 2.9.1: no status, no log line), so they are told of here, once each:
//
//   another name of the type                          found in discovery
//   a type with a key where ours has none, or without found in discovery
//   data representation XCDR2 only                    found in discovery; an @appendable or @mutable type of Cyclone
//                                                     DDS shows as this, since Cyclone sends those in XCDR2 only
//   messages of another length (length of an array)   found as messages come in: Fast DDS 2.9.1 does not read the type
//                                                     information that others send, and sends none itself. Whose they
//                                                     are the middleware does not say: writers that match and have
//                                                     never been read are named
//
// Thread-safe; callbacks come on the middleware's threads and on the one that calls tell(). Bounded: at most `capacity`
// endpoints and participants are remembered, the rest goes unnamed.

#include <fastdds/rtps/participant/ParticipantDiscoveryInfo.h>
#include <fastdds/rtps/reader/ReaderDiscoveryInfo.h>
#include <fastdds/rtps/writer/WriterDiscoveryInfo.h>

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "idl/dds/intake.h"

namespace ehm::idl {

class UnreadablePeers {
 public:
  enum class Side { writer, reader };
  /// `present`: text names participant, topic and reason; otherwise the last of those told of is gone.
  using Say = std::function<void(bool present, const std::string& text)>;
  static constexpr std::size_t capacity = 512;

  explicit UnreadablePeers(Say say) : say_(std::move(say)) {}

  /// Where the messages of this topic are counted. At start only, like expect().
  std::shared_ptr<Intake> intake(const std::string& topic);
  /// An endpoint of ours waits for remote ones of this side. `bytes`: longest message of the type.
  void expect(Side remote, const std::string& topic, const std::string& type, bool keyed, std::uint32_t bytes);

  void discovered(const eprosima::fastrtps::rtps::ParticipantDiscoveryInfo& info);
  void discovered(const eprosima::fastrtps::rtps::WriterDiscoveryInfo& info);
  void discovered(const eprosima::fastrtps::rtps::ReaderDiscoveryInfo& info);
  /// True if this is the middleware's complaint of a message longer than a topic of ours allows, which is counted.
  bool understands(const std::string& middleware_error);
  /// Tells of messages that do not fit, if they have come for a turn at least; call it about once a second.
  void tell();

 private:
  using Guid = eprosima::fastrtps::rtps::GUID_t;
  using Prefix = eprosima::fastrtps::rtps::GuidPrefix_t;
  struct Wanted {
    std::string type;
    bool keyed = true;
    std::uint32_t bytes = 0;
  };
  struct Endpoint {
    Side side{};
    std::string topic, type;
    bool keyed = true, xcdr1 = true;
    std::uint64_t number = 0;  ///< as a writer, writer_number
    bool told = false;
  };
  using Texts = std::vector<std::string>;

  void add(const Guid& guid, Endpoint endpoint);
  void remove(const Guid& guid);
  void remove_all_of(const Prefix& participant);
  void classify(const Guid& guid, Endpoint& endpoint, Texts& texts);
  void name_misfits(const std::string& topic, const Intake& intake, Texts& texts);
  std::string owner(const Guid& guid) const;
  void say(const Texts& texts) const;
  void say_if_none_is_left();

  Say say_;
  std::mutex mutex_;
  std::map<std::pair<Side, std::string>, Wanted> wanted_;  ///< by remote side and topic
  std::map<std::string, std::shared_ptr<Intake>> intakes_;
  std::map<std::string, std::uint64_t> misfits_;  ///< by topic, at the turn before
  std::map<Prefix, std::string> participants_;
  std::map<Guid, Endpoint> endpoints_;
  bool any_told_ = false;
};

}  // namespace ehm::idl
