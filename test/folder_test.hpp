#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <string>
#include <system_error>

namespace lstm_planner::test {

/// A folder of its own for each test, removed with all that is in it.
class FolderTest : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = ::testing::TempDir() + "lstm_planner_XXXXXX";
    ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
  }
  void TearDown() override {
    std::error_code unknown;
    if (!folder_.empty()) std::filesystem::remove_all(folder_, unknown);
  }

  std::string in(const std::string& name) const { return folder_ + "/" + name; }

  std::string folder_;
};

}  // namespace lstm_planner::test
