#pragma once

#include <string>
#include <vector>

#include "lstm_planner/dataset/dataset.hpp"

namespace lstm_planner {

/// What is wrong with the contents of a dataset that readDataset() takes: sentences that name recording, episode and
/// step, counted from 0; empty when nothing is. Looked at are the numbers that follow from others (driven angle, label,
/// goal's distance and bearing, heading, previous action, the next step's pose, what was measured in a scan), their
/// ranges, and the order of stamps and step numbers. After some 10,000 sentences it stops checking.
std::vector<std::string> checkDataset(const Dataset& dataset);

/// The same of a file, and what SQLite finds: damaged pages, rows that belong to nothing. Throws DatasetError when it
/// cannot be read at all (readDataset).
std::vector<std::string> checkDatasetFile(const std::string& path);

}  // namespace lstm_planner
