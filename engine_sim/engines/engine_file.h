// SPDX-License-Identifier: Apache-2.0
#pragma once
// An engine as a file, JSON, schema "ehm-engine/1": everything of EngineDefinition, maps included (data_json.h,
// map_json.h, control_json.h, channels_json.h tell the keys, ranges and units; deploy/docs/engine_files.md the reader).
// Numbers are in the shortest form that reads back to the same double, so that a written engine flies to the bit as the
// one it was written from.
// @throws files::FileError (file, key, value, allowed, what to do) for every defect; unknown keys are defects.

#include <string>

#include "engine_sim/engines/engine_definition.h"

namespace ehm::engine_sim {

inline constexpr const char* engine_schema = "ehm-engine/1";

EngineDefinition read_engine(const std::string& path);
/// `file` is only named in messages.
EngineDefinition engine_from_text(const std::string& text, const std::string& file);

std::string engine_text(const EngineDefinition& engine);
/// Atomically (temporary file, rename).
void write_engine(const EngineDefinition& engine, const std::string& path);

/// SHA-256 of engine_text without the source: the same for engines that fly the same, however their file is laid out.
std::string engine_hash(const EngineDefinition& engine);

}  // namespace ehm::engine_sim
