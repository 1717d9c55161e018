#pragma once

#include <cstdint>
#include <vector>

#include "lstm_planner/common/geometry.hpp"
#include "lstm_planner/common/random.hpp"
#include "lstm_planner/simulation/traffic.hpp"

namespace lstm_planner {

/// How people walk about.
struct CrowdParameters {
  int walkers = 10;
  double smallest_radius = 0.2;
  double largest_radius = 0.3;
  double slowest = 0.3;
  double fastest = 1.0;
  double shortest_stand = 0.5;
  double longest_stand = 2.0;
  double first_distance = 1.0;
};

/// Visits every parameter; see parameter_visitors.hpp.
template <typename Parameters, typename Visitor>
void visitCrowdParameters(Parameters& crowd, const Visitor& visit) {
  visit("walkers", crowd.walkers, {0, 1000}, "", "people who walk about");
  visit("smallest_radius", crowd.smallest_radius, {0.01, 5.0}, "m", "of the disc of a walker");
  visit("largest_radius", crowd.largest_radius, {0.01, 5.0}, "m", "of the disc of a walker");
  visit("slowest", crowd.slowest, {0.01, 20.0}, "m/s", "smallest speed of a walker");
  visit("fastest", crowd.fastest, {0.01, 20.0}, "m/s", "largest speed of a walker");
  visit("shortest_stand", crowd.shortest_stand, {0.0, 3600.0}, "s",
        "shortest time that a walker stands when the robot is in its way");
  visit("longest_stand", crowd.longest_stand, {0.0, 3600.0}, "s",
        "longest time that a walker stands when the robot is in its way");
  visit("first_distance", crowd.first_distance, {0.0, 1000.0}, "m",
        "smallest distance between the robot and every walker at the start");
}

/// Throws std::invalid_argument naming the parameter, its value and what was expected.
void validate(const CrowdParameters& parameters);

/// A world with people in it. Each walks straight to a random place, then to another, at a speed of its own; a wall in
/// its path makes it choose another place, too. Walkers pass through each other. They ignore the robot until the
/// next step would touch it: then they stand for a while and go elsewhere. Deterministic for a seed.
class Crowd : public Traffic {
 public:
  /// One of the people.
  struct Walker {
    Circle body;
    double speed = 0.0;  ///< m/s
    Point2 destination;
    double standing = 0.0;      ///< s left
    bool beside_robot = false;  ///< it has met the robot and not left it since
  };

  /// `surroundings` and `places`, where walkers start and go to, must outlive the crowd; places where a walker does not
  /// fit are not used. `robot` is where the robot starts. Throws as validate(), and std::invalid_argument when no place
  /// is fit for a walker.
  Crowd(const World& surroundings, const std::vector<Point2>& places, const CrowdParameters& parameters,
        const Point2& robot, std::uint64_t seed);

  std::vector<Circle> advance(double seconds, const Footprint& robot, const Pose2& pose) override;
  std::vector<Body> bodies() const override;

  const std::vector<Walker>& walkers() const { return walkers_; }

 private:
  Point2 drawPlace(double radius);
  void step(double seconds, const Footprint& robot, const Pose2& pose, Walker* walker, std::vector<Circle>* meetings);

  const std::vector<Point2>& places_;
  CrowdParameters parameters_;
  Random random_;
  std::vector<Walker> walkers_;
};

/// The middles of all free cells in which a disc of that radius (m) touches nothing.
std::vector<Point2> standingPlaces(const GridWorld& world, double radius);

/// Places a quarter of a metre apart in the box between two corners in which a disc of that radius (m) touches nothing.
std::vector<Point2> standingPlaces(const World& world, const Point2& low, const Point2& high, double radius);

}  // namespace lstm_planner
