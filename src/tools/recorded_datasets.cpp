#include "tools/recorded_datasets.hpp"

#include <iterator>
#include <utility>

#include "lstm_planner/common/text_table.hpp"
#include "lstm_planner/practice/dataset_sequences.hpp"
#include "lstm_planner/training/confusion.hpp"

namespace lstm_planner {

Dataset readDatasets(const std::vector<std::string>& paths, bool with_scans) {
  Dataset all;
  for (const std::string& path : paths) {
    Dataset dataset = readDataset(path, with_scans);
    std::move(dataset.recordings.begin(), dataset.recordings.end(), std::back_inserter(all.recordings));
  }
  return all;
}

Dataset readDatasetsFor(const PolicyDescription& policy, const std::vector<std::string>& paths) {
  Dataset dataset = readDatasets(paths, false);
  return needsScans(dataset, policy) ? readDatasets(paths, true) : dataset;
}

std::string percentText(double share) { return fixedText(100.0 * share, 1) + " %"; }

std::string accuracyText(const ConfusionMatrix& confusion) {
  return "accuracy " + percentText(accuracyOf(confusion)) + ", balanced " + percentText(balancedAccuracy(confusion));
}

std::string majorityText(const ConfusionMatrix& confusion) { return accuracyText(constantAnswer(confusion)); }

}  // namespace lstm_planner
