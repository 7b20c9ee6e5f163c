// SPDX-License-Identifier: Apache-2.0
// The product against Eigen's own, for every number of rows, and the same bits from both of its forms.

#include "monitor/estimation/linear/padded_matrix.h"

#include <gtest/gtest.h>

#include "tests/unit/tuner_design/test_models.h"

namespace ehm::estimation {
namespace {

constexpr int most_rows = PaddedMatrix::rows_of_group * PaddedMatrix::most_groups;

/// With room behind, to see that nothing is written there.
struct alignas(32) Room {
  Eigen::Matrix<double, most_rows + 4, 1> values = Eigen::Matrix<double, most_rows + 4, 1>::Constant(77.0);
};

struct Case {
  Case(test::Random& random, Eigen::Index rows, Eigen::Index x_size, Eigen::Index u_size)
      : M(random.normal_matrix(rows, x_size + u_size)),
        x(random.normal_vector(x_size)),
        u(random.normal_vector(u_size)) {
    from.values.head(rows) = random.normal_vector(rows);
  }
  Room product(bool wide_vectors) const {
    Room y;
    PaddedMatrix(M, wide_vectors).product(from.values.data(), x.data(), x.size(), u.data(), y.values.data());
    return y;
  }
  Eigen::MatrixXd M;
  Eigen::VectorXd x, u;
  Room from;
};

TEST(PaddedMatrix, MultipliesForEveryNumberOfRows) {
  test::Random random(1);
  for (Eigen::Index rows = 0; rows <= most_rows; ++rows) {
    for (const Eigen::Index x_size : {0, 1, 9, 28}) {
      for (const Eigen::Index u_size : {0, 3}) {
        SCOPED_TRACE(testing::Message() << rows << " x (" << x_size << " + " << u_size << ")");
        const Case c(random, rows, x_size, u_size);
        Eigen::VectorXd both(x_size + u_size);
        both << c.x, c.u;
        const Room y = c.product(has_wide_vectors());
        EXPECT_LT((y.values.head(rows) - c.from.values.head(rows) - c.M * both).norm(), 1e-13);
        EXPECT_EQ(y.values((rows + 3) / 4 * 4), 77.0) << "it wrote behind the last group";
      }
    }
  }
}

TEST(PaddedMatrix, GivesTheSameBitsOnEveryProcessor) {
  if (!has_wide_vectors()) GTEST_SKIP() << "this processor has one form of the product";
  test::Random random(2);
  for (Eigen::Index rows = 1; rows <= most_rows; ++rows) {
    const Case c(random, rows, 9, 3);
    EXPECT_EQ(c.product(true).values, c.product(false).values) << rows;
  }
}

TEST(PaddedMatrix, SumsColumnByColumn) {
  // 1 + 1e-17 - 1 is 0 from left to right; another order would keep the 1e-17.
  test::Random random(3);
  Case c(random, 5, 2, 1);
  c.M = Eigen::RowVector3d(1.0, 1e-17, -1.0).replicate(5, 1);
  c.x.setOnes();
  c.u.setOnes();
  c.from.values.setZero();
  EXPECT_EQ(c.product(has_wide_vectors()).values.head(5), (Eigen::Matrix<double, 5, 1>::Zero()));
}

}  // namespace
}  // namespace ehm::estimation
