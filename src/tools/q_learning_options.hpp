#pragma once

#include "lstm_planner/base/learning/q_learner.hpp"
#include "tools/command_line.hpp"

namespace lstm_planner {

/// By the names of --reward.
inline const Choices<QLearningParameters::Reward>& rewards() {
  static const Choices<QLearningParameters::Reward> choices = {{"progress", QLearningParameters::Reward::kProgress},
                                                               {"thesis", QLearningParameters::Reward::kThesis}};
  return choices;
}

inline void addRewardOption(QLearningParameters::Reward* reward, CommandLine* line) {
  line->addChoice(
      "reward", reward, rewards(),
      "progress (how much shorter the true shortest path to the goal has become, minus a cost) or thesis (Eq. 2.36)");
}

}  // namespace lstm_planner
