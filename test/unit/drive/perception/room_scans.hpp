#pragma once

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "lstm_planner/drive/perception/situation.hpp"
#include "lstm_planner/simulation/hokuyo.hpp"
#include "lstm_planner/simulation/world.hpp"
#include "unit/drive/decision/agent_fixtures.hpp"

namespace lstm_planner::test {

constexpr double kWall = 0.1;  ///< m, how thick the walls of a room are

/// A room from (0, 0) to (width, depth), m, with walls inside of that, and solid boxes in it: lower left, upper right.
inline GridWorld room(double width, double depth, const std::vector<std::pair<Point2, Point2>>& boxes = {}) {
  OccupancyGrid grid = emptyHall(width, depth);
  for (const auto& [low, high] : boxes) fillBox(low.x, low.y, high.x, high.y, &grid);
  return GridWorld(grid);
}

/// A scanner that turns and sees all around, without noise.
inline HokuyoParameters turningScanner(const BeamTimes& times) {
  HokuyoParameters scanner;
  scanner.beams = 360;
  scanner.angle_min = -M_PI;
  scanner.angle_increment = 2.0 * M_PI / 360.0;
  scanner.noise = 0.0;
  scanner.dropout = 0.0;
  scanner.beam_times = times;
  return scanner;
}

/// A scanner with noise, and what it sees from there.
class RoomScanner {
 public:
  explicit RoomScanner(const World& world, std::uint64_t seed = 1, double noise = 0.01)
      : world_(world), parameters_(withNoise(noise)), scanner_(parameters_, seed) {}

  Situation seenFrom(const Pose2& pose, double time = 0.0) {
    LaserScan scan;
    scanner_.scan(world_, pose, time, &scan);
    Situation situation;
    situation.time = time;
    situation.pose = pose;
    perceive(scan, parameters_.mount, Hokuyo::rules(), 6.0, &situation);
    return situation;
  }

 private:
  static HokuyoParameters withNoise(double noise) {
    HokuyoParameters parameters;
    parameters.noise = noise;
    return parameters;
  }

  const World& world_;
  HokuyoParameters parameters_;
  Hokuyo scanner_;
};

}  // namespace lstm_planner::test
