#pragma once

#include <cstddef>
#include <vector>

#include "lstm_planner/drive/perception/encoder.hpp"

namespace lstm_planner {

/// What the critic sees besides the policy's inputs: the path left in two forms, how much longer than the straight path
/// it is, and where it starts.
constexpr int kDrivePrivilegedInputs = 5;

/// A drive to learn from, step by step. In practice the actions are drawn, and rewards tell which were good. An example
/// tells the right actions themselves.
struct PracticeEpisode {
  struct Step {
    int action = 0;
    bool chosen = false;  ///< the action was drawn and carried out, or is the right one; otherwise nothing is learned
    float reward = 0.0f;
    float weight = 1.0f;  ///< how much a step of an example counts
  };
  std::size_t kind = 0;  ///< of world
  std::vector<Step> steps;
  std::vector<float> inputs;           ///< the encoder's (of the view ahead), then the privileged ones, step by step
  std::vector<ViewBearings> bearings;  ///< step by step; empty with one view
  std::vector<float> probabilities;    ///< of the actions, 0 where one is not allowed, step by step
  bool arrived = false;
  bool is_example = false;
};

/// Adds a step with these inputs of the network. Returns the privileged ones, which are 0: valid until the next step.
float* addStep(const Encoder& encoder, const Observation& observation, PracticeEpisode* episode);

/// Of some drives.
struct PracticeSums {
  double steps = 0.0;    ///< examples included
  double reward = 0.0;   ///< mean a drive, without examples
  double arrival = 0.0;  ///< share of the drives, without examples
};
PracticeSums sumUp(const std::vector<PracticeEpisode>& episodes);

}  // namespace lstm_planner
