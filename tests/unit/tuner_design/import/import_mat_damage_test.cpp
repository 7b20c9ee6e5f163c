// SPDX-License-Identifier: Apache-2.0
// MATLAB files that are not what they seem: cut off, altered, of another version, ambiguous.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/unit/tuner_design/import/least_mat.h"

namespace ehm::tuner_design {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;

TEST(ImportMat, TwoStructuresAreAmbiguous) {
  {
    MatWriter first(mat_path());
    first.begin_structure("idle");
    write_least(first);
  }
  mat_t* file = Mat_Open(mat_path().c_str(), MAT_ACC_RDWR);
  matvar_t* cruise = Mat_VarRead(file, "idle");
  cruise->name[0] = 'I';
  Mat_VarWrite(file, cruise, MAT_COMPRESSION_NONE);
  Mat_VarFree(cruise);
  Mat_Close(file);
  EXPECT_EQ(message([] { import_model(mat_path(), {}); }),
            ": the structures idle, Idle have a field A; allowed: one model in a file. Save one.");
}

void overwrite(const std::string& content) {
  std::ofstream(mat_path(), std::ios::binary) << content;
}

std::string content() {
  std::ostringstream text;
  text << std::ifstream(mat_path(), std::ios::binary).rdbuf();
  return text.str();
}

TEST(ImportMat, AFileThatEndsAnywhereIsRefused) {
  import(write_least);
  const std::string whole = content();
  int boundaries = 0;
  for (std::size_t size = 0; size < whole.size(); size += 4) {
    overwrite(whole.substr(0, size));
    const std::string text = message([] { import_model(mat_path(), {}); });
    EXPECT_NE(text, "accepted") << size;
    if (text.find("cut off") == std::string::npos && size > 128) ++boundaries;
  }
  EXPECT_EQ(boundaries, 4) << "the four ends of A, L, C, M; what is missing then is named";
}

/// Sizes and types of every element are at its first eight bytes: each byte of the file once with each value.
TEST(ImportMat, AnAlteredFileIsReadOrRefused) {
  import([](MatWriter& mat) {
    write_least(mat);
  mat.cells("sensor_names", {"T3", "speed"});
  mat.sparse("Q", Eigen::MatrixXd::Ones(1, 1));
});
const std::string whole = content();
int accepted = 0, refused = 0;
for (std::size_t at = 128; at < whole.size(); ++at) {
  for (const char value : {'\x00', '\x05', '\x0e', '\x7f', '\xff'}) {
    std::string altered = whole;
    altered[at] = value;
    overwrite(altered);
    ++(message([] { import_model(mat_path(), {}); }) == "accepted" ? accepted : refused);
  }
}
EXPECT_GT(refused, 1000);
EXPECT_GT(accepted, 100) << "a digit of a number, or nothing, may have changed";
}  // namespace

TEST(ImportMat, ACompressedFileIsProtectedByItsChecksum) {
  import(write_least);
  test::compress(mat_path());
  std::string whole = content();
  whole[whole.size() - 5] = static_cast<char>(whole[whole.size() - 5] ^ 1);
  overwrite(whole);
  EXPECT_THAT(message([] { import_model(mat_path(), {}); }), HasSubstr("is damaged or cut off in what begins at byte"));
}

TEST(ImportMat, OtherVersionsAreRefusedWithTheRemedy) {
  for (const auto& [version, what] :
       {std::pair(MAT_FT_MAT73, "a MATLAB v7.3 (HDF5) file"), std::pair(MAT_FT_MAT4, "no MATLAB v5 file")}) {
    {
      MatWriter mat(mat_path(), version);
      write_least(mat);
    }
    EXPECT_EQ(message([] { import_model(mat_path(), {}); }),
              ": is " + std::string(what) +
                  "; allowed: what save writes with -v6 or -v7. Save it again: save('engine.mat', 'A', ..., '-v7').");
  }
  overwrite("# Created by Octave 7.3.0\n");
  EXPECT_THAT(message([] { import_model(mat_path(), {}); }), HasSubstr("'-v7'"));
  std::filesystem::remove(mat_path());
  EXPECT_THAT(message([] { import_model(mat_path(), {}); }), EndsWith(": no such file. Check the path."));
}

}  // namespace ehm::tuner_design
}  // namespace ehm::tuner_design
