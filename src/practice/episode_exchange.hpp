#pragma once

#include <vector>

#include "lstm_planner/common/communicator.hpp"
#include "practice/practice_episode.hpp"

namespace lstm_planner {

/// The drives of all ranks, in the order of the ranks, from those of this one. Every rank has to call it.
std::vector<PracticeEpisode> exchangeEpisodes(Communicator* ranks, std::vector<PracticeEpisode> own);

}  // namespace lstm_planner
