// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/import/assemble_matrices.h"

#include "deploy/runtime/files/file_error.h"

namespace ehm::tuner_design {
namespace {

std::string shape(Eigen::Index rows, Eigen::Index cols) {
  return std::to_string(rows) + " x " + std::to_string(cols);
}

bool is_stated(const Variables& given, const std::string& name) {
  const Eigen::MatrixXd* matrix = given.find(name);
  return matrix != nullptr && matrix->size() > 0;
}

const Eigen::MatrixXd& required(const Variables& given, const std::string& name, const std::string& remedy) {
  if (is_stated(given, name)) return *given.find(name);
  throw files::FileError(given.source + ": " + name + " is missing or empty; a model needs A, L, C and M. " + remedy +
                         ".");
}

/// `why` says where the dimensions come from.
Eigen::MatrixXd shaped(const Variables& given, const std::string& name, Eigen::Index rows, Eigen::Index cols,
                       const std::string& why) {
  const Eigen::MatrixXd& matrix = *given.find(name);
  if (matrix.rows() == rows && matrix.cols() == cols) return matrix;
  const bool transposed = matrix.rows() == cols && matrix.cols() == rows;
  files::throw_defect(given.source, name, shape(matrix.rows(), matrix.cols()), shape(rows, cols) + ", " + why,
                      transposed ? "Transpose it" : "Check how it was derived, or the matrix that it must fit");
}

/// The direct effect of the controls, which many models do not have.
Eigen::MatrixXd direct_effect(const Variables& given, const std::string& name, Eigen::Index rows, Eigen::Index controls,
                              const std::string& why, ImportedModel& result) {
  if (is_stated(given, name)) return shaped(given, name, rows, controls, why);
  if (rows * controls > 0) result.assumed.push_back(name + ": zero, since it is not stated");
  return Eigen::MatrixXd::Zero(rows, controls);
}

}  // namespace

void assemble_matrices(const Variables& given, ImportedModel& result) {
  linear_model::LinearModel& model = result.model;
  model.A = required(given, "A", "Give the n x n matrix of the states");
  const Eigen::Index n = model.A.rows();
  shaped(given, "A", n, n, "square");
  const Eigen::MatrixXd& L = required(given, "L", "Give the effect of health on the states, n x p, zeros if none");
  const Eigen::Index p = L.cols();
  model.L = shaped(given, "L", n, p, "as many rows as A");
  const Eigen::MatrixXd& C = required(given, "C", "Give the sensors' dependence on the states, m x n, zeros if none");
  const Eigen::Index m = C.cols() != n && C.rows() == n ? C.cols() : C.rows();
  model.C = shaped(given, "C", m, n, "as many columns as A");
  required(given, "M", "Give the direct effect of health on the sensors, m x p, zeros if none");
  model.M = shaped(given, "M", m, p, "rows as C, columns as L");

  const Eigen::Index nu = is_stated(given, "B") ? given.find("B")->cols() : 0;
  model.B = direct_effect(given, "B", n, nu, "as many rows as A", result);
  const std::string controls = nu > 0 ? ", columns as B" : "; without B there are no controls";
  model.D = direct_effect(given, "D", m, nu, "rows as C" + controls, result);

  if (is_stated(given, "F") != is_stated(given, "N")) {
    throw files::FileError(given.source + ": " + (is_stated(given, "F") ? "N" : "F") +
                           " is missing or empty; auxiliary outputs need both F (r x n) and N (r x p). Give it, zeros "
                           "if it has no effect, or leave out both.");
  }
  const Eigen::Index r = is_stated(given, "F") ? given.find("F")->rows() : 0;
  model.F = r > 0 ? shaped(given, "F", r, n, "as many columns as A") : Eigen::MatrixXd::Zero(0, n);
  model.N = r > 0 ? shaped(given, "N", r, p, "rows as F, columns as L") : Eigen::MatrixXd::Zero(0, p);
  const std::string outputs = r > 0 ? "rows as F" : "without F and N there are no auxiliary outputs";
  model.G = direct_effect(given, "G", r, nu, outputs + controls, result);
}

}  // namespace ehm::tuner_design
