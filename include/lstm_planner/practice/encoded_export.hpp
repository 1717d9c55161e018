#pragma once

#include <string>
#include <vector>

#include "lstm_planner/dataset/dataset.hpp"
#include "lstm_planner/drive/decision/drive_policy.hpp"

namespace lstm_planner {

/// Writes what a network is told at each recorded step and what it should answer, for other programs that train: a row
/// a step below a line with the names of the columns. episode (counted from 0) and step; the inputs, by the names of
/// the policy's input layout, encoded; and label_D for each of the `label_distances` (m): the index of the steering
/// angle towards where the driver was after that distance, label_0 after half a second (thesis Eq. 4.1-4.2). The hidden
/// state is reset with each episode. Discarded episodes are left out.
///
/// Throws DatasetError when the file cannot be written, std::invalid_argument when the recordings do not fit the policy
/// (forEachRecordedEpisode()).
void exportEncodedCsv(const std::string& path, const Dataset& dataset, const PolicyDescription& policy,
                      const std::vector<double>& label_distances);

}  // namespace lstm_planner
