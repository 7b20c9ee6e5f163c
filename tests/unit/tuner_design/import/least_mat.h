// SPDX-License-Identifier: Apache-2.0
#pragma once
// The smallest model as a MATLAB file, whole or with a defect, and what the import says to it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "deploy/runtime/files/file_error.h"
#include "tests/unit/tuner_design/model_files.h"
#include "tests/unit/tuner_design/test_models.h"
#include "tuner_design/import/import_model.h"

namespace ehm::tuner_design {

using test::MatWriter;

inline std::string mat_path() {
  return test::temporary_path("model.mat");
}

inline ImportedModel import(const std::function<void(MatWriter&)>& write, const ImportOptions& options = {}) {
  {
    MatWriter mat(mat_path());
    write(mat);
  }
  return import_model(mat_path(), options);
}

/// The message without the path in front; "accepted" if there is none.
inline std::string message(const std::function<void()>& action) {
  try {
    action();
  } catch (const files::FileError& error) {
    const std::string text = error.what();
    EXPECT_THAT(text, testing::StartsWith(mat_path()));
    return text.substr(mat_path().size());
  }
  return "accepted";
}

inline std::string refusal(const std::function<void(MatWriter&)>& write, const ImportOptions& options = {}) {
  return message([&] { import(write, options); });
}

/// The least that makes a model, all in percent: one state, two sensors, three health parameters.
struct Least {
  Eigen::MatrixXd A = Eigen::MatrixXd::Constant(1, 1, 0.9);
  Eigen::MatrixXd L = (Eigen::MatrixXd(1, 3) << 0.1, -0.2, 0.05).finished();
  Eigen::MatrixXd C = (Eigen::MatrixXd(2, 1) << 1.0, 0.5).finished();
  Eigen::MatrixXd M = (Eigen::MatrixXd(2, 3) << 0.0, 0.0, 0.0, 0.7, 0.1, -0.3).finished();

  void write(MatWriter& mat) const {
    mat.numbers("A", A);
    mat.numbers("L", L);
    mat.numbers("C", C);
    mat.numbers("M", M);
    mat.number("Ts", 0.02);
  }
};

inline void write_least(MatWriter& mat) {
  Least().write(mat);
}

}  // namespace ehm::tuner_design
