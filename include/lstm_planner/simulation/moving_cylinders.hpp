#pragma once

#include <cstdint>
#include <vector>

#include "lstm_planner/common/geometry.hpp"
#include "lstm_planner/common/random.hpp"
#include "lstm_planner/grid/occupancy_grid.hpp"
#include "lstm_planner/simulation/traffic.hpp"

namespace lstm_planner {

/// How cylinders move in a DynaBARN world.
struct MovingCylindersParameters {
  int cylinders = 6;
  int order = 2;         ///< of the polynomials that they move along
  double slowest = 0.4;  ///< m/s
  double fastest = 1.0;  ///< m/s
  double spread = 0.2;   ///< m/s, standard deviation of a cylinder's speed from one stretch to the next
};

/// Difficulty of a DynaBARN world, as published. Easy motion: order 1 or 2, 0.5 to 1 m/s, spread 0.01 to 0.1 m/s; hard
/// motion: order 3 or 4, 1 to 2 m/s, spread 0.1 to 0.2 m/s. Few cylinders are 5 to 10, many are 10 to 20.
enum class DynaBarnClass {
  kEasy,    ///< few cylinders with easy motion
  kMedium,  ///< few with hard motion, or many with easy motion
  kHard     ///< many cylinders with hard motion
};

constexpr int kDynaBarnWorldsAClass = 20;

/// The class of world `number` (from 0): the first 20 are easy, the next 20 medium, the others hard.
DynaBarnClass dynaBarnClassOf(int number);

const char* toString(DynaBarnClass difficulty);

/// The parameters of world `number`, drawn from a seed by the rules of its class.
MovingCylindersParameters drawMovingCylinders(int number, std::uint64_t seed);

/// Half the side of the square in which they move, around the origin, m.
constexpr double kCylindersArea = 10.0;

/// The floor of DynaBARN: walls on three sides of the square; the fourth, at the largest x, is open, and the robot
/// starts in front of it.
OccupancyGrid cylindersFloor();

/// Cylinders 1 m wide that avoid nothing. Each moves along a polynomial through random points, from one border of the
/// square to the other, on each stretch with another speed; at the end it goes back to its start. After the published
/// generator of DynaBARN (Nair et al., "DynaBARN: Benchmarking Metric Ground Navigation in Dynamic Environments", SSRR
/// 2022). The same for the same seed.
class MovingCylinders : public Traffic {
 public:
  /// `robot` is where the robot starts: no cylinder starts within 3 m of it. Throws std::invalid_argument if no path
  /// for a cylinder is found.
  MovingCylinders(const World& surroundings, const MovingCylindersParameters& parameters, const Point2& robot,
                  std::uint64_t seed);

  std::vector<Circle> advance(double seconds, const Footprint& robot, const Pose2& pose) override;

 private:
  /// The path of a cylinder, and where it is on it.
  struct Route {
    std::vector<Point2> corners;
    std::vector<double> speeds;  ///< m/s, of the stretch behind each corner
    std::size_t stretch = 0;
    double along = 0.0;  ///< m of the stretch
  };
  Route drawRoute(const Point2& robot);
  std::vector<Point2> drawPath();
  double drawSpeed(double mean);
  static Point2 advance(double seconds, Route* route);

  MovingCylindersParameters parameters_;
  Random random_;
  std::vector<Route> routes_;
};

}  // namespace lstm_planner
