// SPDX-License-Identifier: Apache-2.0
#include "deploy/runtime/service/listen_address.h"

#include <charconv>
#include <stdexcept>

namespace ehm::service {

bool ListenAddress::loopback() const {
  return host == "localhost" || host == "::1" || host.starts_with("127.");
}

ListenAddress parse_listen_address(const std::string& text) {
  const auto refuse = [&] {
    return std::invalid_argument("is '" + text +
                                 "', allowed is HOST:PORT or [IPV6]:PORT with a port from 0 (any) to 65535");
  };
  const auto colon = text.rfind(':');
  if (colon == std::string::npos) throw refuse();
  ListenAddress address{text.substr(0, colon)};
  const char *begin = text.data() + colon + 1, *end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(begin, end, address.port);
  if (error != std::errc() || stop != end || address.port < 0 || address.port > 65535) throw refuse();
  const bool bracketed = address.host.starts_with('[') && address.host.ends_with(']');
  if (bracketed) address.host = address.host.substr(1, address.host.size() - 2);
  if (address.host.empty() || (!bracketed && address.host.find(':') != std::string::npos)) throw refuse();
  return address;
}

}  // namespace ehm::service
