// SPDX-License-Identifier: Apache-2.0
#pragma once
// Writer<T> and Reader<T>: one topic each, with the delivery of idl/topics.h.
//
// Real-time safe: write and take allocate nothing of ours; what the middleware does in them is measured
// (deploy/docs/architecture.md, "Why it is as it is"). Both must be destroyed before their Participant.

#include <algorithm>
#include <atomic>
#include <mutex>
#include <string>
#include <vector>

#include "idl/dds/guarded_type.h"
#include "idl/dds/participant.h"

namespace ehm::idl {

/// The topic that carries what the topic of T does, of one estimator among several.
template <class T>
std::string topic_name(const std::string& estimator) {
  return estimator.empty() ? Topic<T>::name : Topic<T>::name + ("/" + estimator);
}

/// A topic of T, whose remote endpoints of this side are watched from now on.
template <class T>
eprosima::fastdds::dds::Topic* topic_of(Participant& participant, const std::string& name,
                                        UnreadablePeers::Side remote) {
  UnreadablePeers& peers = participant.unreadable();
  const eprosima::fastdds::dds::TypeSupport type(new GuardedType<typename Topic<T>::PubSubType>(peers.intake(name)));
  auto* topic = participant.topic(name.c_str(), type);
  peers.expect(remote, name, type.get_type_name(), type->m_isGetKeyDefined, type->m_typeSize);
  return topic;
}

template <class T>
class Writer : private eprosima::fastdds::dds::DataWriterListener {
 public:
  /// `stronger_by`: ownership strength beyond the participant's. `estimator`: whose estimates, under their own topic;
  /// empty for the published ones, and for every other topic.
  explicit Writer(Participant& participant, std::uint32_t stronger_by = 0, const std::string& estimator = "")
      : participant_(participant), name_(topic_name<T>(estimator)) {
    auto* topic = topic_of<T>(participant, name_, UnreadablePeers::Side::reader);
    Redundancy redundancy = participant.options().redundancy;
    redundancy.strength += stronger_by;
    writer_ = participant.publisher()->create_datawriter(
        topic, writer_qos(Topic<T>::delivery, Topic<T>::estimate, redundancy), this);
    if (!writer_) throw participant.refused("writer", name_.c_str());
  }
  ~Writer() override {
    writer_->set_listener(nullptr);
    participant_.publisher()->delete_datawriter(writer_);
  }
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  /// False when the middleware refused the sample; the caller counts it.
  bool write(const T& sample) { return writer_->write(const_cast<T*>(&sample)); }
  /// Ends the instance as far as this writer goes: readers see NOT_ALIVE, or the next weaker writer.
  void release(const T& key) { writer_->unregister_instance(const_cast<T*>(&key), eprosima::fastdds::dds::HANDLE_NIL); }
  /// Readers matched at present.
  int matched() const { return matched_.load(std::memory_order_acquire); }
  /// Waits until all matched readers have acknowledged; false after the time limit.
  bool drain(double seconds) {
    return writer_->wait_for_acknowledgments(eprosima::fastrtps::Duration_t(static_cast<long double>(seconds))) ==
           eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK;
  }

 private:
  void on_publication_matched(eprosima::fastdds::dds::DataWriter*,
                              const eprosima::fastdds::dds::PublicationMatchedStatus& status) override {
    matched_.store(status.current_count, std::memory_order_release);
  }
  void on_offered_incompatible_qos(eprosima::fastdds::dds::DataWriter*,
                                   const eprosima::fastdds::dds::OfferedIncompatibleQosStatus& status) override {
    participant_.report_incompatible(name_, "reader", status.last_policy_id);
  }

  Participant& participant_;
  std::string name_;  ///< of the topic
  eprosima::fastdds::dds::DataWriter* writer_ = nullptr;
  std::atomic<int> matched_{0};
};

template <class T>
class Reader : private eprosima::fastdds::dds::DataReaderListener {
 public:
  /// `estimator` as for a Writer.
  explicit Reader(Participant& participant, const std::string& estimator = "")
      : participant_(participant), name_(topic_name<T>(estimator)), intake_(participant.unreadable().intake(name_)) {
    auto* topic = topic_of<T>(participant, name_, UnreadablePeers::Side::writer);
    // Data wakes the WaitSet, not the listener: the listener only hears of matching.
    auto mask = eprosima::fastdds::dds::StatusMask::none();
    mask << eprosima::fastdds::dds::StatusMask::subscription_matched()
         << eprosima::fastdds::dds::StatusMask::requested_incompatible_qos()
         << eprosima::fastdds::dds::StatusMask::requested_deadline_missed()
         << eprosima::fastdds::dds::StatusMask::liveliness_changed();
    auto qos = reader_qos(Topic<T>::delivery, Topic<T>::estimate, participant.options().redundancy);
    if constexpr (Topic<T>::input) {
      ask(qos, participant.options().input.deadline_s, participant.options().input.lease_s);
      qos.history().depth = input_depth;
    }
    reader_ = participant.subscriber()->create_datareader(topic, qos, this, mask);
    if (!reader_) throw participant.refused("reader", name_.c_str());
    reader_->get_statuscondition().set_enabled_statuses(eprosima::fastdds::dds::StatusMask::data_available());
  }
  ~Reader() override {
    reader_->set_listener(nullptr);
    participant_.subscriber()->delete_datareader(reader_);
  }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  /// The next sample, oldest first; false when there is none. Disposals and other notices without data are passed over.
  bool take(T& sample) {
    while (reader_->take_next_sample(&sample, &info_) == eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK)
      if (info_.valid_data) {
        intake_->heard(writer());
        return true;
      }
    return false;
  }
  /// When the middleware received the sample last taken, wall clock, ns.
  std::int64_t received_ns() const { return info_.reception_timestamp.to_ns(); }
  /// A number that tells the writer of the sample last taken from others; not 0.
  std::uint64_t writer() const { return writer_number(info_.publication_handle); }
  /// A number that tells the participant of that writer from others.
  std::uint64_t participant() const { return participant_number(info_.publication_handle); }
  /// Is a writer of that participant matched? Takes a lock: for rare questions.
  bool hears(std::uint64_t participant) const {
    const std::lock_guard lock(mutex_);
    return std::find(heard_.begin(), heard_.end(), participant) != heard_.end();
  }
  /// Was the sample last taken written by the reader's own participant?
  bool from_this_participant() const {
    const auto& ours = reader_->guid().guidPrefix;
    for (unsigned i = 0; i < ours.size; ++i)
      if (info_.publication_handle.value[i] != ours.value[i]) return false;
    return true;
  }
  /// Attach this to a WaitSet; it triggers while data waits.
  eprosima::fastdds::dds::StatusCondition& condition() { return reader_->get_statuscondition(); }
  int matched() const { return matched_.load(std::memory_order_acquire); }

 private:
  void on_subscription_matched(eprosima::fastdds::dds::DataReader*,
                               const eprosima::fastdds::dds::SubscriptionMatchedStatus& status) override {
    matched_.store(status.current_count, std::memory_order_release);
    const std::uint64_t participant = participant_number(status.last_publication_handle);
    const std::lock_guard lock(mutex_);
    const auto known = std::find(heard_.begin(), heard_.end(), participant);
    if (status.current_count_change > 0)
      heard_.push_back(participant);
    else if (known != heard_.end())
      heard_.erase(known);
  }
  void on_requested_incompatible_qos(eprosima::fastdds::dds::DataReader*,
                                     const eprosima::fastdds::dds::RequestedIncompatibleQosStatus& status) override {
    participant_.report_incompatible(name_, "writer", status.last_policy_id);
  }
  void on_requested_deadline_missed(eprosima::fastdds::dds::DataReader*,
                                    const eprosima::fastdds::dds::RequestedDeadlineMissedStatus& status) override {
    if (const auto& tell = participant_.options().input.on_deadline_missed; Topic<T>::input && tell)
      tell(engine_id_of(status.last_instance_handle));
  }
  void on_liveliness_changed(eprosima::fastdds::dds::DataReader*,
                             const eprosima::fastdds::dds::LivelinessChangedStatus& status) override {
    if (const auto& tell = participant_.options().input.on_liveliness_changed; Topic<T>::input && tell)
      tell(status.alive_count_change, status.not_alive_count_change);
  }

  Participant& participant_;
  std::string name_;  ///< of the topic
  std::shared_ptr<Intake> intake_;
  eprosima::fastdds::dds::DataReader* reader_ = nullptr;
  eprosima::fastdds::dds::SampleInfo info_;
  std::atomic<int> matched_{0};
  mutable std::mutex mutex_;
  std::vector<std::uint64_t> heard_;  ///< participants of the matched writers, once a writer
};

}  // namespace ehm::idl
