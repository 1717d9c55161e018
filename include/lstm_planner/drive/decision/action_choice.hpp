#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "lstm_planner/drive/collision/shield.hpp"
#include "lstm_planner/drive/decision/action_set.hpp"
#include "lstm_planner/drive/decision/agent_parameters.hpp"

namespace lstm_planner {

/// Chooses one of the steering angles: the preferred one of those that the shield allows with the wanted clearance. If
/// it allows none of them, of those that it allows with the tight clearance.
class ActionChoice {
 public:
  /// One of the steering angles.
  struct Action {
    int index = 0;
    double free = 0.0;  ///< m that the shield sees free that way, no more than a step
  };

  explicit ActionChoice(const AgentParameters& parameters)
      : shield_parameters_(parameters.shield),
        shield_enabled_(parameters.shield_enabled),
        step_length_(parameters.step.length) {}

  /// Chooses among `actions`, which are relative to the heading `step_yaw` (rad), for a robot whose heading is `yaw`
  /// now and whose surroundings `shield` shows. `imposed` is taken in place of the preferred one if it is allowed.
  /// Writes to `allowed`, one an action, what the shield says. Nothing where it allows none.
  std::optional<Action> choose(const ActionSet& actions, double step_yaw, double yaw, const Shield& shield,
                               const std::vector<float>& preferences, std::optional<int> imposed,
                               std::vector<char>* allowed) const;

 private:
  ShieldParameters shield_parameters_;
  bool shield_enabled_;
  double step_length_;  ///< m
};

/// One preference for each action: the nearer it is to `bearing` (rad, relative to the heading), the higher.
void preferBearing(const ActionSet& actions, double bearing, std::vector<float>* preferences);

/// Draws an action with the probabilities that the preferences mean (softmax). The same for the same seed.
int drawAction(const std::vector<float>& preferences, std::uint64_t seed);

}  // namespace lstm_planner
