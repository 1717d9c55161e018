#include "tools/dataset_conversion.hpp"

#include <algorithm>
#include <exception>
#include <iostream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "lstm_planner/common/words.hpp"
#include "lstm_planner/dataset/dataset_summary.hpp"
#include "tools/command_line.hpp"
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
  std::cout << "  " << summary.steps << " steps in " << summary.episodes << " episodes"
            << (summary.ends.empty() ? "" : " (" + endsText(summary) + ")") << "\n";
  if (summary.steps > 0) {
    std::cout << "  ";
    printLabels(std::cout, summary);
  }
  const std::string rejected = textOf(recording.rejections);
  std::cout << "  no steps:" << (rejected.empty() ? "" : " ") << rejected << std::endl;
}

Recording converted(const Parts& parts, const RecorderParameters& parameters, const Converter& convert) {
  RecordingDescription description;
  description.parameters = parameters;
  description.source = joined(parts);
  for (const std::string& part : parts) std::cout << part << "\n";
  ExplainedSink sink(description);
  convert(parts, &sink);
  sink.recording().finished = true;
  printOutcome(sink.recording());
  sink.printReasons();
  return std::move(sink.recording());
}

SensorMount mountNamed(const std::string& text) {
  std::istringstream stream(text);
  Pose2 pose;
  stream >> pose.x >> pose.y >> pose.yaw;
  if (!stream || !(stream >> std::ws).eof() || !isFinite(pose)) {
    throw std::invalid_argument("option --mount is '" + text + "', expected \"x y yaw\" in m, m and rad");
  }
  return {pose, false};
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

void addRecorderOptions(RecorderParameters* parameters, CommandLine* line) {
  RecorderParameters& p = *parameters;
  visitRecorderParameters(p, onlyNamed({"period", "min_step_distance", "min_step_turn", "max_gap", "max_speed",
                                        "goal_tolerance", "delay", "range_cap", "least_measured"},
                                       line->everyParameter()));
  line->addText(
      "no-return", noReturnText(p.scan_rules), [&](const std::string& text) { setNoReturn(text, &p.scan_rules); },
      "readings that mean no return besides +inf: \"nan\", \"zero\", \"below\" (range_min), \"beyond\" (range_max), a "
      "number (m); for urg_node: \"nan zero beyond 65.53\"");
  line->addText(
      "beam-times", beamTimesText(p.scan_rules), [&](const std::string& text) { setBeamTimes(text, &p.scan_rules); },
      "when the first and the last beam of a scan are measured, s after its stamp, such as \"0.18 0\"; default: "
      "all at the stamp");
  line->addFlag("no-scans", &p.keep_scans, false, "store only the sectors, not the whole scans");
}

void addMountOption(std::optional<SensorMount>* mount, const std::string& otherwise, CommandLine* line) {
  line->addText(
      "mount", "",
      [=](const std::string& text) {
        if (!text.empty()) *mount = mountNamed(text);
      },
      "\"x y yaw\" (m, m, rad): pose of the scanner in the robot's frame; default: " + otherwise);
}

}  // namespace lstm_planner
