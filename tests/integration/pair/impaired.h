// SPDX-License-Identifier: Apache-2.0
#pragma once
// A simulator on a domain of its own, and between it and the monitor an impairing re-publisher. The monitor and the
// fixture's listener are beyond it; `source_listener_` hears the simulator itself, and so the truth.

#include <nlohmann/json.hpp>

#include "tests/integration/pair/pair.h"

namespace ehm::test {

class ImpairedTest : public PairTest {
 protected:
  ImpairedTest();

  /// Starts monitor, re-publisher and simulator, flies `duration_s`, and waits until the monitor has nothing more to
  /// hear. `schedule`: lines of ehm_impair's schedule.
  void fly(double duration_s, const std::vector<std::string>& impair_flags, const std::string& schedule = "");
  /// What the re-publisher counted.
  std::uint64_t impaired(const char* counter) const { return impairment_.at(counter); }
  const MonitorStatus& status() const { return listener_.status.back(); }

  /// What a monitor must have counted of the samples in the order in which the listener heard them.
  struct Account {
    std::uint64_t in_order = 0, lost = 0, duplicated = 0, reordered = 0;
  };
  Account account() const;
  /// Every sample sent is in exactly one counter, and the counters are those of the listener's account.
  void expect_all_accounted_for() const;

  std::uint32_t source_domain_;
  idl::Participant source_participant_;
  Listener source_listener_;
  std::unique_ptr<Process> monitor_;

 private:
  nlohmann::json impairment_;
};

}  // namespace ehm::test
