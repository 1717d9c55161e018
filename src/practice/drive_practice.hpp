#pragma once

#include <cstddef>
#include <vector>

#include "lstm_planner/drive/perception/encoder.hpp"
#include "lstm_planner/network/layers.hpp"
#include "lstm_planner/practice/drive_actor_critic.hpp"

namespace lstm_planner {

/// What the critic sees besides the policy's inputs: the path left in two forms, how much longer than the straight path
/// it is, and where it starts.
constexpr int kDrivePrivilegedInputs = 5;

/// A drive as it was practised, step by step.
struct PracticeEpisode {
  struct Step {
    int action = 0;
    bool chosen = false;  ///< the action was drawn and carried out; otherwise there was nothing to choose
    float reward = 0.0f;
    float weight = 1.0f;  ///< how much a recorded step counts
  };
  std::size_t kind = 0;  ///< of world
  std::vector<Step> steps;
  std::vector<float> inputs;           ///< the encoder's (of the view ahead), then the privileged ones, step by step
  std::vector<ViewBearings> bearings;  ///< step by step; empty with one view
  std::vector<float> probabilities;    ///< of the actions, 0 where the shield forbids one, step by step
  bool arrived = false;
  bool recorded = false;  ///< somebody's: the actions are to be learned, and nothing is known of rewards
};

/// All drives of iteration `iteration` (from 0) that had a step; the ranks share the worlds. The actions are drawn by
/// the network's preferences (softmax), among those that the shield allows. Throws std::runtime_error when there is
/// none.
std::vector<PracticeEpisode> practise(const DriveActorCriticParameters& parameters, const LayerStack& layers,
                                      int iteration);

/// Of some drives.
struct PracticeSums {
  double steps = 0.0;
  double reward = 0.0;   ///< mean a drive
  double arrival = 0.0;  ///< share of the drives
};
PracticeSums sumUp(const std::vector<PracticeEpisode>& episodes);

}  // namespace lstm_planner
