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
  /// What is left of it.
  enum class Left { kMuch, kLessThanHalf, kNone };

  /// The robot is about to answer `plan` (odometry frame) in that situation with that command. Its patience lasts
  /// `limit` s; 0: for ever. With an empty plan nothing is to be waited for.
  Left note(double limit, const MotionCommand& command, const std::vector<Pose2>& plan, const Situation& situation);

  /// The odometry jumped.
  void clear();

 private:
  bool leadsAnotherWay(const std::vector<Pose2>& plan, const Pose2& pose);

  StandWatch stand_;
  double asked_ = 0.0;                     ///< s, when it was asked last
  std::optional<double> gave_up_towards_;  ///< rad, odometry frame
};

}  // namespace lstm_planner
