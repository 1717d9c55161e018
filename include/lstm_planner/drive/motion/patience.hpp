#pragma once

#include <optional>
#include <vector>

#include "lstm_planner/common/geometry.hpp"
#include "lstm_planner/drive/motion/motion_controller.hpp"
#include "lstm_planner/drive/motion/stand_watch.hpp"
#include "lstm_planner/drive/perception/situation.hpp"

namespace lstm_planner {

/// How long a robot goes on trying where it does not get away: for a time before obstacles, for ever before a person.
/// Then it gives up, until it is moved, has another goal, its plan leads another way, or three times that time has
/// passed.
class Patience {
 public:
  /// The robot is about to answer `plan` (not empty, odometry frame) in that situation with that command. Whether it
  /// has patience yet, which lasts `limit` s; 0: always.
  bool lasts(double limit, const MotionCommand& command, const std::vector<Pose2>& plan, const Situation& situation);

  /// As of the last command asked about.
  bool isHalfGone() const { return is_half_gone_; }

  /// Nothing is to be waited for, or the odometry jumped.
  void clear();

 private:
  bool leadsAnotherWay(const std::vector<Pose2>& plan, const Pose2& pose);

  StandWatch stand_;
  std::optional<double> gave_up_towards_;  ///< rad, odometry frame
  bool is_half_gone_ = false;
};

}  // namespace lstm_planner
