// SPDX-License-Identifier: Apache-2.0
#pragma once
// The certificate of a design, as the object "certificate" of a design file and of `tuner_design design --json`.

#include <string>

#include "deploy/runtime/files/json_object.h"
#include "monitor/design/certificate.h"

namespace ehm::design {

/// @throws FileError if a number is not finite.
files::Json certificate_to_json(const Certificate& certificate, const std::string& file);
/// @throws FileError (file, key, value, allowed) for every defect.
Certificate certificate_from_json(const files::Json& json, const std::string& file);

}  // namespace ehm::design
