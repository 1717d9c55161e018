#include "lstm_planner/practice/encoded_export.hpp"

#include <sstream>

#include "lstm_planner/common/csv_writer.hpp"
#include "lstm_planner/common/output_file.hpp"
#include "lstm_planner/practice/dataset_sequences.hpp"

namespace lstm_planner {
namespace {

void writeNames(const PolicyDescription& policy, const std::vector<double>& distances, CsvWriter* csv) {
  csv->add("episode", "step");
  csv->addAll(policy.encoder.input_layout);
  for (const double distance : distances) {
    std::ostringstream name;
    name << "label_" << distance;
    csv->add(name.str());
  }
  csv->endRow();
}

/// `episodes`: by label distance. Their inputs differ in the previous action, which follows the labels: those of the
/// first distance are written.
void writeRows(const std::vector<std::vector<Sequence>>& episodes, CsvWriter* csv) {
  for (std::size_t episode = 0; episode < episodes.front().size(); ++episode) {
    const Sequence& told = episodes.front()[episode];
    for (Eigen::Index step = 0; step < told.steps(); ++step) {
      csv->add(episode, step);
      for (Eigen::Index row = 0; row < told.inputs.rows(); ++row) csv->add(told.inputs(row, step));
      for (const std::vector<Sequence>& labelled : episodes) csv->add(labelled[episode].labels[step]);
      csv->endRow();
    }
  }
}

}  // namespace

void exportEncodedCsv(const std::string& path, const Dataset& dataset, const PolicyDescription& policy,
                      const std::vector<double>& label_distances) {
  if (label_distances.empty()) throw std::invalid_argument("there is no label distance, expected one or more");
  std::vector<std::vector<Sequence>> episodes;
  for (const double distance : label_distances) {
    DatasetSequenceParameters parameters;
    parameters.policy = policy;
    parameters.label_distance = distance;
    episodes.push_back(datasetSequences(dataset, parameters));
  }
  try {
    OutputFile file(path);
    CsvWriter csv(&file.stream(), CsvWriter::Digits::kExact);
    writeNames(policy, label_distances, &csv);
    writeRows(episodes, &csv);
    file.commit();
  } catch (const OutputFileError& error) {
    throw DatasetError("'" + path + "' cannot be written: " + error.what());
  }
}

}  // namespace lstm_planner
