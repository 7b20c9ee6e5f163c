// SPDX-License-Identifier: Apache-2.0
#pragma once
// A configuration file for one test, removed at its end.

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <string>

namespace ehm::test {

class ConfigFile {
 public:
  explicit ConfigFile(const std::string& text) {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    path_ = testing::TempDir() + info->test_suite_name() + "." + info->name() + ".toml";
    std::ofstream(path_) << text;
  }
  ~ConfigFile() { std::remove(path_.c_str()); }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// The message of the exception that `action` throws; empty if it throws none.
template <class Exception, class Action>
std::string message_of(Action action) {
  try {
    action();
  } catch (const Exception& e) {
    return e.what();
  }
  return {};
}

}  // namespace ehm::test
