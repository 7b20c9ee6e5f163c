// SPDX-License-Identifier: Apache-2.0
#include "deploy/runtime/recording/writer.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace ehm::recording {

namespace {

Hdf5Object text_type(std::size_t size = text_size) {
  const hid_t type = H5Tcopy(H5T_C_S1);
  H5Tset_size(type, size);
  H5Tset_strpad(type, H5T_STR_NULLPAD);
  return {type, H5Tclose};
}

using Text = std::array<char, text_size>;

Text padded(const std::string& text) {
  Text bytes{};
  std::memcpy(bytes.data(), text.data(), std::min(text.size(), text_size));
  return bytes;
}

}  // namespace

Writer::Writer(const std::string& path, const FileInfo& info) : path_(path), channels_(info.channels) {
  prepare_hdf5();
  const Hdf5Object access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  // The single-writer mode needs the file format of HDF5 1.10.
  check(H5Pset_libver_bounds(access, H5F_LIBVER_V110, H5F_LIBVER_V110), path_, "choose the file format");
  file_ = own(H5Fcreate(path_.c_str(), H5F_ACC_EXCL, H5P_DEFAULT, access), H5Fclose, path_, "create the recording");
  write_attributes(info);
  create_tables();
  check(H5Fstart_swmr_write(file_), path_, "enter the single-writer mode");
}

Writer::~Writer() {
  try {
    commit(true);
  } catch (const std::exception&) {
    // whoever wants to know commits before
  }
}

void Writer::write_attributes(const FileInfo& info) {
  const Hdf5Object scalar(H5Screate(H5S_SCALAR), H5Sclose);
  const auto write = [&](const char* name, hid_t type, const void* value) {
    const auto attribute =
        own(H5Acreate2(file_, name, type, scalar, H5P_DEFAULT, H5P_DEFAULT), H5Aclose, path_, "create an attribute");
    check(H5Awrite(attribute, type, value), path_, "write an attribute");
  };
  const Hdf5Object text = text_type();
  write("format", text, padded(format_name).data());
  write("format_version", H5T_NATIVE_INT64, &format_version);
  write("recording_id", H5T_NATIVE_INT64, &info.recording_id);
  write("part", H5T_NATIVE_INT64, &info.part);
  write("monitor_source_id", H5T_NATIVE_INT64, &info.monitor_source_id);
  write("sample_time_s", H5T_NATIVE_DOUBLE, &info.sample_time_s);
  write("created_by", text, padded(info.created_by).data());
  if (!info.published.empty()) write("published", text, padded(info.published).data());
  if (!info.shadows.empty()) write("shadows", text_type(info.shadows.size()), info.shadows.data());  // all of them
}

void Writer::create_tables() {
  for (const DoubleTable& table : double_tables()) {
    const auto channels = columns(channels_, table.group);
    doubles_.push_back(create_table(table.name, channels.size(), H5T_NATIVE_DOUBLE, &no_value));
    const std::string name = table.name;
    if (name == "W" || name == "X_s" || name == "X_v" || name == "T") write_names(name, channels);
  }
  constexpr std::int64_t never_written = 0;
  identities_ = create_table("A", identity_columns, H5T_NATIVE_INT64, &never_written);
  write_names("A", {identity_channels().begin(), identity_channels().end()});

  constexpr std::array<hsize_t, 1> none{0}, unlimited{H5S_UNLIMITED}, chunk{16};
  const Hdf5Object space(H5Screate_simple(1, none.data(), unlimited.data()), H5Sclose);
  const Hdf5Object create(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  check(H5Pset_chunk(create, 1, chunk.data()), path_, "set the chunks of design_hash");
  design_hashes_ = own(H5Dcreate2(file_, "design_hash", text_type(), space, H5P_DEFAULT, create, H5P_DEFAULT), H5Dclose,
                       path_, "create design_hash");
}

Writer::Table Writer::create_table(const char* name, std::size_t width, hid_t type, const void* fill) {
  if (width == 0) return {};
  const std::string action = std::string("create table ") + name;
  const std::array<hsize_t, 2> none{0, width}, unlimited{H5S_UNLIMITED, width}, chunk{chunk_rows, width};
  const Hdf5Object space(H5Screate_simple(2, none.data(), unlimited.data()), H5Sclose);
  const Hdf5Object create(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  check(H5Pset_chunk(create, 2, chunk.data()), path_, action);
  check(H5Pset_shuffle(create), path_, action);
  check(H5Pset_deflate(create, compression), path_, action);
  check(H5Pset_fill_value(create, type, fill), path_, action);
  return {own(H5Dcreate2(file_, name, type, space, H5P_DEFAULT, create, H5P_DEFAULT), H5Dclose, path_, action), width};
}

void Writer::write_names(const std::string& name, const std::vector<Channel>& channels) {
  if (channels.empty()) return;
  const hsize_t count = channels.size();
  const Hdf5Object space(H5Screate_simple(1, &count, nullptr), H5Sclose), type = text_type();
  const auto write = [&](const std::string& dataset_name, auto text_of) {
    std::vector<Text> texts;
    for (const Channel& channel : channels) texts.push_back(padded(text_of(channel)));
    const std::string action = "write " + dataset_name;
    const auto dataset =
        own(H5Dcreate2(file_, dataset_name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Dclose,
            path_, action);
    check(H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, texts.data()), path_, action);
  };
  write(name + "_var", [](const Channel& c) { return c.name; });
  write(name + "_unit", [](const Channel& c) { return c.unit; });
}

std::int64_t Writer::design_index(const std::string& hash) {
  const auto known = std::find(hashes_.begin(), hashes_.end(), hash);
  if (known != hashes_.end()) return known - hashes_.begin();
  const hsize_t count = hashes_.size() + 1, first = hashes_.size(), one = 1;
  check(H5Dset_extent(design_hashes_, &count), path_, "extend design_hash");
  const Hdf5Object space(H5Dget_space(design_hashes_), H5Sclose), memory(H5Screate_simple(1, &one, nullptr), H5Sclose);
  check(H5Sselect_hyperslab(space, H5S_SELECT_SET, &first, nullptr, &one, nullptr), path_, "extend design_hash");
  check(H5Dwrite(design_hashes_, text_type(), memory, space, H5P_DEFAULT, padded(hash).data()), path_,
        "write design_hash");
  hashes_.push_back(hash);
  return static_cast<std::int64_t>(hashes_.size()) - 1;
}

void Writer::commit(bool all) {
  const std::size_t in_chunk = rows_ % chunk_rows;
  const std::size_t full = (in_chunk + pending_.size()) / chunk_rows * chunk_rows;
  const std::size_t count = all ? pending_.size() : full > in_chunk ? full - in_chunk : 0;
  if (count == 0) return;
  write_doubles(count);
  flush();
  write_identities(count);
  flush();
  pending_.erase(pending_.begin(), pending_.begin() + static_cast<std::ptrdiff_t>(count));
  rows_ += count;
}

void Writer::write_doubles(std::size_t count) {
  for (std::size_t i = 0; i < doubles_.size(); ++i) {
    const DoubleTable& table = double_tables()[i];
    const std::size_t width = doubles_[i].width;
    if (width == 0) continue;
    block_.resize(count * width);
    for (std::size_t k = 0; k < count; ++k)
      std::copy_n(table.values(pending_[k]), width, block_.begin() + static_cast<std::ptrdiff_t>(k * width));
    write_block(doubles_[i], table.name, H5T_NATIVE_DOUBLE, count, block_.data());
  }
}

void Writer::write_identities(std::size_t count) {
  std::vector<Identity> block(count);
  std::transform(pending_.begin(), pending_.begin() + static_cast<std::ptrdiff_t>(count), block.begin(),
                 [](const Row& row) { return row.a; });
  write_block(identities_, "A", H5T_NATIVE_INT64, count, block.data());
}

void Writer::write_block(const Table& table, const char* name, hid_t type, std::size_t count, const void* values) {
  const std::string action = std::string("write table ") + name;
  const std::array<hsize_t, 2> extent{rows_ + count, table.width}, first{rows_, 0}, size{count, table.width};
  check(H5Dset_extent(table.dataset, extent.data()), path_, action);
  const Hdf5Object space(H5Dget_space(table.dataset), H5Sclose);
  const Hdf5Object memory(H5Screate_simple(2, size.data(), nullptr), H5Sclose);
  check(H5Sselect_hyperslab(space, H5S_SELECT_SET, first.data(), nullptr, size.data(), nullptr), path_, action);
  check(H5Dwrite(table.dataset, type, memory, space, H5P_DEFAULT, values), path_, action);
}

void Writer::flush() {
  check(H5Fflush(file_, H5F_SCOPE_LOCAL), path_, "flush");
}

std::uint64_t Writer::bytes() const {
  hsize_t size = 0;
  check(H5Fget_filesize(file_, &size), path_, "tell the size");
  return size;
}

}  // namespace ehm::recording
