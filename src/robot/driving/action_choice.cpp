#include "lstm_planner/robot/driving/action_choice.hpp"

#include <cmath>

namespace lstm_planner {

std::optional<ActionChoice::Action> ActionChoice::choose(const ActionSet& actions, double step_yaw, double yaw,
                                                         const Shield& shield, const std::vector<float>& preferences,
                                                         std::optional<int> imposed, std::vector<char>* allowed) const {
  for (const double clearance : {shield_parameters_.clearance, shield_parameters_.tight_clearance}) {
    std::optional<Action> best;
    for (int action = 0; action < actions.size(); ++action) {
      const auto i = static_cast<std::size_t>(action);
      const double direction = step_yaw + actions.angle(action) - yaw;
      const double free = shield_enabled_ ? shield.freeDistance({}, direction, step_length_, clearance) : step_length_;
      (*allowed)[i] = free >= shield_parameters_.shortest_step;
      const bool preferred =
          !best || imposed == action ||
          (imposed != best->index && preferences[i] > preferences[static_cast<std::size_t>(best->index)]);
      if ((*allowed)[i] && preferred) best = Action{action, free};
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

}  // namespace lstm_planner
