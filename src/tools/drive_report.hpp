#pragma once

#include <Eigen/Core>
#include <iosfwd>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "lstm_planner/drive/decision/navigation_agent.hpp"
#include "lstm_planner/simulation/drive.hpp"
#include "tools/drive_options.hpp"
#include "tools/drive_worlds.hpp"

namespace lstm_planner {

/// By world, by exercise.
using DriveResults = std::vector<std::vector<DriveResult>>;

/// "reached", "timeout", "no path", "elsewhere".
const char* toString(DriveResult::End end);

/// For people: a line a world where there are not too many, and one for all.
void printDriveSummary(std::ostream& out, const DriveOptions& options, const DriveCourse& course,
                       const DriveResults& results);

nlohmann::json driveJson(const DriveOptions& options, const DriveCourse& course, const DriveResults& results);

/// A line a goal.
std::string driveCsv(const DriveCourse& course, const DriveResults& results);

/// The part of a world that a picture of a drive shows: what is known of the map, or an empty floor under all circles
/// and the drive.
OccupancyGrid floorOf(const DriveWorld& world, const DriveTask& task, const std::vector<Pose2>& trace = {});

/// Draws the drives that went wrong and, by path / shortest, the worst, the middle and the best of the others.
void drawDrives(const std::string& folder, const DriveCourse& course, const DriveResults& results);

/// Draws the one drive that there is.
void drawDrive(const std::string& file, const DriveCourse& course, const DriveResults& results);

/// What went on in the network during a drive.
class DriveStates {
 public:
  /// Notes each step of the agent from now on; both must outlive the drive.
  void watch(NavigationAgent* agent);

  /// Below the picture in the file `path`, which is replaced: a column a step, with the preferences among the steering
  /// angles as probabilities and the outputs of all recurrent cells, if there are any. Throws std::runtime_error when
  /// the file cannot be read or written, std::invalid_argument when nothing was noted.
  void drawBelow(const std::string& path) const;

 private:
  struct Step {
    std::vector<float> preferences;
    Eigen::VectorXf hidden;
  };
  std::vector<Step> steps_;
};

}  // namespace lstm_planner
