// SPDX-License-Identifier: Apache-2.0
// What a path may lead to, and what is said of the rest.

#include "deploy/runtime/files/input_file.h"

#include <gmock/gmock.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <chrono>
#include <cstring>
#include <filesystem>

#include "deploy/runtime/files/file_error.h"
#include "tests/temporary_folder.h"

namespace ehm::files {
namespace {

using testing::EndsWith;
using testing::HasSubstr;

constexpr InputKind small{"a small file", 10};

class InputFile : public testing::Test {
 protected:
  /// What is wrong with it, found at once.
  static std::string error_of(const std::string& path, const InputKind& kind = json_file) {
    const auto begin = std::chrono::steady_clock::now();
    std::string error;
    try {
      read_input_file(path, kind);
    } catch (const FileError& e) {
      error = e.what();
    }
    EXPECT_LT(std::chrono::steady_clock::now() - begin, patience) << path;
    return error;
  }
  test::TemporaryFolder folder_;
};

TEST_F(InputFile, GivesAllBytesOfARegularFileAlsoThroughALink) {
  const std::string text("a\0b\n", 4);
  const std::string file = folder_.file("file", text), link = folder_.path("link");
  std::filesystem::create_symlink(file, link);
  EXPECT_EQ(read_input_file(file, small), text);
  EXPECT_EQ(read_input_file(link, small), text);
  EXPECT_EQ(read_input_file(folder_.file("empty", ""), small), "");
  EXPECT_EQ(read_input_file(folder_.file("ten", "0123456789"), small), "0123456789");
}

TEST_F(InputFile, RefusesWhatIsNoFileWithoutWaiting) {
  const std::string pipe = folder_.path("pipe");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THAT(error_of(pipe), EndsWith("pipe: is a pipe, needed is a regular file, a JSON file."));
  EXPECT_THAT(error_of("/dev/zero"), EndsWith("/dev/zero: is a device, needed is a regular file, a JSON file."));
  EXPECT_THAT(error_of("/dev/stdin"), HasSubstr("/dev/stdin: "));
  EXPECT_THAT(error_of(folder_.path()), HasSubstr("is a folder"));
  const int listening = socket(AF_UNIX, SOCK_STREAM, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::string name = folder_.path("socket");
  ASSERT_LT(name.size(), sizeof address.sun_path);
  std::strcpy(address.sun_path, name.c_str());
  ASSERT_EQ(bind(listening, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
  EXPECT_THAT(error_of(name), HasSubstr("is a socket"));
  close(listening);
  for (const std::string& path : {pipe, std::string("/dev/zero"), name, folder_.path("none")})
    EXPECT_THROW(require_input_file(path, json_file), FileError) << path;
}

TEST_F(InputFile, RefusesWhatIsTooLargeAndWhatIsNotThere) {
  EXPECT_THAT(error_of(folder_.file("large", "01234567890"), small),
              EndsWith("large: has 11 bytes, a small file has at most 10. Is it the right file?"));
  EXPECT_THAT(error_of(folder_.path("none")), EndsWith("none: no such file. Check the path."));
  EXPECT_THAT(error_of(folder_.file("file", "") + "/below"), EndsWith("below: no such file. Check the path."));
  // Its size says 0, its content is long: as a file that grows.
  EXPECT_THAT(error_of("/proc/self/maps", small), HasSubstr("has more than 10 bytes"));
}

}  // namespace
}  // namespace ehm::files
