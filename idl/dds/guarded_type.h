#pragma once
// A generated type whose deserialisation refuses what is not of the type, and never throws: the generated code lets
// some exceptions of malformed messages through, and they would end the service from within the middleware.

#include <exception>

#include "engine_healthPubSubTypes.h"

namespace ehm::wire {

template <class PubSubType>
class GuardedType : public PubSubType {
 public:
  bool deserialize(eprosima::fastrtps::rtps::SerializedPayload_t* payload, void* data) override {
    try {
      return PubSubType::deserialize(payload, data);
    } catch (const std::exception&) {
      return false;
    }
  }
};

}  // namespace ehm::wire
