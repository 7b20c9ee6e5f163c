// SPDX-License-Identifier: Apache-2.0
// How fast a recording is written, and how large it becomes: the rows of a real recording, as those of 1, 10 and 50
// engines that take turns. Usage: record_bench RECORDING

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <iostream>

#include "deploy/runtime/recording/recording_rows.h"
#include "deploy/runtime/recording/writer.h"

namespace {

using namespace ehm::recording;
using Seconds = std::chrono::duration<double>;

constexpr std::size_t total_rows = 40'000;
constexpr std::size_t commit_rows = 16 * Writer::chunk_rows;  // as the recorder does

std::vector<Row> read_samples(const std::string& file, FileInfo& info) {
  RecordingRows rows(file);
  info = rows.info();
  std::vector<Row> all;
  for (Row row; rows.next(row) && all.size() < total_rows;)
    if (row.kind() == RowKind::sample) all.push_back(row);
  return all;
}

void measure(const std::vector<Row>& samples, const FileInfo& info, std::size_t engines, const std::string& path) {
  const auto start = std::chrono::steady_clock::now();
  Writer writer(path, info);
  for (std::size_t k = 0; k < total_rows; ++k) {
    const std::size_t engine = k % engines;
    Row row = samples[(k / engines + engine * samples.size() / engines) % samples.size()];  // its own noise
    row.a.unit = static_cast<std::int64_t>(1 + engine);
    writer.append(row, 0);
    if (writer.pending() >= commit_rows) writer.commit(false);
  }
  writer.commit(true);
  const double elapsed_s = Seconds(std::chrono::steady_clock::now() - start).count();
  const double bytes_per_row = static_cast<double>(writer.bytes()) / static_cast<double>(total_rows);
  const double needed = static_cast<double>(engines) / info.sample_time_s;
  std::printf(
      "%3zu engines: %8.0f rows/s written, %6.0f needed at %.0f ms (%.1f times), %5.0f bytes a row, %6.0f MB/h\n",
      engines, total_rows / elapsed_s, needed, 1e3 * info.sample_time_s, total_rows / elapsed_s / needed, bytes_per_row,
      1e-6 * bytes_per_row * needed * 3600.0);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: record_bench RECORDING\n";
    return 2;
  }
  try {
    FileInfo info;
    const std::vector<Row> samples = read_samples(argv[1], info);
    if (samples.empty()) throw std::runtime_error(std::string(argv[1]) + " has no samples");
    const std::string path = std::filesystem::temp_directory_path() / "ehm_record_bench.h5";
    for (const std::size_t engines : {1, 10, 50}) {
      std::filesystem::remove(path);
      measure(samples, info, engines, path);
    }
    std::filesystem::remove(path);
    return 0;
  } catch (const std::exception& e) {
    std::cerr << "record_bench: " << e.what() << '\n';
    return 1;
  }
}
