#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "lstm_planner/drive/collision/shield.hpp"
#include "lstm_planner/drive/decision/action_set.hpp"
#include "lstm_planner/drive/decision/agent_parameters.hpp"

namespace lstm_planner {

/// One of the steering angles.
struct ChosenAction {
  int index = 0;
  double free = 0.0;  ///< m that the shield sees free that way, no more than a step
};

/// The preferred one of the steering angles that the shield allows with the wanted clearance. If it allows none of
/// them, of those that it allows with the tight clearance. `actions` are relative to the heading `step_yaw` (rad) of a
/// robot whose heading is `yaw` now and whose surroundings `shield` shows. `imposed` is taken in place of the preferred
/// one if it is allowed. Writes to `allowed`, one an action, what the shield says. None where it allows none.
std::optional<ChosenAction> chooseAction(const AgentParameters& parameters, const ActionSet& actions, double step_yaw,
                                         double yaw, const Shield& shield, const std::vector<float>& preferences,
                                         std::optional<int> imposed, std::vector<char>* allowed);

/// One preference for each action: the nearer it is to `bearing` (rad, relative to the heading), the higher.
void preferBearing(const ActionSet& actions, double bearing, std::vector<float>* preferences);

/// Draws an action with the probabilities that the preferences mean (softmax). The same for the same seed.
int drawAction(const std::vector<float>& preferences, std::uint64_t seed);

}  // namespace lstm_planner
