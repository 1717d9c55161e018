#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "lstm_planner/drive/local_map/local_map.hpp"
#include "lstm_planner/drive/local_map/replanner.hpp"
#include "lstm_planner/drive/local_map/route_finder.hpp"
#include "lstm_planner/drive/perception/situation.hpp"
#include "lstm_planner/simulation/hokuyo.hpp"
#include "lstm_planner/simulation/world.hpp"

namespace lstm_planner::test {

/// What a scanner without noise sees from there: 270 degrees, blind behind.
inline Situation seenFrom(const World& world, const Pose2& pose, double time = 0.0) {
  HokuyoParameters parameters;
  parameters.noise = 0.0;
  parameters.dropout = 0.0;
  parameters.mount.pose = {};
  Hokuyo scanner(parameters, 1);
  LaserScan scan;
  scanner.scan(world, pose, time, &scan);
  Situation situation;
  situation.time = time;
  situation.pose = pose;
  perceive(scan, parameters.mount, {}, 6.0, &situation);
  return situation;
}

/// Returns at these places of the odometry frame, and nothing known of what is free.
inline Situation returnsAt(const std::vector<Point2>& places, const Pose2& pose = {}) {
  Situation situation;
  situation.pose = pose;
  situation.sectors.range.fill(6.0);
  for (const Point2& place : places) {
    situation.obstacles.push_back(toLocalFrame(pose, place));
  }
  return situation;
}

/// Cost of a route under what is remembered now, m; +inf where it is blocked.
inline double costOf(const Route& route, const RouteFinder& finder, LocalMap* memory) {
  double cost = 0.0;
  for (std::size_t i = 1; i < route.points.size(); ++i) {
    cost += finder.costOf(*memory, route.points[i - 1], route.points[i]);
  }
  return cost;
}

/// A route guide and the goal that it leads to.
class GuideFixture : public ::testing::Test {
 protected:
  void start(const Point2& goal) {
    goal_ = goal;
    guide_.start();
  }
  void moveGoal(const Point2& goal) {
    guide_.moveGoal(goal_, goal);
    goal_ = goal;
  }
  Replanner::Answer update(const Situation& situation) { return guide_.update(situation, goal_, tolerance_); }

  Replanner guide_{MemoryParameters(), ShieldParameters()};
  double tolerance_ = AgentParameters().goal_tolerance;  ///< m

 private:
  Point2 goal_;
};

}  // namespace lstm_planner::test
