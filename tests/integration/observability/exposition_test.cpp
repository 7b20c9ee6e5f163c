// SPDX-License-Identifier: Apache-2.0
// The strict reader itself: what it must refuse.

#include <gtest/gtest.h>

#include "tests/integration/observability/exposition.h"

namespace {

using ehm::test::Exposition;

const std::string good =
    "# HELP a_total Counted.\n# TYPE a_total counter\na_total{x=\"1\"} 2\na_total{x=\"q\\\"\"} 3e1\n";

TEST(Exposition, ReadsSeriesByTheirLabels) {
  const Exposition metrics(good);
  EXPECT_EQ(metrics.value("a_total", {{"x", "1"}}), 2.0);
  EXPECT_EQ(metrics.value("a_total", {{"x", "q\\\""}}), 30.0);
  EXPECT_THROW(metrics.value("a_total"), std::runtime_error);  // several
  EXPECT_THROW(metrics.value("b"), std::runtime_error);
}

TEST(Exposition, RefusesWhatPrometheusWould) {
  for (const std::string bad :
       {"", "a 1\n", "# HELP a A.\n# TYPE a gauge\na 1", "# HELP a A.\n# TYPE a gauge\na one\n",
        "# HELP a A.\n# TYPE a gauge\na{x=1} 1\n", "# HELP a A.\n# TYPE a gauge\na 1\na 1\n",
        "# HELP a A.\n# TYPE a gauge\nb 1\n", "# HELP a A.\n# TYPE a gauge\n", "# TYPE a gauge\na 1\n",
        "# HELP a A.\n# TYPE a gauge\na{x=\"1\" y=\"2\"} 1\n", "# HELP a A.\n# TYPE a gauge\n\na 1\n"})
    EXPECT_THROW(Exposition{bad}, std::runtime_error) << bad;
  EXPECT_THROW(Exposition(good + good), std::runtime_error);  // a family twice
}

}  // namespace
