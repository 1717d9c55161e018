#pragma once

#include <string>
#include <vector>

#include "lstm_planner/dataset/dataset.hpp"
#include "lstm_planner/drive/decision/drive_policy.hpp"
#include "lstm_planner/training/gradient.hpp"

namespace lstm_planner {

/// Several files as one.
Dataset readDatasets(const std::vector<std::string>& paths, bool with_scans);

/// The same, with scans only where the policy needs them.
Dataset readDatasetsFor(const PolicyDescription& policy, const std::vector<std::string>& paths);

/// "12.3 %".
std::string percentText(double share);

/// "accuracy 88.3 %, balanced 55.3 %", of a row a label.
std::string accuracyText(const ConfusionMatrix& confusion);

/// The same of the majority-class baseline.
std::string majorityText(const ConfusionMatrix& confusion);

}  // namespace lstm_planner
