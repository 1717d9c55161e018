#include "tools/dataset_conversion.hpp"

#include <algorithm>
#include <exception>
#include <iostream>
#include <map>
#include <utility>

#include "lstm_planner/common/words.hpp"
#include "lstm_planner/dataset/dataset_summary.hpp"
#include "tools/dataset_report.hpp"

namespace lstm_planner {

namespace {

/// Counts why something became no step.
class ExplainedSink : public RecordingSink {
 public:
  using RecordingSink::RecordingSink;

  void explain(Rejection rejection, const std::string& why) override {
    // Sentences that differ in their numbers alone say the same.
    std::string words = why;
    words.erase(std::remove_if(words.begin(), words.end(), [](char c) { return c >= '0' && c <= '9'; }), words.end());
    Reason& reason = reasons_[rejection].emplace(words, Reason{why, 0}).first->second;
    ++reason.count;
  }

  void printReasons() const {
    for (const auto& [rejection, reasons] : reasons_) {
      const auto commonest = std::max_element(
          reasons.begin(), reasons.end(), [](const auto& a, const auto& b) { return a.second.count < b.second.count; });
      const Reason& reason = commonest->second;
      std::cout << "    " << toString(rejection) << ", " << reason.count << " times: " << reason.sentence << "\n";
    }
  }

 private:
  struct Reason {
    std::string sentence;  ///< the first of its kind
    long count = 0;
  };

  std::map<Rejection, std::map<std::string, Reason>> reasons_;
};

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

Recording converted(const Parts& parts, const RecorderParameters& parameters, const Converter& convert) {
  RecordingDescription description;
  description.parameters = parameters;
  description.software_version = softwareVersion();
  description.source = joined(parts);
  for (const std::string& part : parts) std::cout << part << "\n";
  ExplainedSink sink(description);
  convert(parts, &sink);
  sink.recording().finished = true;
  printOutcome(sink.recording());
  sink.printReasons();
  return std::move(sink.recording());
}

}  // namespace

int convertIntoDataset(const std::vector<Parts>& sources, const RecorderParameters& parameters,
                       const std::string& output, const Converter& convert) {
  validate(parameters);
  Dataset dataset;
  std::exception_ptr error;
  for (const Parts& parts : sources) {
    try {
      dataset.recordings.push_back(converted(parts, parameters, convert));
    } catch (const std::exception&) {
      error = std::current_exception();
      break;
    }
  }
  const long steps = stepCount(dataset);
  if (error && steps == 0) std::rethrow_exception(error);
  if (steps == 0) {
    std::cerr << output << " is not written: there is no step; the lines \"no steps\" above say why\n";
    return 1;
  }
  writeDataset(output, dataset);
  std::cout << output << ": " << steps << " steps" << (error ? " of what was converted before the error" : "")
            << std::endl;
  if (error) std::rethrow_exception(error);
  return 0;
}

}  // namespace lstm_planner
