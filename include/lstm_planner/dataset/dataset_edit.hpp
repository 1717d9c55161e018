#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lstm_planner/dataset/dataset.hpp"

namespace lstm_planner {

/// The recordings of all files, in their order, with scans. Throws DatasetError naming the files if their allowed
/// angles differ, so that a label would have two meanings, or if they have an episode in common.
Dataset mergeDatasets(const std::vector<std::string>& paths);

/// The two parts of a dataset.
struct DatasetSplit {
  Dataset training;
  Dataset validation;
};

/// Divides a dataset by whole episodes, drawn at random, so that about `share` of the steps are in the part for
/// validation: steps of one drive are too similar to each other to be divided. Each part gets at least one episode with
/// steps. Discarded and empty episodes and the counts of rejections stay in the part for training.
/// The same seed gives the same parts on every machine. Throws std::invalid_argument unless `share` is in (0, 1) and
/// two episodes have steps.
DatasetSplit splitDataset(const Dataset& dataset, double share, std::uint64_t seed);

}  // namespace lstm_planner
