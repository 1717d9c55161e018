#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lstm_planner/common/geometry.hpp"
#include "lstm_planner/common/random.hpp"
#include "lstm_planner/simulation/traffic.hpp"

namespace lstm_planner {

/// How people walk about.
struct CrowdParameters {
  int walkers = 10;
  double smallest_radius = 0.2;  ///< m, of the disc of a walker
  double largest_radius = 0.3;   ///< m
  double slowest = 0.3;          ///< m/s
  double fastest = 1.0;          ///< m/s
  double shortest_stand = 0.5;   ///< s that a walker stands if the robot is in its way
  double longest_stand = 2.0;    ///< s
  double first_distance = 1.0;   ///< m, smallest distance between the robot and a walker at the start
};

/// A world with people in it. Each walks straight to a random place, then to another, at a speed of its own; if a wall
/// is in its path, it chooses another place. Walkers pass through each other. They ignore the robot until the next step
/// would touch it: then they stand for a while and go elsewhere. The same for the same seed.
class Crowd : public Traffic {
 public:
  /// What one of the people does; its body is the circle with the same number.
  struct Walker {
    double speed = 0.0;  ///< m/s
    Point2 destination;
    double standing = 0.0;  ///< s left
  };

  /// `surroundings` and `places`, where walkers start and go to, must outlive the crowd; places where a walker does not
  /// fit are not used. `robot` is where the robot starts. Throws std::invalid_argument if there is no place for a
  /// walker.
  Crowd(const World& surroundings, const std::vector<Point2>& places, const CrowdParameters& parameters,
        const Point2& robot, std::uint64_t seed);

  std::vector<Circle> advance(double seconds, const Footprint& robot, const Pose2& pose) override;

  const std::vector<Walker>& walkers() const { return walkers_; }

 private:
  Point2 drawPlace(double radius);
  /// Lets one of them walk. Whether it has run into the robot, in a new meeting.
  bool step(double seconds, const Footprint& robot, const Pose2& pose, std::size_t number);

  const std::vector<Point2>& places_;
  CrowdParameters parameters_;
  Random random_;
  std::vector<Walker> walkers_;
};

/// The centres of all free cells at which a disc of that radius (m) touches nothing.
std::vector<Point2> standingPlaces(const GridWorld& world, double radius);

/// Places a quarter of a metre apart in the box between two corners in which a disc of that radius (m) touches nothing.
std::vector<Point2> standingPlaces(const World& world, const Point2& low, const Point2& high, double radius);

}  // namespace lstm_planner
