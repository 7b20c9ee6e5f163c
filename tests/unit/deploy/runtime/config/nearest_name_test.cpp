// SPDX-License-Identifier: Apache-2.0
#include "deploy/runtime/config/nearest_name.h"

#include <gtest/gtest.h>

namespace {

using ehm::config::edit_distance;
using ehm::config::nearest_name;

TEST(EditDistance, CountsInsertedDeletedReplacedAndSwapped) {
  EXPECT_EQ(edit_distance("", ""), 0u);
  EXPECT_EQ(edit_distance("", "abc"), 3u);
  EXPECT_EQ(edit_distance("design", "design"), 0u);
  EXPECT_EQ(edit_distance("desing", "design"), 1u);  // neighbours swapped
  EXPECT_EQ(edit_distance("dommain", "domain"), 1u);
  EXPECT_EQ(edit_distance("domin", "domain"), 1u);
  EXPECT_EQ(edit_distance("domein", "domain"), 1u);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);  // the textbook's example
  EXPECT_EQ(edit_distance("ca", "abc"), 3u);          // of optimal string alignment; unrestricted Damerau has 2
}

TEST(EditDistance, IsSymmetric) {
  for (const auto& [a, b] : {std::pair{"ab", "ba"}, {"seed", "speed"}, {"--out", "--quiet"}, {"abcd", "badc"}})
    EXPECT_EQ(edit_distance(a, b), edit_distance(b, a)) << a << ' ' << b;
}

TEST(NearestName, FindsATypingError) {
  const std::vector<std::string> known{"--domain", "--seconds", "--json", "--dds-security"};
  EXPECT_EQ(nearest_name("--dommain", known), "--domain");
  EXPECT_EQ(nearest_name("--jsno", known), "--json");
  EXPECT_EQ(nearest_name("--dds-securty", known), "--dds-security");
  EXPECT_EQ(nearest_name("--dds_secruity", known), "--dds-security");
  EXPECT_EQ(nearest_name("maps", {"deck", "mops", "map"}), "mops");  // the first of two at one distance
}

TEST(NearestName, SaysNothingWhenNothingIsNear) {
  const std::vector<std::string> known{"--domain", "--seconds", "--json", "-h", "-o"};
  EXPECT_EQ(nearest_name("--altitude", known), "");
  EXPECT_EQ(nearest_name("--x", known), "");  // too short to be like anything
  EXPECT_EQ(nearest_name("-x", known), "");
  EXPECT_EQ(nearest_name("--demons", known), "");  // 3 edits from --domain, of 6 letters
  EXPECT_EQ(nearest_name("--", known), "");
  EXPECT_EQ(nearest_name("", known), "");
  EXPECT_EQ(nearest_name("--domain", {}), "");
  EXPECT_EQ(nearest_name("--a-rather-long-optoin-nmae-wiht-four", {"--a-rather-long-option-name-with-fuor"}), "");
}

}  // namespace
