// SPDX-License-Identifier: Apache-2.0
#pragma once
// Our files carry a hash of their content, which no mutation survives. The fuzzer's text is sealed anew, so that the
// parser behind the hash is reached; text that is not JSON goes through as it is.

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include "deploy/runtime/files/content_hash.h"

namespace ehm::fuzz {

inline std::string sealed(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  auto json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object()) return text;
  try {
    json.erase("hash");
    json["hash"] = files::sha256_hex(json.dump());
    return json.dump();
  } catch (const nlohmann::json::exception&) {  // not UTF-8
    return text;
  }
}

}  // namespace ehm::fuzz
