#pragma once

#include <string>

#include "lstm_planner/common/geometry.hpp"
#include "lstm_planner/drive/perception/laser_scan.hpp"
#include "lstm_planner/drive/perception/message_age.hpp"
#include "lstm_planner/drive/perception/period_meter.hpp"
#include "lstm_planner/drive/perception/scan_rules.hpp"
#include "lstm_planner/drive/perception/silence_watch.hpp"

namespace lstm_planner {

/// Says whether the newest scan of one scanner may be used: it has come, it is not too old for this scanner's period,
/// and the lens is not covered. What the scan contains is checked by perceive().
class ScannerWatch {
 public:
  /// `topic`: its name in messages. `timeout`: s, parameter scan_timeout, see timeoutFor(); `least_timeout`: s.
  ScannerWatch(const std::string& topic, double timeout, double least_timeout)
      : topic_(topic), set_timeout_(timeout), least_timeout_(least_timeout) {}

  /// A scan has come, at `received` (s). `stamp`: its time, s. `pose`: the robot's, newest, by odometry.
  void hear(const LaserScan& scan, const ScanRules& rules, double stamp, double received, const Pose2& pose);

  /// The odometry has jumped: as SilenceWatch::noteJump().
  void noteJump(double time, const Pose2& pose) { silence_.noteJump(time, pose); }

  /// What is wrong with the age of the newest scan at `now` (s), as messageProblem().
  std::string ageProblem(double now) const;
  /// Throws SensorError, which names the topic, unless the newest scan may be used at `now` (s).
  void check(double now) const;

  bool isHeard() const { return is_heard_; }
  double stamp() const { return stamp_; }             ///< s, of the newest scan
  double period() const { return period_.period(); }  ///< s, as measured; 0 as long as it is not known
  double timeout() const;                             ///< s
  const std::string& topic() const { return topic_; }

 private:
  std::string topic_;
  double set_timeout_;
  double least_timeout_;
  bool is_heard_ = false;
  double stamp_ = 0.0;
  double received_ = 0.0;
  PeriodMeter period_;
  SilenceWatch silence_;
};

}  // namespace lstm_planner
