#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "lstm_planner/network/instruction_set.hpp"

namespace lstm_planner::test {

/// Names the cases of a suite for each instruction set; a name must have letters and digits only.
inline std::string instructionSetName(const ::testing::TestParamInfo<InstructionSet>& info) {
  std::string name = toString(info.param);
  name.erase(std::remove(name.begin(), name.end(), '-'), name.end());
  return name;
}

}  // namespace lstm_planner::test
