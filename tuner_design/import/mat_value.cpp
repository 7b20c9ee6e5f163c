// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/import/mat_value.h"

#include <cmath>
#include <cstdint>
#include <cstring>

#include "deploy/runtime/files/file_error.h"
#include "deploy/runtime/numbers/index.h"

namespace ehm::tuner_design {
namespace {

using files::FileError;

constexpr std::size_t most_entries = 10000;  // linearisation_error, the largest, has 24 x 24

/// Readable name of what a variable is, where that is not numbers.
std::string class_name(matio_classes type) {
  switch (type) {
    case MAT_C_CELL:
      return "a cell array";
    case MAT_C_STRUCT:
      return "a structure";
    case MAT_C_CHAR:
      return "a text";
    case MAT_C_EMPTY:
      return "empty";
    case MAT_C_FUNCTION:
      return "a function";
    case MAT_C_OBJECT:
    case MAT_C_OPAQUE:
      return "an object (string, table, ss, ...)";
    default:
      return "numeric";
  }
}

template <typename T>
double entry(const void* data, std::size_t index) {
  T value;
  std::memcpy(&value, static_cast<const char*>(data) + index * sizeof(T), sizeof(T));
  return static_cast<double>(value);
}

/// One number of an array of the given type. @returns NaN for a type that holds no numbers.
double entry(matio_types type, const void* data, std::size_t index) {
  switch (type) {
    case MAT_T_DOUBLE:
      return entry<double>(data, index);
    case MAT_T_SINGLE:
      return static_cast<double>(entry<float>(data, index));
    case MAT_T_INT8:
      return entry<std::int8_t>(data, index);
    case MAT_T_UINT8:
      return entry<std::uint8_t>(data, index);
    case MAT_T_INT16:
      return entry<std::int16_t>(data, index);
    case MAT_T_UINT16:
      return entry<std::uint16_t>(data, index);
    case MAT_T_INT32:
      return entry<std::int32_t>(data, index);
    case MAT_T_UINT32:
      return entry<std::uint32_t>(data, index);
    case MAT_T_INT64:
      return entry<std::int64_t>(data, index);
    case MAT_T_UINT64:
      return entry<std::uint64_t>(data, index);
    default:
      return std::nan("");
  }
}

struct Shape {
  std::size_t rows, cols;
};

Shape shape_of(const matvar_t& variable, const std::string& place) {
  if (variable.rank != 2) {
    throw FileError(place + " has " + std::to_string(variable.rank) + " dimensions; allowed: 2. Give a matrix.");
  }
  const Shape shape{variable.dims[0], variable.dims[1]};
  if (shape.rows > most_entries || shape.cols > most_entries || shape.rows * shape.cols > most_entries) {
    throw FileError(place + " is " + std::to_string(shape.rows) + " x " + std::to_string(shape.cols) +
                    "; allowed: at most " + std::to_string(most_entries) + " entries. Is it the matrix of the model?");
  }
  return shape;
}

[[noreturn]] void refuse_damaged(const std::string& place) {
  throw FileError(place + " cannot be read; the file is damaged. Save or copy it again.");
}

std::string position(const std::string& place, std::size_t row, std::size_t col) {
  return place + "(" + std::to_string(row + 1) + "," + std::to_string(col + 1) + ")";
}

[[noreturn]] void refuse_complex(const std::string& place) {
  throw FileError(place + " is complex; allowed: real numbers. Give its real part, if the rest is round-off.");
}

/// Numbers of a full array, column by column. A complex one holds two arrays.
Eigen::MatrixXd full_numbers(const matvar_t& variable, Shape shape, const std::string& place) {
  const std::size_t size = shape.rows * shape.cols;
  const void* real = variable.data;
  if (variable.isComplex != 0 && real != nullptr) {
    const auto* parts = static_cast<const mat_complex_split_t*>(variable.data);
    real = parts->Re;
    for (std::size_t i = 0; i < size && parts->Im != nullptr; ++i) {
      if (entry(variable.data_type, parts->Im, i) != 0.0)
        refuse_complex(position(place, i % shape.rows, i / shape.rows));
    }
  }
  if (size > 0 && (real == nullptr || variable.nbytes < size * Mat_SizeOf(variable.data_type))) refuse_damaged(place);
  Eigen::MatrixXd result(shape.rows, shape.cols);
  for (std::size_t i = 0; i < size; ++i) result.data()[i] = entry(variable.data_type, real, i);
  return result;
}

/// Compressed columns: those of column j are data[jc[j]] to data[jc[j+1] - 1], in the rows ir.
Eigen::MatrixXd sparse_numbers(const matvar_t& variable, Shape shape, const std::string& place) {
  if (variable.isComplex != 0) refuse_complex(place);
  const auto* sparse = static_cast<const mat_sparse_t*>(variable.data);
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(as_index(shape.rows), as_index(shape.cols));
  if (sparse == nullptr || sparse->jc == nullptr || sparse->njc != shape.cols + 1) refuse_damaged(place);
  for (std::size_t col = 0; col < shape.cols; ++col) {
    for (std::size_t k = sparse->jc[col]; k < sparse->jc[col + 1]; ++k) {
      if (k >= sparse->nir || k >= sparse->ndata || sparse->ir[k] >= shape.rows || sparse->data == nullptr)
        refuse_damaged(place);
      result(as_index(sparse->ir[k]), as_index(col)) = entry(variable.data_type, sparse->data, k);
    }
  }
  return result;
}

/// Rows of a character matrix.
std::vector<std::string> char_rows(const matvar_t& variable, const std::string& place) {
  const Shape shape = shape_of(variable, place);
  const std::size_t size = shape.rows * shape.cols;
  if (size == 0) return {""};
  const auto unit = Mat_SizeOf(variable.data_type);
  if (variable.data == nullptr || variable.nbytes < size * unit) refuse_damaged(place);
  std::vector<std::string> rows(shape.rows);
  for (std::size_t i = 0; i < size; ++i) {
    std::uint32_t code = 0;
    if (unit == 1) code = *(static_cast<const std::uint8_t*>(variable.data) + i);
    if (unit == 2) code = *(static_cast<const std::uint16_t*>(variable.data) + i);
    if (unit == 4) code = *(static_cast<const std::uint32_t*>(variable.data) + i);
    if (code < ' ' || code > '~') {
      throw FileError(place +
                      " has a character outside ASCII; allowed: letters, digits, signs. Write degC, alpha, ...");
    }
    rows[i % shape.rows] += static_cast<char>(code);
  }
  for (std::string& row : rows) row.erase(row.find_last_not_of(' ') + 1);
  return rows;
}

/// One text of a cell array; an empty cell is an empty text.
std::string cell_text(const matvar_t* cell, const std::string& place) {
  if (cell == nullptr) refuse_damaged(place);
  if (cell->class_type == MAT_C_EMPTY || (cell->class_type == MAT_C_DOUBLE && cell->nbytes == 0)) return "";
  if (cell->class_type != MAT_C_CHAR)
    throw FileError(place + " is " + class_name(cell->class_type) +
                    "; allowed: a text. Write it in quotes '', or take convertStringsToChars() of the cell array.");
  const std::vector<std::string> rows = char_rows(*cell, place);
  if (rows.size() == 1) return rows.front();
  throw FileError(place + " is " + std::to_string(rows.size()) + " texts; allowed: one in a cell.");
}

}  // namespace

Eigen::MatrixXd mat_numbers(const matvar_t& variable, const std::string& place) {
  const matio_classes type = variable.class_type;
  if (type == MAT_C_EMPTY) return {};
  const bool sparse = type == MAT_C_SPARSE;
  if (!sparse && (type < MAT_C_DOUBLE || type > MAT_C_UINT64)) {
    throw FileError(place + " is " + class_name(type) + "; allowed: a matrix of numbers. " +
                    (type == MAT_C_OPAQUE || type == MAT_C_OBJECT ? "Take the matrices out of it, as ssdata(sys) does."
                                                                  : "Give the numbers."));
  }
  const Shape shape = shape_of(variable, place);
  Eigen::MatrixXd result = sparse ? sparse_numbers(variable, shape, place) : full_numbers(variable, shape, place);
  for (Eigen::Index j = 0; j < result.cols(); ++j) {
    for (Eigen::Index i = 0; i < result.rows(); ++i) {
      if (std::isfinite(result(i, j))) continue;
      throw FileError(position(place, as_size(i), as_size(j)) + " is " +
                      (std::isnan(result(i, j)) ? "NaN" : "infinite") +
                      "; allowed: a finite number. Derive it again, or leave the variable out if it is optional.");
    }
  }
  return result;
}

std::vector<std::string> mat_texts(const matvar_t& variable, const std::string& place) {
  if (variable.class_type == MAT_C_CHAR) return char_rows(variable, place);
  if (variable.class_type != MAT_C_CELL) {
    throw FileError(
        place + " is " + class_name(variable.class_type) +
        "; allowed: a cell array of texts, {'N1', 'N2'}, or a character matrix. cellstr() makes one of strings.");
  }
  const Shape shape = shape_of(variable, place);
  const std::size_t size = shape.rows * shape.cols;
  if (size > 0 && (variable.data == nullptr || variable.nbytes < size * sizeof(matvar_t*))) refuse_damaged(place);
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < size; ++i) {
    texts.push_back(
        cell_text(static_cast<matvar_t* const*>(variable.data)[i], place + "{" + std::to_string(i + 1) + "}"));
  }
  return texts;
}

}  // namespace ehm::tuner_design
