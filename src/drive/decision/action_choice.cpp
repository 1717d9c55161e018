#include "lstm_planner/drive/decision/action_choice.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "lstm_planner/common/random.hpp"

namespace lstm_planner {

std::optional<ChosenAction> chooseAction(const AgentParameters& parameters, const ActionSet& actions, double step_yaw,
                                         double yaw, const Shield& shield, const std::vector<float>& preferences,
                                         std::optional<int> imposed, std::vector<char>* allowed) {
  const double step = parameters.step.length;
  for (const double clearance : {parameters.shield.clearance, parameters.shield.tight_clearance}) {
    std::optional<ChosenAction> best;
    for (int action = 0; action < actions.size(); ++action) {
      const auto i = static_cast<std::size_t>(action);
      const double direction = step_yaw + actions.angle(action) - yaw;
      const double free = parameters.shield_enabled ? shield.freeDistance({}, direction, step, clearance) : step;
      (*allowed)[i] = free >= parameters.shield.shortest_step;
      const bool preferred =
          !best || imposed == action ||
          (imposed != best->index && preferences[i] > preferences[static_cast<std::size_t>(best->index)]);
      if ((*allowed)[i] && preferred) best = ChosenAction{action, free};
    }
    if (best) return best;
  }
  return std::nullopt;
}

void preferBearing(const ActionSet& actions, double bearing, std::vector<float>* preferences) {
  for (int action = 0; action < actions.size(); ++action) {
    const double off = std::abs(normalizeAngle(actions.angle(action) - bearing));
    (*preferences)[static_cast<std::size_t>(action)] = static_cast<float>(-off);
  }
}

int drawAction(const std::vector<float>& preferences, std::uint64_t seed) {
  Random random(seed);
  // The largest sum of a preference and a number of Gumbel's distribution is that of an action drawn by softmax.
  std::pair<double, int> largest{-std::numeric_limits<double>::infinity(), 0};
  for (std::size_t i = 0; i < preferences.size(); ++i) {
    const double sum = static_cast<double>(preferences[i]) - std::log(-std::log(uniform(random)));
    largest = std::max(largest, std::pair<double, int>(sum, static_cast<int>(i)));
  }
  return largest.second;
}

}  // namespace lstm_planner
