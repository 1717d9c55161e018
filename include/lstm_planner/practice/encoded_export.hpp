#pragma once

#include <string>
#include <vector>

#include "lstm_planner/dataset/dataset.hpp"
#include "lstm_planner/drive/decision/drive_policy.hpp"

namespace lstm_planner {

/// Writes the network's inputs at each recorded step and the right answer, for other programs that train: a row for
/// each step, below a line with the names of the columns. The columns are episode (counted from 0) and step; the
/// encoded inputs, by their names in the policy's input layout; and label_D for each D of `label_distances` (m): the
/// index of the steering angle towards the place where the driver was after that distance, for label_0 at the next step
/// (thesis Eq. 4.1-4.2). The previous action among the inputs is that of the first distance. The hidden state is to be
/// reset with each episode. Discarded episodes are left out.
///
/// Throws DatasetError if the file cannot be written, and std::invalid_argument if there is no label distance, or if
/// the recordings do not fit the policy (forEachRecordedEpisode()).
void exportEncodedCsv(const std::string& path, const Dataset& dataset, const PolicyDescription& policy,
                      const std::vector<double>& label_distances);

}  // namespace lstm_planner
