// SPDX-License-Identifier: Apache-2.0
// ehm_command on a secured domain: an operator's orders are carried out and answered, a viewer cannot even give them.

#include <gmock/gmock.h>

#include "tests/integration/security/secured_pair.h"

namespace {

using namespace ehm::test;
using testing::HasSubstr;

class SecuredOperatorTest : public SecuredPair {
 protected:
  std::vector<std::string> clear_as(const std::string& role) const {
    return {EHM_COMMAND, "--domain", std::to_string(domain_), "--security", identity(role), "clear"};
  }
};

TEST_F(SecuredOperatorTest, AnOperatorIsAnsweredAndAViewerRefused) {
  start_all();
  Process by_operator(clear_as("operator"));
  EXPECT_EQ(by_operator.wait(seconds(20)), 0) << simulator_->log();
  EXPECT_THAT(by_operator.log(), HasSubstr("source 1: done: no fault of any sensor"));
  Process by_viewer(clear_as("viewer"));
  EXPECT_EQ(by_viewer.wait(seconds(20)), 1);
  EXPECT_THAT(by_viewer.log(), HasSubstr("no DDS writer on topic 'SimCommand': the permissions in"));
}

}  // namespace
