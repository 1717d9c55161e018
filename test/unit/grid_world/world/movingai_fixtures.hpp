#pragma once

#include <fstream>
#include <sstream>
#include <string>

#include "lstm_planner/grid_world/world/movingai.hpp"
#include "support/folder_test.hpp"
#include "support/refusal.hpp"

namespace lstm_planner {

/// Tests of files, each in a folder of its own that is removed afterwards.
class MovingAiFiles : public test::FolderTest {
 protected:
  std::string write(const std::string& name, const std::string& content) const { return scratch_.write(name, content); }

  static std::string contentOf(const std::string& path) {
    std::ostringstream content;
    content << std::ifstream(path, std::ios::binary).rdbuf();
    return content.str();
  }

  /// What a call says about a file that it refuses, without the file's path; empty when it does not refuse.
  template <typename Call>
  std::string refusal(const Call& call) const {
    std::string message = test::refusalOf<MovingAiFileError>(call);
    for (std::size_t at; (at = message.find(folder_)) != std::string::npos;) {
      message.erase(at, folder_.size());
      if (message.compare(at, 1, "/") == 0) message.erase(at, 1);
    }
    return message;
  }
};

}  // namespace lstm_planner
