#include "fuzz/harness.hpp"

namespace lstm_planner::fuzz {

std::map<std::string, Harness>& harnesses() {
  static std::map<std::string, Harness> all;
  return all;
}

}  // namespace lstm_planner::fuzz
