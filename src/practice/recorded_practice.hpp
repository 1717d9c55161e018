#pragma once

#include <vector>

#include "lstm_planner/dataset/dataset.hpp"
#include "practice/drive_practice.hpp"

namespace lstm_planner {

/// Recorded drives in the form of practised ones, with the driver's steering angles as actions. Rare angles weigh more
/// (LabelBalance::kSquareRoot), 1 on average. Throws as forEachRecordedEpisode().
std::vector<PracticeEpisode> recordedPractice(const Dataset& dataset, const PolicyDescription& policy,
                                              double label_distance);

}  // namespace lstm_planner
