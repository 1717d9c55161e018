#include "tools/dataset_conversion.hpp"

#include <array>
#include <ctime>
#include <iostream>
#include <utility>

#include "lstm_planner/robot/dataset/dataset_summary.hpp"
#include "tools/dataset_report.hpp"

namespace lstm_planner {

namespace {

void printOutcome(const Recording& recording) {
  Dataset dataset;
  dataset.recordings = {recording};
  const DatasetSummary summary = summarise(dataset);
  std::cout << "  " << summary.steps << " steps in " << summary.episodes << " episodes";
  const char* separator = " (";
  for (const auto& [end, count] : summary.ends) {
    std::cout << separator << count << " " << toString(end);
    separator = ", ";
  }
  std::cout << (summary.ends.empty() ? "\n" : ")\n");
  if (summary.steps > 0) {
    std::cout << "  ";
    printLabels(std::cout, summary);
  }
  std::cout << "  no steps:";
  separator = " ";
  for (std::size_t i = 0; i < recording.rejections.size(); ++i) {
    if (recording.rejections[i] == 0) continue;
    std::cout << separator << recording.rejections[i] << " " << toString(static_cast<Rejection>(i));
    separator = ", ";
  }
  std::cout << std::endl;
}

}  // namespace

void convertIntoDataset(const std::vector<std::string>& files, const RecorderParameters& parameters,
                        const std::string& output,
                        const std::function<void(const std::string& file, RecordingSink* sink)>& convert) {
  validate(parameters);
  Dataset dataset;
  for (const std::string& file : files) {
    RecordingDescription description;
    description.parameters = parameters;
    description.software_version = softwareVersion();
    description.source = file;
    RecordingSink sink(description);
    std::cout << file << "\n";
    convert(file, &sink);
    sink.recording().finished = true;
    printOutcome(sink.recording());
    dataset.recordings.push_back(std::move(sink.recording()));
  }
  writeDataset(output, dataset);
  std::cout << output << ": " << stepCount(dataset) << " steps" << std::endl;
}

std::string utcTime(double seconds_since_1970) {
  const std::time_t time = static_cast<std::time_t>(seconds_since_1970);
  std::tm utc{};
  gmtime_r(&time, &utc);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text.data();
}

}  // namespace lstm_planner
