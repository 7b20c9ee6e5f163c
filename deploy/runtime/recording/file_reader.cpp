// SPDX-License-Identifier: Apache-2.0
#include "deploy/runtime/recording/file_reader.h"

#include <algorithm>
#include <array>

#include "deploy/runtime/files/file_error.h"
#include "deploy/runtime/files/input_file.h"

namespace ehm::recording {

using files::FileError;

namespace {
constexpr std::size_t longest_text = 4096;  // of an attribute: a damaged file must not ask for all memory
}

FileReader::FileReader(const std::string& path) : path_(path) {
  prepare_hdf5();
  open();
  read_info();
  open_tables();
}

void FileReader::open() {
  files::require_input_file(path_, files::recording_file);
  // HDF5 reads metadata again that a live writer is just changing, after 1, 2, 4 ns ...: 30 ms in all. Its default
  // would wait for centuries when a killed writer has left half a change behind.
  constexpr unsigned read_attempts = 25;
  const Hdf5Object access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  check(H5Pset_metadata_read_attempts(access, read_attempts), path_, "limit the attempts to read");
  const hid_t plain = H5Fopen(path_.c_str(), H5F_ACC_RDONLY, access);
  if (plain >= 0) {
    file_ = Hdf5Object(plain, H5Fclose);
    return;
  }
  // The mark of a writer that has not closed it refuses plain readers.
  file_ = own(H5Fopen(path_.c_str(), H5F_ACC_RDONLY | H5F_ACC_SWMR_READ, access), H5Fclose, path_,
              "read this as a recording (HDF5)");
  unfinished_ = true;
}

void FileReader::read_info() {
  const auto read = [&](const char* name, hid_t type, void* value) {
    const Hdf5Object attribute(H5Aopen(file_, name, H5P_DEFAULT), H5Aclose);
    if (attribute < 0)
      throw FileError(path_ + ": is an HDF5 file, but no recording: attribute '" + name + "' is missing");
    check(H5Aread(attribute, type, value), path_, std::string("read attribute '") + name + "'");
  };
  const auto read_text = [&](const char* name) {
    const Hdf5Object attribute(H5Aopen(file_, name, H5P_DEFAULT), H5Aclose);
    const Hdf5Object stored(attribute < 0 ? -1 : H5Aget_type(attribute), H5Tclose), type(H5Tcopy(H5T_C_S1), H5Tclose);
    const std::size_t size = std::min(stored < 0 ? text_size : H5Tget_size(stored), longest_text);
    H5Tset_size(type, size + 1);
    std::string text(size + 1, '\0');
    read(name, type, text.data());
    return std::string(text.c_str());
  };
  if (const std::string format = read_text("format"); format != format_name)
    throw FileError(path_ + ": attribute 'format' is '" + format + "', allowed is '" + format_name + "'");
  std::int64_t version = 0;
  read("format_version", H5T_NATIVE_INT64, &version);
  if (version != format_version)
    throw FileError(path_ + ": attribute 'format_version' is " + std::to_string(version) + ", allowed is " +
                    std::to_string(format_version));
  read("recording_id", H5T_NATIVE_INT64, &info_.recording_id);
  read("part", H5T_NATIVE_INT64, &info_.part);
  read("monitor_source_id", H5T_NATIVE_INT64, &info_.monitor_source_id);
  read("sample_time_s", H5T_NATIVE_DOUBLE, &info_.sample_time_s);
  info_.created_by = read_text("created_by");
  if (H5Aexists(file_, "published") > 0) info_.published = read_text("published");
  if (H5Aexists(file_, "shadows") > 0) info_.shadows = read_text("shadows");
  auto flight = read_channels("W");
  if (flight.size() < flight_channels) throw FileError(path_ + ": W_var has too few names");
  info_.channels.actuators.assign(flight.begin() + flight_channels, flight.end());
  info_.channels.sensors = read_channels("X_s");
  info_.channels.auxiliary = read_channels("X_v");
  info_.channels.health = read_channels("T");
  design_hashes_ = read_texts("design_hash");
}

std::vector<Channel> FileReader::read_channels(const std::string& name) const {
  const auto names = read_texts(name + "_var"), units = read_texts(name + "_unit");
  if (names.size() != units.size())
    throw FileError(path_ + ": " + name + "_var and " + name + "_unit differ in length");
  std::vector<Channel> channels;
  for (std::size_t i = 0; i < names.size(); ++i) channels.push_back({names[i], units[i]});
  return channels;
}

std::vector<std::string> FileReader::read_texts(const std::string& name) const {
  if (H5Lexists(file_, name.c_str(), H5P_DEFAULT) <= 0) return {};
  const std::string action = "read " + name;
  const auto dataset = own(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose, path_, action);
  const Hdf5Object space(H5Dget_space(dataset), H5Sclose), type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type, text_size + 1);
  const hssize_t count = H5Sget_simple_extent_npoints(space);
  constexpr hssize_t most = 100'000;  // a damaged file must not ask for all memory
  if (count < 0 || count > most) throw FileError(path_ + ": " + name + " has an impossible size");
  std::vector<std::array<char, text_size + 1>> bytes(static_cast<std::size_t>(count));
  if (count > 0) check(H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data()), path_, action);
  std::vector<std::string> texts;
  for (const auto& text : bytes) texts.emplace_back(text.data());
  return texts;
}

void FileReader::open_tables() {
  const auto open_table = [&](const char* name, std::size_t width) {
    auto dataset = own(H5Dopen2(file_, name, H5P_DEFAULT), H5Dclose, path_, std::string("open table ") + name);
    const Hdf5Object space(H5Dget_space(dataset), H5Sclose);
    std::array<hsize_t, 2> extent{};
    if (H5Sget_simple_extent_ndims(space) != 2 || H5Sget_simple_extent_dims(space, extent.data(), nullptr) != 2 ||
        extent[1] != width)
      throw FileError(path_ + ": table " + name + " has not " + std::to_string(width) + " columns");
    // A is written last: the others have at least its rows, unless the file is damaged.
    total_rows_ = std::string(name) == "A" ? extent[0] : std::min<std::uint64_t>(total_rows_, extent[0]);
    return dataset;
  };
  identities_ = open_table("A", identity_columns);
  constexpr std::array<std::size_t, 4> capacity{flight_channels + max_actuators, max_sensors, max_auxiliary,
                                                max_health};
  for (const DoubleTable& table : double_tables()) {
    widths_.push_back(columns(info_.channels, table.group).size());
    if (widths_.back() > capacity[static_cast<std::size_t>(table.group)])
      throw FileError(path_ + ": table " + table.name + " has " + std::to_string(widths_.back()) +
                      " columns, allowed is at most " +
                      std::to_string(capacity[static_cast<std::size_t>(table.group)]));
    doubles_.push_back(widths_.back() == 0 ? Hdf5Object() : open_table(table.name, widths_.back()));
  }
}

bool FileReader::next(Row& row) {
  if (position_ == block_.size()) read_block();
  if (position_ == block_.size() || block_[position_].a.unit == 0) return false;
  row = block_[position_++];
  return true;
}

void FileReader::read_block() {
  const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(block_rows, total_rows_ - read_rows_));
  block_.assign(count, Row{});
  position_ = 0;
  if (count == 0) return;
  std::vector<Identity> identities(count);
  read_table(identities_, "A", H5T_NATIVE_INT64, count, identity_columns, identities.data());
  for (std::size_t k = 0; k < count; ++k) block_[k].a = identities[k];
  std::vector<double> values;
  for (std::size_t i = 0; i < doubles_.size(); ++i) {
    if (widths_[i] == 0) continue;
    const DoubleTable& table = double_tables()[i];
    values.resize(count * widths_[i]);
    read_table(doubles_[i], table.name, H5T_NATIVE_DOUBLE, count, widths_[i], values.data());
    for (std::size_t k = 0; k < count; ++k)
      std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(k * widths_[i]), widths_[i], table.values(block_[k]));
  }
  read_rows_ += count;
}

void FileReader::read_table(hid_t dataset, const char* name, hid_t type, std::size_t count, std::size_t width,
                            void* values) const {
  const std::string action = std::string("read table ") + name + " from row " + std::to_string(read_rows_);
  const std::array<hsize_t, 2> first{read_rows_, 0}, size{count, width};
  const Hdf5Object space(H5Dget_space(dataset), H5Sclose), memory(H5Screate_simple(2, size.data(), nullptr), H5Sclose);
  check(H5Sselect_hyperslab(space, H5S_SELECT_SET, first.data(), nullptr, size.data(), nullptr), path_, action);
  check(H5Dread(dataset, type, memory, space, H5P_DEFAULT, values), path_, action);
}

}  // namespace ehm::recording
