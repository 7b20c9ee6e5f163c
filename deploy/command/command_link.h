// SPDX-License-Identifier: Apache-2.0
#pragma once
// The way of an order to those who read its topic, and of their replies back.
//
// Who is to answer: a SimCommand, each simulator that describes the engine; a MonitorCommand, each monitor that does,
// or every one if it is for all engines. Of them only those can who also write CommandReply: hardware, a replay and
// programs of an earlier version do not.
// @throws idl::DdsError where an endpoint cannot be had

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <fastdds/dds/core/condition/WaitSet.hpp>
#include <map>
#include <random>
#include <set>
#include <stdexcept>
#include <type_traits>
#include <vector>

#include "idl/dds/endpoint.h"
#include "idl/wire_values.h"

namespace ehm::operating {

/// One who is to carry out the order.
struct Addressee {
  EngineDescription description;
  bool answers = false;  ///< it writes CommandReply
  bool answered = false;
};

template <class Command>
class CommandLink {
 public:
  /// `engine_id`: 0 is every engine.
  CommandLink(idl::Participant& participant, std::uint32_t engine_id)
      : engine_id_(engine_id), commands_(participant), replies_(participant), descriptions_(participant) {
    wait_set_.attach_condition(descriptions_.condition());
  }

  /// Waits until somebody reads the orders and an addressee is known; for every engine, until somebody reads them.
  /// False after the time limit.
  bool find(double seconds) {
    const auto found = [&] { return readers() > 0 && (engine_id_ == 0 || !addressees_.empty()); };
    if (!await(seconds, found)) return false;
    // Matching is not symmetric, and of several one is first: an announcement later all know each other.
    constexpr double announcement_s = 0.5;
    await(announcement_s, [] { return false; });
    for (auto& [participant, addressee] : addressees_) addressee.answers = replies_.hears(participant);
    return true;
  }
  /// Readers of the order's topic at present, of whatever engine.
  int readers() const { return commands_.matched(); }
  /// By the number of its participant.
  const std::map<std::uint64_t, Addressee>& addressees() const { return addressees_; }
  std::vector<EngineDescription> descriptions() const {
    std::vector<EngineDescription> all;
    for (const auto& [participant, addressee] : addressees_) all.push_back(addressee.description);
    return all;
  }
  /// Other engines that somebody described.
  const std::set<std::uint32_t>& other_engines() const { return other_engines_; }

  /// Sends the order under a new request number, and waits until all who can answer have, or for so long; `hear` is
  /// told of each reply as it comes. @throws std::runtime_error if the middleware does not take the order
  template <class Hear>
  void send(Command command, double seconds, Hear hear) {
    command.request(std::uniform_int_distribution<std::uint32_t>(1)(random_));
    if (!commands_.write(command)) throw std::runtime_error("the middleware did not take the order");
    wait_set_.attach_condition(replies_.condition());
    bool heard = false;
    const auto all_answered = [&] {
      CommandReply reply;
      while (replies_.take(reply)) {
        if (reply.request() != command.request() || reply.role() != role) continue;
        heard = true;
        if (const auto who = addressees_.find(replies_.participant()); who != addressees_.end())
          who->second.answered = true;
        hear(reply);
      }
      return addressees_.empty() ? heard || replies_.matched() == 0 : none_is_awaited();
    };
    await(seconds, all_answered);
    commands_.drain(1.0);  // who does not answer is to hear it all the same
  }

 private:
  static constexpr bool for_monitors = std::is_same_v<Command, MonitorCommand>;
  static constexpr auto role =
      static_cast<std::uint32_t>(for_monitors ? idl::DescriptionRole::monitor : idl::DescriptionRole::source);

  bool none_is_awaited() const {
    return std::none_of(addressees_.begin(), addressees_.end(),
                        [](const auto& a) { return a.second.answers && !a.second.answered; });
  }
  template <class Condition>
  bool await(double seconds, Condition condition) {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
    eprosima::fastdds::dds::ConditionSeq triggered;
    for (;;) {
      hear_descriptions();
      if (condition()) return true;
      if (std::chrono::steady_clock::now() >= deadline) return false;
      wait_set_.wait(triggered, eprosima::fastrtps::Duration_t(0.02L));
    }
  }
  void hear_descriptions() {
    EngineDescription description;
    while (descriptions_.take(description)) {
      if (description.role() != role) continue;
      if (engine_id_ == 0 || description.engine_id() == engine_id_)
        addressees_[descriptions_.participant()].description = description;
      else
        other_engines_.insert(description.engine_id());
    }
  }

  std::uint32_t engine_id_;
  std::random_device random_;
  idl::Writer<Command> commands_;
  idl::Reader<CommandReply> replies_;
  idl::Reader<EngineDescription> descriptions_;
  eprosima::fastdds::dds::WaitSet wait_set_;
  std::map<std::uint64_t, Addressee> addressees_;
  std::set<std::uint32_t> other_engines_;
};

}  // namespace ehm::operating
