#pragma once

#include <cstdint>

#include "lstm_planner/network/layers.hpp"
#include "lstm_planner/practice/drive_actor_critic.hpp"
#include "lstm_planner/practice/drive_course.hpp"
#include "practice/practice_episode.hpp"

namespace lstm_planner {

/// A drive as the planner drives: the network leads and is overruled where its detours exceed the bound, obstacles are
/// remembered, and odometry does not drift, because the planner takes drift away. The example's actions lead along the
/// remembered path (Ross et al., "A reduction of imitation learning and structured prediction to no-regret online
/// learning", 2011).
PracticeEpisode drivePathExample(const DriveActorCriticParameters& parameters, const LayerStack& layers,
                                 const DriveExercise& exercise, const DriveTask& task, std::uint64_t seed);

}  // namespace lstm_planner
