#pragma once

#include <cstdint>
#include <vector>

#include "lstm_planner/dataset/dataset.hpp"

namespace lstm_planner {

// Augmentation: the same drive as it could have been recorded just as well. Half an hour of driving shows a network a
// few turns in one building; these show it what does not matter. Episode::goal stays as it was given; nothing is
// learned from it.

/// In a mirrored building: right is left. Angles, labels and scans are mirrored with it. `actions` are the allowed
/// angles of the labels; they must be the same to both sides, or std::invalid_argument is thrown.
RecordedEpisode mirrored(RecordedEpisode episode, const std::vector<double>& actions);

/// With odometry that started with another heading: its frame is turned by `angle` (rad) around its origin.
RecordedEpisode turned(RecordedEpisode episode, double angle);

/// `count` variants of each episode that is not discarded: each turned at random, and every other one mirrored, the
/// first of them, too. The same for the same seed. Throws as mirrored().
Dataset variantsOf(const Dataset& dataset, int count, std::uint64_t seed);

}  // namespace lstm_planner
