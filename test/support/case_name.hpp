#pragma once

#include <gtest/gtest.h>

#include <string>

namespace lstm_planner::test {

/// Names the cases of a parameterised suite after their numbers: caseName("Seed") gives Seed1, Seed2.
inline auto caseName(const std::string& what) {
  return [what](const auto& info) { return what + std::to_string(info.param); };
}

}  // namespace lstm_planner::test
