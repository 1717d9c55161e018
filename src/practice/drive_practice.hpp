#pragma once

#include <vector>

#include "lstm_planner/network/layers.hpp"
#include "lstm_planner/practice/drive_actor_critic.hpp"
#include "practice/practice_episode.hpp"

namespace lstm_planner {

/// All drives of iteration `iteration` (from 0) that had a step. The actions are drawn by
/// the network's preferences (softmax), among those that the shield allows. A share of the drives (path_share) are
/// examples (drivePathExample()). Throws std::runtime_error when there is no drive.
std::vector<PracticeEpisode> practise(const DriveActorCriticParameters& parameters, const LayerStack& layers,
                                      int iteration);

}  // namespace lstm_planner
