// SPDX-License-Identifier: Apache-2.0
#pragma once
// Linear models as users write them, for tests: MATLAB files by libmatio, CSV folders.

#include <matio.h>

#include <Eigen/Core>
#include <string>
#include <vector>

#include "engine_sim/linear_model/linear_model.h"

namespace ehm::test {

/// A MATLAB v5 file in the making.
class MatWriter {
 public:
  explicit MatWriter(const std::string& path, mat_ft version = MAT_FT_MAT5);
  ~MatWriter();
  MatWriter(const MatWriter&) = delete;
  MatWriter& operator=(const MatWriter&) = delete;

  void numbers(const char* name, const Eigen::MatrixXd& matrix);
  void number(const char* name, double value) { numbers(name, Eigen::MatrixXd::Constant(1, 1, value)); }
  void complex(const char* name, const Eigen::MatrixXd& real, const Eigen::MatrixXd& imaginary);
  void sparse(const char* name, const Eigen::MatrixXd& matrix);
  void int32(const char* name, const Eigen::MatrixXi& matrix);
  void text(const char* name, const std::string& text) { texts(name, {text}); }
  /// A character matrix: rows filled up with blanks.
  void texts(const char* name, const std::vector<std::string>& rows);
  void cells(const char* name, const std::vector<std::string>& texts, bool as_row = false);
  /// From here on, variables become fields of this structure.
  void begin_structure(const char* name);

 private:
  void add(matvar_t* variable);

  mat_t* file_;
  matvar_t* structure_ = nullptr;
};

/// Each variable deflated, as save -v7 does it. (libmatio 1.5.23 writes wrong sizes for compressed texts.)
void compress(const std::string& mat_file);

/// Everything that the model states.
void write_all(MatWriter& mat, const linear_model::LinearModel& model);
void write_csv_folder(const std::string& folder, const linear_model::LinearModel& model);

}  // namespace ehm::test
