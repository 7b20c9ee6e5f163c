// SPDX-License-Identifier: Apache-2.0
#pragma once
// A generated type whose deserialisation refuses what is not of the type, puts right what no sample may bring along
// (tidy.h), and never throws: the generated code lets some exceptions of malformed messages through, and they would end
// the service from within the middleware.
// What is refused is counted where an Intake is given.

#include <exception>
#include <memory>
#include <utility>

#include "engine_healthPubSubTypes.h"
#include "idl/dds/intake.h"
#include "idl/dds/tidy.h"

namespace ehm::idl {

template <class PubSubType>
class GuardedType : public PubSubType {
 public:
  explicit GuardedType(std::shared_ptr<Intake> intake = nullptr) : intake_(std::move(intake)) {}
  bool deserialize(eprosima::fastrtps::rtps::SerializedPayload_t* payload, void* data) override {
    const bool done = try_to_deserialize(payload, data);
    if (done) tidy(*static_cast<typename PubSubType::type*>(data));
    if (!done && intake_) intake_->misfit(payload->length);
    return done;
  }

 private:
  bool try_to_deserialize(eprosima::fastrtps::rtps::SerializedPayload_t* payload, void* data) {
    try {
      return PubSubType::deserialize(payload, data);
    } catch (const std::exception&) {
      return false;
    }
  }
  std::shared_ptr<Intake> intake_;
};

}  // namespace ehm::idl
