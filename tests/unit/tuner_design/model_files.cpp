// SPDX-License-Identifier: Apache-2.0
#include "tests/unit/tuner_design/model_files.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "deploy/runtime/files/csv_table.h"
#include "deploy/runtime/numbers/index.h"

namespace ehm::test {
namespace {

using linear_model::Channel;
using linear_model::LinearModel;

std::array<std::size_t, 2> shape(Eigen::Index rows, Eigen::Index cols) {
  return {as_size(rows), as_size(cols)};
}

matvar_t* char_matrix(const char* name, const std::vector<std::string>& rows) {
  std::size_t width = 0;
  for (const std::string& row : rows) width = std::max(width, row.size());
  std::string columns(rows.size() * width, ' ');
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t j = 0; j < rows[i].size(); ++j) columns[j * rows.size() + i] = rows[i][j];
  }
  std::array<std::size_t, 2> dims{rows.size(), width};
  return Mat_VarCreate(name, MAT_C_CHAR, MAT_T_UINT8, 2, dims.data(), columns.data(), 0);
}

struct NamedMatrix {
  const char* name;
  const Eigen::MatrixXd& matrix;
};

std::vector<NamedMatrix> matrices(const LinearModel& model) {
  return {{"A", model.A}, {"B", model.B}, {"L", model.L}, {"C", model.C}, {"D", model.D},
          {"M", model.M}, {"F", model.F}, {"G", model.G}, {"N", model.N}, {"Q", model.process_noise}};
}

struct NamedList {
  std::string kind;
  const std::vector<Channel>& channels;
};

std::vector<NamedList> lists(const LinearModel& model) {
  return {{"state", model.states},
          {"control", model.controls},
          {"health", model.health},
          {"sensor", model.sensors},
          {"auxiliary", model.auxiliary}};
}

void write_csv(const std::string& path, const Eigen::MatrixXd& matrix) {
  std::ofstream out(path);
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) out << (j > 0 ? "," : "") << files::shortest(matrix(i, j));
    out << '\n';
  }
}

}  // namespace

MatWriter::MatWriter(const std::string& path, mat_ft version) : file_(Mat_CreateVer(path.c_str(), nullptr, version)) {
  if (file_ == nullptr) throw std::runtime_error(path + " cannot be written");
}

MatWriter::~MatWriter() {
  if (structure_ != nullptr) {
    Mat_VarWrite(file_, structure_, MAT_COMPRESSION_NONE);
    Mat_VarFree(structure_);
  }
  Mat_Close(file_);
}

void MatWriter::add(matvar_t* variable) {
  if (structure_ != nullptr) {
    Mat_VarAddStructField(structure_, variable->name);
    Mat_VarSetStructFieldByName(structure_, variable->name, 0, variable);
    return;
  }
  const int failed = Mat_VarWrite(file_, variable, MAT_COMPRESSION_NONE);
  Mat_VarFree(variable);
  if (failed != 0) throw std::runtime_error("a variable cannot be written");
}

void MatWriter::numbers(const char* name, const Eigen::MatrixXd& matrix) {
  auto dims = shape(matrix.rows(), matrix.cols());
  Eigen::MatrixXd data = matrix;
  add(Mat_VarCreate(name, MAT_C_DOUBLE, MAT_T_DOUBLE, 2, dims.data(), data.data(), 0));
}

void MatWriter::complex(const char* name, const Eigen::MatrixXd& real, const Eigen::MatrixXd& imaginary) {
  auto dims = shape(real.rows(), real.cols());
  Eigen::MatrixXd re = real, im = imaginary;
  mat_complex_split_t parts{re.data(), im.data()};
  add(Mat_VarCreate(name, MAT_C_DOUBLE, MAT_T_DOUBLE, 2, dims.data(), &parts, MAT_F_COMPLEX));
}

void MatWriter::sparse(const char* name, const Eigen::MatrixXd& matrix) {
  auto dims = shape(matrix.rows(), matrix.cols());
  std::vector<double> values;
  std::vector<mat_uint32_t> rows, starts{0};
  for (Eigen::Index j = 0; j < matrix.cols(); ++j) {
    for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
      if (matrix(i, j) == 0.0) continue;
      values.push_back(matrix(i, j));
      rows.push_back(static_cast<mat_uint32_t>(i));
    }
    starts.push_back(static_cast<mat_uint32_t>(values.size()));
  }
  const auto count = static_cast<mat_uint32_t>(values.size());
  mat_sparse_t data{count, rows.data(),  count, starts.data(), static_cast<mat_uint32_t>(starts.size()),
                    count, values.data()};
  add(Mat_VarCreate(name, MAT_C_SPARSE, MAT_T_DOUBLE, 2, dims.data(), &data, 0));
}

void MatWriter::int32(const char* name, const Eigen::MatrixXi& matrix) {
  auto dims = shape(matrix.rows(), matrix.cols());
  Eigen::MatrixXi data = matrix;
  add(Mat_VarCreate(name, MAT_C_INT32, MAT_T_INT32, 2, dims.data(), data.data(), 0));
}

void MatWriter::texts(const char* name, const std::vector<std::string>& rows) {
  add(char_matrix(name, rows));
}

void MatWriter::cells(const char* name, const std::vector<std::string>& texts, bool as_row) {
  std::vector<matvar_t*> contents;
  for (const std::string& text : texts) contents.push_back(char_matrix(nullptr, {text}));
  std::array<std::size_t, 2> dims{texts.size(), 1};
  if (as_row) std::swap(dims[0], dims[1]);
  add(Mat_VarCreate(name, MAT_C_CELL, MAT_T_CELL, 2, dims.data(), contents.data(), 0));
}

void MatWriter::begin_structure(const char* name) {
  std::array<std::size_t, 2> dims{1, 1};
  structure_ = Mat_VarCreateStruct(name, 2, dims.data(), nullptr, 0);
}

void compress(const std::string& mat_file) {
  std::ostringstream whole;
  whole << std::ifstream(mat_file, std::ios::binary).rdbuf();
  const std::string bytes = whole.str();
  std::ofstream out(mat_file, std::ios::binary);
  out << bytes.substr(0, 128);
  for (std::size_t at = 128; at < bytes.size();) {
    std::uint32_t size = 0;
    std::memcpy(&size, &bytes[at + 4], 4);
    const std::string element = bytes.substr(at, 8 + size);
    uLongf length = compressBound(element.size());
    std::string deflated(length, '\0');
    compress2(reinterpret_cast<Bytef*>(deflated.data()), &length, reinterpret_cast<const Bytef*>(element.data()),
              element.size(), Z_BEST_COMPRESSION);
    const std::array<std::uint32_t, 2> tag{15, static_cast<std::uint32_t>(length)};  // miCOMPRESSED
    out.write(reinterpret_cast<const char*>(tag.data()), 8)
        .write(deflated.data(), static_cast<std::streamsize>(length));
    at += element.size();
  }
}

void write_all(MatWriter& mat, const LinearModel& model) {
  mat.text("name", model.name);
  for (const auto& [name, matrix] : matrices(model)) mat.numbers(name, matrix);
  for (const auto& [kind, channels] : lists(model)) {
    std::vector<std::string> names, units;
    Eigen::VectorXd trims(channels.size());
    for (std::size_t i = 0; i < channels.size(); ++i) {
      names.push_back(channels[i].name);
      units.push_back(channels[i].unit);
      trims(as_index(i)) = channels[i].trim;
    }
    mat.cells((kind + "_names").c_str(), names);
    mat.cells((kind + "_units").c_str(), units, true);
    mat.numbers((kind + "_trim").c_str(), trims);
  }
  mat.numbers("health_sigma", model.health_sigma);
  mat.numbers("sensor_noise_sigma", model.sensor_noise_sigma.transpose());
  mat.number("Ts", model.discrete ? model.sample_time_s : 0.0);
  mat.number("sample_time_s", model.sample_time_s);
}

void write_csv_folder(const std::string& folder, const LinearModel& model) {
  std::filesystem::create_directories(folder);
  for (const auto& [name, matrix] : matrices(model)) write_csv(folder + "/" + name + ".csv", matrix);
  std::ofstream channels_csv(folder + "/channels.csv");
  channels_csv << "kind,name,unit,trim,sigma\n";
  for (const auto& [kind, channels] : lists(model)) {
    for (std::size_t i = 0; i < channels.size(); ++i) {
      const auto at = as_index(i);
      channels_csv << kind << ',' << channels[i].name << ',' << channels[i].unit << ','
                   << files::shortest(channels[i].trim) << ',';
      if (kind == "health") channels_csv << files::shortest(model.health_sigma(at));
      if (kind == "sensor") channels_csv << files::shortest(model.sensor_noise_sigma(at));
      channels_csv << '\n';
    }
  }
  std::ofstream(folder + "/settings.csv")
      << "key,value\nname," << model.name << "\nTs," << files::shortest(model.discrete ? model.sample_time_s : 0.0)
      << "\nsample_time_s," << files::shortest(model.sample_time_s) << '\n';
}

}  // namespace ehm::test
