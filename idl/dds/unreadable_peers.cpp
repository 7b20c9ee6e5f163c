// SPDX-License-Identifier: Apache-2.0
#include "idl/dds/unreadable_peers.h"

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <sstream>

#include "idl/dds/participant_text.h"
#include "idl/dds/qos.h"

namespace ehm::idl {

namespace rtps = eprosima::fastrtps::rtps;
namespace dds = eprosima::fastdds::dds;

namespace {

constexpr std::uint32_t alignment = 3;  // messages are padded to 4 bytes, and the middleware leaves room for that

/// A writer sends in the first representation of its list, a reader takes any of its own; an empty list is XCDR1.
bool speaks_xcdr1(UnreadablePeers::Side side, const std::vector<dds::DataRepresentationId_t>& list) {
  if (list.empty()) return true;
  if (side == UnreadablePeers::Side::writer) return list.front() == dds::XCDR_DATA_REPRESENTATION;
  return std::find(list.begin(), list.end(), dds::XCDR_DATA_REPRESENTATION) != list.end();
}

const char* name_of(UnreadablePeers::Side side) {
  return side == UnreadablePeers::Side::writer ? "writer" : "reader";
}

std::string sentence(const std::string& participants, const std::string& topic, UnreadablePeers::Side side,
                     const std::string& reason) {
  return "topic " + topic + ": the " + name_of(side) + " of participant " + participants +
         (side == UnreadablePeers::Side::writer ? " can never be read: " : " can never read: ") + reason;
}

}  // namespace

std::shared_ptr<Intake> UnreadablePeers::intake(const std::string& topic) {
  const std::lock_guard lock(mutex_);
  std::shared_ptr<Intake>& intake = intakes_[topic];
  if (!intake) intake = std::make_shared<Intake>();
  return intake;
}

void UnreadablePeers::expect(Side remote, const std::string& topic, const std::string& type, bool keyed,
                             std::uint32_t bytes) {
  Texts texts;
  {
    const std::lock_guard lock(mutex_);
    wanted_[{remote, topic}] = {type, keyed, bytes};
    for (auto& [guid, endpoint] : endpoints_)
      classify(guid, endpoint, texts);  // discovery may have been faster than we
  }
  say(texts);
}

void UnreadablePeers::discovered(const rtps::ParticipantDiscoveryInfo& info) {
  using Info = rtps::ParticipantDiscoveryInfo;
  const Prefix& prefix = info.info.m_guid.guidPrefix;
  if (info.status == Info::REMOVED_PARTICIPANT || info.status == Info::DROPPED_PARTICIPANT) {
    remove_all_of(prefix);
  } else if (info.status == Info::DISCOVERED_PARTICIPANT) {
    const std::lock_guard lock(mutex_);
    if (participants_.size() < capacity) participants_[prefix] = participant_text(info.info);
  }
}

void UnreadablePeers::discovered(const rtps::WriterDiscoveryInfo& info) {
  const rtps::WriterProxyData& writer = info.info;
  if (info.status == rtps::WriterDiscoveryInfo::REMOVED_WRITER) return remove(writer.guid());
  if (info.status != rtps::WriterDiscoveryInfo::DISCOVERED_WRITER) return;
  add(writer.guid(),
      {Side::writer, writer.topicName().c_str(), writer.typeName().c_str(), writer.topicKind() == rtps::WITH_KEY,
       speaks_xcdr1(Side::writer, writer.m_qos.representation.m_value), writer_number(writer.key())});
}

void UnreadablePeers::discovered(const rtps::ReaderDiscoveryInfo& info) {
  const rtps::ReaderProxyData& reader = info.info;
  if (info.status == rtps::ReaderDiscoveryInfo::REMOVED_READER) return remove(reader.guid());
  if (info.status != rtps::ReaderDiscoveryInfo::DISCOVERED_READER) return;
  add(reader.guid(),
      {Side::reader, reader.topicName().c_str(), reader.typeName().c_str(), reader.topicKind() == rtps::WITH_KEY,
       speaks_xcdr1(Side::reader, reader.m_qos.representation.m_value), 0});
}

void UnreadablePeers::add(const Guid& guid, Endpoint endpoint) {
  Texts texts;
  {
    const std::lock_guard lock(mutex_);
    if (endpoints_.size() >= capacity) return;
    Endpoint& known = endpoints_[guid] = std::move(endpoint);
    classify(guid, known, texts);
  }
  say(texts);
}

void UnreadablePeers::remove(const Guid& guid) {
  {
    const std::lock_guard lock(mutex_);
    endpoints_.erase(guid);
  }
  say_if_none_is_left();
}

void UnreadablePeers::remove_all_of(const Prefix& participant) {
  {
    const std::lock_guard lock(mutex_);
    participants_.erase(participant);
    std::erase_if(endpoints_, [&](const auto& endpoint) { return endpoint.first.guidPrefix == participant; });
  }
  say_if_none_is_left();
}

void UnreadablePeers::classify(const Guid& guid, Endpoint& e, Texts& texts) {
  const auto ours = wanted_.find({e.side, e.topic});
  if (e.told || ours == wanted_.end()) return;
  const Wanted& w = ours->second;
  std::string reason;
  if (e.type != w.type)
    reason = "its type is named '" + e.type + "', needed is '" + w.type + "'";
  else if (e.keyed != w.keyed)
    reason = e.keyed ? "its type has a key, ours has none" : "its type has no @key, ours has one";
  else if (!e.xcdr1)
    reason = std::string("it ") + (e.side == Side::writer ? "writes" : "reads") +
             " XCDR2, needed is XCDR1 (an @appendable or @mutable type? needed is @final)";
  if (reason.empty()) return;
  e.told = any_told_ = true;
  texts.push_back(sentence(owner(guid), e.topic, e.side, reason));
}

bool UnreadablePeers::understands(const std::string& middleware_error) {
  unsigned bytes = 0, room = 0;
  const auto begin = middleware_error.find("Change payload size of '");
  if (begin == std::string::npos ||
      std::sscanf(middleware_error.c_str() + begin,
                  "Change payload size of '%u' bytes is larger than the history payload size of '%u'", &bytes,
                  &room) != 2)
    return false;
  const std::lock_guard lock(mutex_);
  for (const auto& [key, wanted] : wanted_)
    if (key.first == Side::writer && wanted.bytes + alignment == room) {
      if (const auto intake = intakes_.find(key.second); intake != intakes_.end()) intake->second->misfit(bytes);
      return true;
    }
  return false;
}

void UnreadablePeers::tell() {
  Texts texts;
  {
    const std::lock_guard lock(mutex_);
    for (const auto& [topic, intake] : intakes_) {
      const std::uint64_t now = intake->misfits(), before = std::exchange(misfits_[topic], now);
      // A writer that has just come may not have been read yet: only what has lasted is told of.
      if (before > 0 && now > before) name_misfits(topic, *intake, texts);
    }
  }
  say(texts);
}

void UnreadablePeers::name_misfits(const std::string& topic, const Intake& intake, Texts& texts) {
  const auto wanted = wanted_.find({Side::writer, topic});
  if (wanted == wanted_.end()) return;
  std::string owners;
  for (auto& [guid, e] : endpoints_) {
    if (e.side != Side::writer || e.topic != topic || e.told || intake.has_heard(e.number)) continue;
    owners += (owners.empty() ? "" : " or ") + owner(guid);
    e.told = any_told_ = true;
  }
  if (owners.empty()) return;
  const std::uint32_t bytes = intake.misfit_bytes(), needed = wanted->second.bytes;
  std::string reason = "its messages cannot be read as the type";
  if (bytes != needed)
    reason = "its messages have " + std::to_string(bytes) + " bytes, those of the type " + std::to_string(needed) +
             " at most (an array of another length?)";
  texts.push_back(sentence(owners, topic, Side::writer, reason));
}

std::string UnreadablePeers::owner(const Guid& guid) const {
  const auto known = participants_.find(guid.guidPrefix);
  std::ostringstream text;
  if (known != participants_.end()) text << known->second << " ";
  text << "(" << guid.guidPrefix << ")";
  return text.str();
}

void UnreadablePeers::say(const Texts& texts) const {
  if (!say_) return;
  for (const std::string& text : texts) say_(true, text);
}

void UnreadablePeers::say_if_none_is_left() {
  {
    const std::lock_guard lock(mutex_);
    if (!any_told_ || std::any_of(endpoints_.begin(), endpoints_.end(), [](const auto& e) { return e.second.told; }))
      return;
    any_told_ = false;
  }
  if (say_) say_(false, "those that can never be read, or never read, are gone");
}

}  // namespace ehm::idl
