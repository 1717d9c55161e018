#pragma once

#include <string>
#include <vector>

#include "lstm_planner/dataset/dataset.hpp"

namespace lstm_planner {

/// What is wrong with the contents of a dataset that readDataset() accepts: sentences that name recording, episode and
/// step, counted from 0; empty if nothing is wrong. It checks the numbers that follow from others (driven angle, label,
/// goal's distance and bearing, heading, previous action, the next step's pose, what was measured in a scan), their
/// ranges, and the order of stamps and step numbers. It stops after about 10,000 sentences.
std::vector<std::string> checkDataset(const Dataset& dataset);

/// The same for a file, and what SQLite finds: damaged pages, rows that belong to no other row. Throws DatasetError if
/// the file cannot be read (readDataset()).
std::vector<std::string> checkDatasetFile(const std::string& path);

}  // namespace lstm_planner
