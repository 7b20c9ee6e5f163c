// SPDX-License-Identifier: Apache-2.0
#pragma once
// A remote participant in words, as far as it announces itself: name and address.

#include <fastdds/rtps/builtin/data/ParticipantProxyData.h>

#include <sstream>
#include <string>

#include "idl/printable.h"

namespace ehm::idl {

inline std::string participant_text(const eprosima::fastrtps::rtps::ParticipantProxyData& participant) {
  std::ostringstream text;
  text << "'" << printable(participant.m_participantName.c_str()) << "'";
  const auto& addresses = participant.metatraffic_locators.unicast;
  if (!addresses.empty()) text << " at " << addresses[0];
  return text.str();
}

}  // namespace ehm::idl
