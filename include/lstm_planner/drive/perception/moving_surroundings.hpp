#pragma once

#include <array>
#include <vector>

#include "lstm_planner/drive/perception/moving_returns.hpp"
#include "lstm_planner/drive/perception/moving_things.hpp"
#include "lstm_planner/drive/perception/situation.hpp"

namespace lstm_planner {

/// What moves around the robot, seen by one scanner or two. Each scanner's scans are compared with one another only:
/// two scanners may look at different heights.
class MovingSurroundings {
 public:
  /// Throws std::invalid_argument as validate().
  explicit MovingSurroundings(const MovingReturnsParameters& parameters) : eyes_{{Eye(parameters), Eye(parameters)}} {}

  /// As MovingReturns.
  void expectSpeed(double fastest) {
    for (Eye& eye : eyes_) eye.returns.expectSpeed(fastest);
  }

  /// Takes in what is seen now.
  void show(const Situation& situation) {
    eyes_[0].returns.show(situation.profile, situation.pose, situation.time);
    // The profile is that of the situation's pose, so its time counts, too: the robot moves from one to the next.
    eyes_[1].returns.show(situation.second.profile, situation.pose, situation.time);
    collect();
  }

  const std::vector<Point2>& points() const { return points_; }    ///< MovingReturns::points() of all scanners
  const std::vector<Point2>& resting() const { return resting_; }  ///< MovingReturns::resting() of all scanners

  /// What moves, and how, as seen from `pose`, `later` s after the situation that was shown last. Things are followed
  /// from call to call, so it must be called after each show(), or never.
  std::vector<MovingThing> follow(const Situation& situation, const Pose2& pose, double later) {
    std::vector<MovingThing> things;
    const std::array<double, 2> times = {situation.time, situation.second.time};
    for (std::size_t i = 0; i < eyes_.size(); ++i) {
      Eye& eye = eyes_[i];
      eye.things.show(eye.returns.returns(), eye.returns.moves(), times[i]);
      for (MovingThing thing : eye.things.around(pose)) {
        const double since = situation.time - times[i] + later;
        thing.center.x += since * thing.velocity.x;
        thing.center.y += since * thing.velocity.y;
        things.push_back(thing);
      }
    }
    return things;
  }

  /// Forgets all: after a jump of the odometry, for instance.
  void reset() {
    for (Eye& eye : eyes_) {
      eye.returns.reset();
      eye.things.reset();
    }
    collect();
  }

 private:
  /// What one scanner has seen.
  struct Eye {
    explicit Eye(const MovingReturnsParameters& parameters) : returns(parameters) {}
    MovingReturns returns;
    MovingThings things;
  };

  void collect() {
    points_.clear();
    resting_.clear();
    for (const Eye& eye : eyes_) {
      points_.insert(points_.end(), eye.returns.points().begin(), eye.returns.points().end());
      resting_.insert(resting_.end(), eye.returns.resting().begin(), eye.returns.resting().end());
    }
  }

  std::array<Eye, 2> eyes_;  ///< a scanner each
  std::vector<Point2> points_, resting_;
};

}  // namespace lstm_planner
