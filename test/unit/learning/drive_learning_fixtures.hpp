#pragma once

#include <cstdint>

#include "lstm_planner/agent/drive_policy.hpp"
#include "lstm_planner/learning/drive_course.hpp"
#include "lstm_planner/learning/initialisation.hpp"
#include "lstm_planner/network/layers.hpp"

namespace lstm_planner {

/// A training of the robot that takes a moment: `Parameters` are a learner's.
template <typename Parameters>
Parameters tinyTraining(int views = 1) {
  Parameters parameters;
  parameters.policy.encoder.views = views;
  parameters.course.worlds = {WorldKind::kOpen};
  parameters.iterations = 4;
  parameters.worlds = 2;
  parameters.goals = 1;
  parameters.starts = 4;
  parameters.max_steps = 60;
  parameters.threads = 1;
  return parameters;
}

template <typename Parameters>
LayerStack tinyNetwork(const Parameters& parameters, std::uint64_t seed) {
  LayerStack layers = makeLstmStack(static_cast<int>(parameters.policy.encoder.input_layout.size()), {4},
                                    networkOutputs(parameters.policy));
  initialise({}, seed, layers);
  return layers;
}

}  // namespace lstm_planner
