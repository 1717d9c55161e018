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
  void expectSpeed(double fastest);

  /// Takes in what is seen now.
  void show(const Situation& situation);

  const std::vector<Point2>& points() const { return points_; }    ///< MovingReturns::points() of all scanners
  const std::vector<Point2>& resting() const { return resting_; }  ///< MovingReturns::resting() of all scanners

  /// What moves, and how, in the situation that was shown last; base frame. Things are followed from call to call, so
  /// it must be called after each show(), or never.
  std::vector<MovingThing> follow(const Situation& situation);

  /// Forgets all: after a jump of the odometry, for instance.
  void reset();

 private:
  /// What one scanner has seen.
  struct Eye {
    explicit Eye(const MovingReturnsParameters& parameters) : returns(parameters) {}
    MovingReturns returns;
    MovingThings things;
  };

  void collect();

  std::array<Eye, 2> eyes_;  ///< a scanner each
  std::vector<Point2> points_, resting_;
};

}  // namespace lstm_planner
