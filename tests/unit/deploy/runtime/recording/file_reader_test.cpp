// SPDX-License-Identifier: Apache-2.0
// Files that are no recordings are refused with their name and the reason, never read as something else.

#include "deploy/runtime/recording/file_reader.h"

#include <gmock/gmock.h>

#include "deploy/runtime/files/file_error.h"
#include "tests/temporary_folder.h"
#include "tests/unit/deploy/runtime/config/config_file.h"
#include "tests/unit/deploy/runtime/recording/example_rows.h"

namespace {

using namespace ehm;
using namespace ehm::recording;
using testing::HasSubstr;

std::string error_of(const std::string& path) {
  return test::message_of<files::FileError>([&] {
    FileReader reader(path);
    for (Row row; reader.next(row);) {
    }
  });
}

class FileReaderTest : public testing::Test {
 protected:
  std::string good() {
    const std::string path = folder_.path("good.h5");
    Writer writer(path, test::example_info());
    for (std::int64_t k = 0; k < 1000; ++k) writer.append(test::example_row(k), 0);
    writer.commit(true);
    return path;
  }
  test::TemporaryFolder folder_;
};

TEST_F(FileReaderTest, NamesWhatIsNoRecording) {
  EXPECT_THAT(error_of(folder_.path("none.h5")), HasSubstr("none.h5: no such file"));
  EXPECT_THAT(error_of(folder_.path()), HasSubstr("is a folder, needed is a regular file, a recording"));
  EXPECT_THAT(error_of(folder_.file("text.h5", "engine,cycle\n")),
              HasSubstr("text.h5: cannot read this as a recording"));
  EXPECT_THAT(error_of(folder_.file("empty.h5", "")), HasSubstr("empty.h5: cannot read this as a recording"));
  const std::string other = folder_.path("other.h5");
  { const Hdf5Object file(H5Fcreate(other.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose); }
  EXPECT_THAT(error_of(other), HasSubstr("other.h5: is an HDF5 file, but no recording: attribute 'format' is missing"));
}

TEST_F(FileReaderTest, RefusesAnotherFormatVersion) {
  const std::string path = good();
  {
    const Hdf5Object file(H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
    const Hdf5Object attribute(H5Aopen(file, "format_version", H5P_DEFAULT), H5Aclose);
    const std::int64_t version = 2;
    H5Awrite(attribute, H5T_NATIVE_INT64, &version);
  }
  EXPECT_THAT(error_of(path), HasSubstr("good.h5: attribute 'format_version' is 2, allowed is 1"));
}

TEST_F(FileReaderTest, ATruncatedFileIsAnErrorAtAnyLength) {
  const std::string whole = [&] {
    good();
    return folder_.content("good.h5");
  }();
  for (std::size_t length = 0; length < whole.size(); length += whole.size() / 40)
    EXPECT_THAT(error_of(folder_.file("cut.h5", whole.substr(0, length))), HasSubstr("cut.h5: ")) << length;
  EXPECT_EQ(error_of(folder_.file("cut.h5", whole)), "");
}

TEST_F(FileReaderTest, DamagedBytesNeverCrash) {
  good();
  const std::string whole = folder_.content("good.h5");
  int refused = 0;
  for (std::size_t at = 0; at < whole.size(); at += 97) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(~damaged[at]);
    refused += error_of(folder_.file("damaged.h5", damaged)).empty() ? 0 : 1;
  }
  EXPECT_GT(refused, 0);  // bytes that hold no data may change unnoticed
}

}  // namespace
