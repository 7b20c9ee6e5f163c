#pragma once
// The certificate of a design, as the object "certificate" of a design file and of `tuner_design design --json`.

#include <string>

#include "monitor/design/certificate.h"
#include "monitor/design/json_object.h"

namespace ehm::design {

/// @throws FileError if a number is not finite.
Json certificate_to_json(const Certificate& certificate, const std::string& file);
/// @throws FileError (file, key, value, allowed) for every defect.
Certificate certificate_from_json(const Json& json, const std::string& file);

}  // namespace ehm::design
