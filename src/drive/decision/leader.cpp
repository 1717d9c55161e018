#include "lstm_planner/drive/decision/leader.hpp"

#include <stdexcept>

namespace lstm_planner {

const char* toString(Leader leader) {
  switch (leader) {
    case Leader::kNetwork:
      return "network";
    case Leader::kGreedy:
      return "greedy";
    case Leader::kRoute:
      return "route";
    case Leader::kEscape:
      return "escape";
  }
  return "unknown";
}

std::string nameOfLeader(Leader leader) { return leader == Leader::kGreedy ? "none" : toString(leader); }

Leader leaderNamed(const std::string& name) {
  for (const Leader leader : {Leader::kNetwork, Leader::kRoute, Leader::kGreedy}) {
    if (name == nameOfLeader(leader)) return leader;
  }
  throw std::invalid_argument("leader is '" + name + "', expected network, route or none");
}

}  // namespace lstm_planner
