#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lstm_planner/learning/drive_actor_critic.hpp"
#include "lstm_planner/network/layers.hpp"
#include "lstm_planner/perception/encoder.hpp"

namespace lstm_planner {

/// What the critic sees besides the policy's inputs: the way left in two forms, how much longer than the straight way
/// it is, and where it begins.
constexpr int kDrivePrivilegedInputs = 5;

/// A drive as it was practised, step by step.
struct PracticeEpisode {
  struct Step {
    int action = 0;
    bool chosen = false;  ///< the policy chose the action; otherwise there was nothing to choose
    float reward = 0.0f;
  };
  std::size_t kind = 0;  ///< of world
  std::vector<Step> steps;
  std::vector<float> inputs;         ///< the encoder's (of the view ahead), then the privileged ones, step by step
  std::vector<ViewBearings> bearings;  ///< step by step; empty with one view
  std::vector<float> probabilities;  ///< of the actions, 0 where the shield forbids one, step by step
  bool arrived = false;
};

/// Drives once, drawing each action by the policy's probabilities among those that the shield allows.
PracticeEpisode practise(const DriveActorCriticParameters& parameters, const LayerStack& layers,
                         const DriveExercise& exercise, const DriveTask& task, std::uint64_t seed);

}  // namespace lstm_planner
