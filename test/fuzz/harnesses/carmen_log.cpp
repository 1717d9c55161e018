#include "lstm_planner/dataset/carmen_log.hpp"

#include <Poco/DeflatingStream.h>

#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>

#include "fuzz/harness.hpp"
#include "fuzz/scratch_file.hpp"
#include "fuzz/small_memory.hpp"
#include "lstm_planner/dataset/dataset.hpp"

namespace lstm_planner::fuzz::carmen_log_harness {
namespace {

std::string compressed(const std::string& text) {
  std::ostringstream stream;
  Poco::DeflatingOutputStream deflating(stream, Poco::DeflatingStreamBuf::STREAM_GZIP);
  deflating << text;
  deflating.close();
  return stream.str();
}

RecorderParameters smallWorld() {
  RecorderParameters parameters;
  parameters.agent.memory = smallMemory();
  return parameters;
}

/// A log as it is, plain or compressed; one that starts with 'z' is compressed first.
void readLog(const std::uint8_t* data, std::size_t size) {
  static ScratchFile file(".log");
  std::string log(reinterpret_cast<const char*>(data), size);
  if (!log.empty() && log[0] == 'z') log = compressed(log.substr(1));
  file.write(log);
  expectRefusal<std::invalid_argument>([] {
    const CarmenLog read = readCarmenLog(file.path());
    require(read.scans > 0 && read.events.size() >= static_cast<std::size_t>(read.scans), "a log has scans");
    RecordingSink sink{RecordingDescription{}};
    recordCarmenLog(read, {}, smallWorld(), &sink);
    for (const RecordedEpisode& episode : sink.recording().episodes) {
      for (const DriveStep& step : episode.steps) {
        require(isFinite(step.pose) && std::isfinite(step.driven_angle), "steps are finite");
      }
    }
  });
}

const Registration registration("carmen_log", &readLog);

}  // namespace
}  // namespace lstm_planner::fuzz::carmen_log_harness
