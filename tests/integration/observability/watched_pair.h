// SPDX-License-Identifier: Apache-2.0
#pragma once
// The pair with its HTTP endpoint on a port that was free.

#include <httplib.h>

#include <regex>

#include "tests/integration/observability/exposition.h"
#include "tests/integration/pair/pair.h"

namespace ehm::test {

class WatchedPairTest : public PairTest {
 protected:
  std::unique_ptr<Process> start_watched_monitor(std::vector<std::string> flags = {}) {
    flags.insert(flags.end(), {"--metrics-listen", "127.0.0.1:0", "--monitor-status-period-s", "0.1"});
    auto monitor = start_monitor(flags);
    std::smatch match;
    std::string log;
    EXPECT_TRUE(listener_.await([&] {
      log = monitor->log();
      return std::regex_search(log, match, std::regex("metrics at http://127\\.0\\.0\\.1:([0-9]+)/metrics"));
    })) << log;
    port_ = match.size() > 1 ? std::stoi(match[1]) : 0;
    return monitor;
  }

  /// Status and body; status 0 where nobody answered.
  httplib::Response get(const std::string& path) const {
    httplib::Client client("127.0.0.1", port_);
    client.set_read_timeout(20);
    const auto result = client.Get(path);
    return result ? *result : httplib::Response{};
  }
  Exposition scrape() const { return Exposition(get("/metrics").body); }

  int port_ = 0;
};

}  // namespace ehm::test
