#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "lstm_planner/drive/decision/drive_policy.hpp"
#include "lstm_planner/network/layers.hpp"
#include "lstm_planner/practice/drive_course.hpp"
#include "lstm_planner/training/initialisation.hpp"
#include "lstm_planner/training/parameter_vector.hpp"
#include "unit/training/thread_ranks.hpp"

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

/// `make`: a learner from parameters and a network. `reported`: the numbers of its report, as a vector.
template <typename Parameters, typename Make, typename Reported>
void expectTheSameOnAnyNumberOfRanks(const Parameters& parameters, const Make& make, std::uint64_t seed,
                                     const Reported& reported) {
  struct Outcome {
    Eigen::VectorXf weights;
    std::vector<double> reported;
  };
  const auto learnOn = [&](Communicator* communicator) {
    Parameters own = parameters;
    own.communicator = communicator;
    const auto learner = make(own, tinyNetwork(own, seed));
    learner->iterate();
    const auto report = learner->iterate();
    return Outcome{parameterVector(learner->layers()), reported(report)};
  };
  const Outcome one = learnOn(oneProcess());
  for (const int ranks : {2, 3}) {  // 3: more ranks than there are worlds
    for (const Outcome& outcome : onRanks(ranks, learnOn)) {
      EXPECT_EQ(outcome.weights, one.weights) << ranks << " ranks";
      EXPECT_EQ(outcome.reported, one.reported) << ranks << " ranks";
    }
  }
}

}  // namespace lstm_planner
