#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "lstm_planner/grid_world/world/movingai.hpp"

namespace lstm_planner {

/// Tests of files, each in a folder of its own that is removed afterwards.
class MovingAiFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = ::testing::TempDir() + "movingai_XXXXXX";
    ASSERT_NE(mkdtemp(&pattern[0]), nullptr);
    folder_ = pattern + "/";
  }

  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string write(const std::string& name, const std::string& content) const {
    std::filesystem::create_directories(std::filesystem::path(folder_ + name).parent_path());
    // A file that is truncated and written again is flushed to the disk by ext4, a new one is not.
    std::filesystem::remove(folder_ + name);
    std::ofstream(folder_ + name, std::ios::binary) << content;
    return folder_ + name;
  }

  static std::string contentOf(const std::string& path) {
    std::ostringstream content;
    content << std::ifstream(path, std::ios::binary).rdbuf();
    return content.str();
  }

  /// What a call says about a file that it refuses, without the file's path; empty when it does not refuse.
  template <typename Call>
  std::string refusal(const Call& call) const {
    try {
      call();
    } catch (const MovingAiFileError& error) {
      std::string message = error.what();
      for (std::size_t at = message.find(folder_); at != std::string::npos; at = message.find(folder_)) {
        message.erase(at, folder_.size());
      }
      return message;
    }
    return "";
  }

  std::string folder_;
};

}  // namespace lstm_planner
