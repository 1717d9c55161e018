#include "lstm_planner/practice/recorded_drives.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "lstm_planner/common/parameter_check.hpp"
#include "lstm_planner/common/text_table.hpp"
#include "lstm_planner/dataset/drive_recorder.hpp"
#include "lstm_planner/simulation/standing_cells.hpp"

namespace lstm_planner {
namespace {

const char* const kMapFrame = "map";
constexpr double kPeriod = 0.1;  ///< s between odometry messages, scans, commands; with more the driver brakes too late
constexpr double kScanOffset = 0.04;  ///< s from an odometry message to the scan after it
constexpr double kTimeLimit = 300.0;  ///< s for a goal, after which the driver turns to the next
constexpr int kMostFutileGoals = 20;  // in a row without a step

/// Passes steps on, as many as are wanted (0: all), and counts them.
class CountingSink : public StepSink {
 public:
  CountingSink(StepSink* sink, long wanted) : sink_(sink), wanted_(wanted) {}
  void startEpisode(const Episode& episode) override { sink_->startEpisode(episode); }
  void addStep(const DriveStep& step) override {
    if (isFull()) return;
    sink_->addStep(step);
    ++steps;
  }
  void endEpisode(double stamp, EpisodeEnd end) override { sink_->endEpisode(stamp, end); }
  void reject(Rejection rejection) override { sink_->reject(rejection); }

  bool isFull() const { return wanted_ > 0 && steps >= wanted_; }

  long steps = 0;

 private:
  StepSink* sink_;
  long wanted_;
};

/// At that place, in a random direction. Draws one after the other, as compilers differ in the order of arguments.
SimulatedRobot robotAt(const GridWorld& world, const SimulatedRobot::Parameters& parameters, const Point2& place,
                       Random* random) {
  const std::uint64_t seed = (*random)();
  return SimulatedRobot(world, parameters, {place.x, place.y, uniform(*random, -M_PI, M_PI)}, seed);
}

class DriveRecording {
 public:
  DriveRecording(const GridWorld& world, const std::vector<Point2>& waypoints,
                 const RecordedDrivesParameters& parameters, std::uint64_t seed, StepSink* sink)
      : waypoints_(waypoints),
        parameters_(parameters),
        random_(seed),
        robot_(robotAt(world, parameters.robot, waypoints.front(), &random_)),
        driver_(world, parameters.driver, random_()),
        sink_(sink, parameters.steps),
        recorder_(parameters.recorder, &sink_,
                  [this](const std::string&, double stamp) { return std::optional<Pose2>(mapAt(stamp)); }) {}

  RecordedDrives run() {
    int futile = 0;
    while (goesOn()) {
      const long steps = sink_.steps;
      driveTo(chooseGoal());
      futile = sink_.steps > steps ? 0 : futile + 1;
      if (futile == kMostFutileGoals) throw std::invalid_argument("there is no path between the waypoints");
    }
    recorder_.finish();
    result_.steps = sink_.steps;
    result_.contacts = robot_.contacts();
    result_.time = robot_.time();
    result_.path_length = robot_.pathLength();
    return result_;
  }

 private:
  bool goesOn() const { return !sink_.isFull() && (parameters_.goals == 0 || result_.goals < parameters_.goals); }

  /// Any waypoint but the one that the robot is at.
  std::size_t chooseGoal() {
    const std::size_t chosen = uniformIndex(random_, waypoints_.size() - 1);
    return chosen < here_ ? chosen : chosen + 1;
  }

  void driveTo(std::size_t chosen) {
    ++result_.goals;
    const Point2 goal = waypoints_[chosen];
    recorder_.add(GoalHeard{robot_.time(), {kMapFrame, {goal.x, goal.y, 0.0}}, "waypoints"});
    driver_.setGoal(goal);
    const double start = robot_.time();
    while (driver_.state() == ScriptedDriver::State::kDriving && !sink_.isFull()) {
      if (robot_.time() - start > kTimeLimit) break;
      drive();
    }
    result_.no_path += driver_.state() == ScriptedDriver::State::kNoPath ? 1 : 0;
    if (driver_.state() == ScriptedDriver::State::kArrived) {
      ++result_.reached;
      here_ = chosen;
    } else {
      recorder_.add(GoalGivenUp{robot_.time()});
    }
  }

  /// Where the map's origin is in the odometry frame.
  Pose2 mapAt(double stamp) {
    while (maps_.size() > 1 && maps_[1].first <= stamp) maps_.pop_front();
    return maps_.front().second;
  }

  void rememberMap() { maps_.push_back({robot_.time(), compose(robot_.odometry(), inverse(robot_.truePose()))}); }

  void drive() {
    rememberMap();
    recorder_.add(OdometryHeard{robot_.time(), robot_.odometry(), robot_.measuredTwist()});
    robot_.command(driver_.command(robot_.truePose(), robot_.time()));
    robot_.advance(kScanOffset);
    robot_.scan(&scan_);
    recorder_.add(ScanHeard{scan_.stamp, scan_, parameters_.robot.scanner.mount, "laser"});
    robot_.advance(kPeriod - kScanOffset);
  }

  const std::vector<Point2>& waypoints_;
  const RecordedDrivesParameters& parameters_;
  Random random_;
  SimulatedRobot robot_;
  ScriptedDriver driver_;
  CountingSink sink_;
  DriveRecorder recorder_;
  LaserScan scan_;
  std::deque<std::pair<double, Pose2>> maps_;  ///< stamp (s), and the map's origin in the odometry frame then
  std::size_t here_ = 0;
  RecordedDrives result_;
};

/// The part of the free places in which most of them can reach each other.
std::vector<CellIndex> connectedPlaces(const GridWorld& world, double radius, Random* random) {
  const OccupancyGrid& grid = world.grid();
  const DistanceField distances(grid, true);
  GeodesicField::Options options;
  options.clearance = distanceNeeded(radius, grid);
  std::vector<CellIndex> left = standingCells(grid, distances, options.clearance);
  std::vector<CellIndex> largest;
  while (left.size() > largest.size()) {
    const GeodesicField field(grid, distances, left[uniformIndex(*random, left.size())], options);
    const auto split =
        std::stable_partition(left.begin(), left.end(), [&](CellIndex cell) { return std::isfinite(field.at(cell)); });
    std::vector<CellIndex> part(left.begin(), split);
    left.erase(left.begin(), split);
    if (part.size() > largest.size()) largest = std::move(part);
  }
  return largest;
}

}  // namespace

std::vector<Point2> drawWaypoints(const GridWorld& world, int count, double radius, double spacing,
                                  std::uint64_t seed) {
  Random random(seed);
  std::vector<CellIndex> places = connectedPlaces(world, radius, &random);
  if (count < 1 || places.size() < static_cast<std::size_t>(count)) {
    throw std::invalid_argument("the map has " + std::to_string(places.size()) +
                                " connected places for a disc of radius " + numberText(radius) +
                                " m, expected at least " + std::to_string(count) + " (one waypoint or more)");
  }
  shuffle(&places, random);
  std::vector<Point2> chosen;
  std::vector<Point2> too_near;
  for (const CellIndex place : places) {
    const Point2 point = world.grid().centerOf(place);
    const bool apart = std::all_of(chosen.begin(), chosen.end(),
                                   [&](const Point2& other) { return distanceBetween(point, other) >= spacing; });
    (apart ? chosen : too_near).push_back(point);
    if (chosen.size() == static_cast<std::size_t>(count)) return chosen;
  }
  chosen.insert(chosen.end(), too_near.begin(), too_near.begin() + (count - static_cast<long>(chosen.size())));
  return chosen;
}

void validate(const RecordedDrivesParameters& parameters) {
  validate(parameters.driver);
  validate(parameters.recorder);
  checkNotNegative("steps", static_cast<double>(parameters.steps));
  checkNotNegative("goals", static_cast<double>(parameters.goals));
  checkParameter(parameters.steps > 0 || parameters.goals > 0, "goals", static_cast<double>(parameters.goals),
                 "a positive number where steps is 0");
}

RecordedDrives recordDrives(const GridWorld& world, const std::vector<Point2>& waypoints,
                            const RecordedDrivesParameters& parameters, std::uint64_t seed, StepSink* sink) {
  validate(parameters);
  if (waypoints.size() < 2) {
    throw std::invalid_argument("there are " + std::to_string(waypoints.size()) +
                                " waypoints, expected at least two to drive between");
  }
  return DriveRecording(world, waypoints, parameters, seed, sink).run();
}

}  // namespace lstm_planner
