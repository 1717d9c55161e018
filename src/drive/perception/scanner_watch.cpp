#include "lstm_planner/drive/perception/scanner_watch.hpp"

#include <cmath>

namespace lstm_planner {

void ScannerWatch::hear(const LaserScan& scan, const ScanRules& rules, double stamp, double received,
                        const Pose2& pose) {
  is_heard_ = true;
  stamp_ = stamp;
  received_ = received;
  period_.note(stamp);
  silence_.show(scan, rules, stamp, pose);
}

void ScannerWatch::check(double now) const {
  if (!is_heard_) throw SensorError("no scan has been received on " + topic_);
  if (const std::string problem = ageProblem(now); !problem.empty()) throw SensorError(problem);
  if (silence_.isCovered()) {
    throw SensorError("the scanner counts as covered: on " + topic_ +
                      " no beam has had a return since a scan in which " +
                      std::to_string(std::lround(100.0 * silence_.shareBefore())) + " % of them had one");
  }
}

std::string ScannerWatch::ageProblem(double now) const {
  return messageProblem(now - stamp_, now - received_, timeout(), topic_, "scan_timeout");
}

double ScannerWatch::timeout() const { return timeoutFor(set_timeout_, period_.period(), least_timeout_); }

}  // namespace lstm_planner
