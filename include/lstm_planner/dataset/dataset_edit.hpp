#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lstm_planner/dataset/dataset.hpp"

namespace lstm_planner {

/// The recordings of all files, in their order, with scans. Throws DatasetError naming the files when their allowed
/// angles differ, so that a label would mean two things, or when they have an episode in common.
Dataset mergeDatasets(const std::vector<std::string>& paths);

/// The two parts of a dataset.
struct DatasetSplit {
  Dataset training;
  Dataset validation;
};

/// Divides a dataset by whole episodes, drawn at random, so that about `share` of the steps are in the second part:
/// steps of one drive resemble each other too much to judge what was learned from the others. Either part gets an
/// episode with steps at least. Discarded and empty episodes stay in the first, and so do the counts of rejections.
/// The same seed gives the same parts on every machine. Throws std::invalid_argument unless `share` is in (0, 1) and
/// two episodes have steps.
DatasetSplit splitDataset(const Dataset& dataset, double share, std::uint64_t seed);

}  // namespace lstm_planner
