// SPDX-License-Identifier: Apache-2.0
#pragma once
// The object `channels` of an engine file: what the engine is measured by, asked for, set by, and worn in.
//   sensors     [{name, noise_percent, noise_of, lag_s, resolution}]   1 to 16; the last three may be left out: of trim,
//                                                                      no lag, no resolution
//   auxiliary   [name, ...]                                            0 to 8
//   controls    [name, ...]                                            1 to 8, fuel_flow among them
//   health      [{name, sigma}]                                        1 to 10
// Names are those of channel_table.h and health_names; their order is the order on the wire (idl/engine_health.idl has
// room for so many).
// @throws files::FileError (file, key, value, allowed) for an unknown or repeated name, or a number out of range

#include "deploy/runtime/files/json_object.h"
#include "engine_sim/engines/engine_definition.h"

namespace ehm::engine_sim {

NamedChannels channels_from(files::JsonObject& root);
files::Json to_json(const NamedChannels& channels);

}  // namespace ehm::engine_sim
