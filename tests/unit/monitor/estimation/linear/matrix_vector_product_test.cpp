// SPDX-License-Identifier: Apache-2.0
// The product against Eigen's own, over all sizes that the blocks distinguish, and its order of summation.

#include "monitor/estimation/linear/matrix_vector_product.h"

#include <gtest/gtest.h>

#include "monitor/estimation/capacity.h"
#include "tests/unit/tuner_design/test_models.h"

namespace ehm::estimation {
namespace {

TEST(MatrixVectorProduct, AddsTheProductForEveryNumberOfRows) {
  test::Random random(1);
  for (Eigen::Index rows = 0; rows <= 36; ++rows) {
    for (const Eigen::Index columns : {0, 1, 9, 36}) {
      SCOPED_TRACE(testing::Message() << rows << " x " << columns);
      const BoundedMatrix<36, 36> M = random.normal_matrix(rows, columns);
      const Eigen::VectorXd x = random.normal_vector(columns), start = random.normal_vector(rows);
      Eigen::VectorXd y(rows + 1);
      y << start, 77.0;
      add_product(M, x.data(), y.data());
      EXPECT_LT((y.head(rows) - start - Eigen::MatrixXd(M) * x).norm(), 1e-13);
      EXPECT_EQ(y(rows), 77.0) << "it wrote behind the last row";
    }
  }
}

TEST(MatrixVectorProduct, TakesColumnsOfALargerMatrix) {
  test::Random random(2);
  const BoundedMatrix<16, 28> M = random.normal_matrix(10, 9);
  const Eigen::VectorXd x = random.normal_vector(7);
  Eigen::VectorXd y = Eigen::VectorXd::Zero(10);
  add_product(M.rightCols(7), x.data(), y.data());
  EXPECT_LT((y - Eigen::MatrixXd(M).rightCols(7) * x).norm(), 1e-13);
}

TEST(MatrixVectorProduct, SumsColumnByColumn) {
  // 1 + 1e-17 - 1 is 0 from left to right; another order would keep the 1e-17.
  const Eigen::RowVector3d row(1.0, 1e-17, -1.0);
  const Eigen::MatrixXd M = row.replicate(11, 1);
  const Eigen::Vector3d x = Eigen::Vector3d::Ones();
  Eigen::VectorXd y = Eigen::VectorXd::Zero(11);
  add_product(M, x.data(), y.data());
  EXPECT_EQ(y, Eigen::VectorXd::Zero(11));
}

}  // namespace
}  // namespace ehm::estimation
