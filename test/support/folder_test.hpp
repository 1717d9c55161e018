#pragma once

#include <gtest/gtest.h>

#include <string>

#include "support/scratch_folder.hpp"

namespace lstm_planner::test {

/// A folder of its own for each test, removed with all that is in it.
class FolderTest : public ::testing::Test {
 protected:
  std::string in(const std::string& name) const { return scratch_ / name; }

  const ScratchFolder scratch_;
  const std::string folder_ = scratch_.path().string();
};

}  // namespace lstm_planner::test
