#include "lstm_planner/robot/learning/encoded_export.hpp"

#include <limits>
#include <ostream>
#include <sstream>

#include "lstm_planner/base/common/output_file.hpp"
#include "lstm_planner/robot/learning/dataset_sequences.hpp"

namespace lstm_planner {
namespace {

void writeNames(const PolicyDescription& policy, const std::vector<double>& distances, std::ostream& out) {
  out << "episode,step";
  for (const std::string& name : policy.encoder.input_layout) out << ',' << name;
  for (const double distance : distances) out << ",label_" << distance;
  out << '\n';
}

/// `episodes`: by label distance; they differ in the labels alone.
void writeRows(const std::vector<std::vector<Sequence>>& episodes, std::ostream& out) {
  out.precision(std::numeric_limits<float>::max_digits10);
  for (std::size_t episode = 0; episode < episodes.front().size(); ++episode) {
    const Sequence& told = episodes.front()[episode];
    for (Eigen::Index step = 0; step < told.steps(); ++step) {
      out << episode << ',' << step;
      for (Eigen::Index row = 0; row < told.inputs.rows(); ++row) out << ',' << told.inputs(row, step);
      for (const std::vector<Sequence>& labelled : episodes) out << ',' << labelled[episode].labels[step];
      out << '\n';
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
    writeNames(policy, label_distances, file.stream());
    writeRows(episodes, file.stream());
    file.commit();
  } catch (const OutputFileError& error) {
    throw DatasetError("'" + path + "' cannot be written: " + error.what());
  }
}

}  // namespace lstm_planner
