// SPDX-License-Identifier: Apache-2.0
#pragma once
// "HOST:PORT" or "[IPV6]:PORT", as a TCP server listens.
//
// @throws std::invalid_argument that says what is allowed.

#include <string>

namespace ehm::service {

struct ListenAddress {
  std::string host;
  int port = 0;  ///< 0: any that is free
  bool loopback() const;
};

ListenAddress parse_listen_address(const std::string& text);

}  // namespace ehm::service
