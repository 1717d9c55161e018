#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "lstm_planner/grid/map_server_map.hpp"
#include "lstm_planner/simulation/drive.hpp"

namespace lstm_planner {

/// Path of a file among the recordings and maps of real robots and buildings; they do not come with the package.
inline std::string realData(const std::string& file) {
  const char* shared = std::getenv("LSTM_PLANNER_SHARED");
  return (shared != nullptr ? std::string(shared) : std::string(LSTM_PLANNER_SOURCE_DIR) + "/../shared") + "/data/" +
         file;
}

/// Ends a test as skipped where such a file or folder is missing.
#define SKIP_WITHOUT_REAL_DATA(path)   \
  if (std::filesystem::exists(path)) { \
  } else                               \
    GTEST_SKIP() << "needs data of real places: " << (path)

/// Willow Garage. Its surroundings and what was never seen are of the grey 206, which its own threshold takes for free.
inline std::string willowMap() { return realData("maps/stage_ros_willow-full.yaml"); }
constexpr double kWillowFreeThreshold = 0.19;

inline std::string shippedModel() { return std::string(LSTM_PLANNER_SOURCE_DIR) + "/models/create2_lstm.onnx"; }

/// The first `count` random tasks whose shortest paths are between `shortest` and `longest` metres long.
inline std::vector<DriveTask> drawTasksBetween(const GridWorld& world, int count, double shortest, double longest) {
  constexpr int kDrawn = 60;  // about one in eight pairs of places in Willow is less than 15 m apart
  constexpr double kClearance = 0.07;
  std::vector<DriveTask> tasks;
  for (const DriveTask& task :
       drawTasks(world, kDrawn, 0.5 * Create2Parameters().base_diameter, kClearance, shortest, 1)) {
    if (task.shortest <= longest && static_cast<int>(tasks.size()) < count) {
      tasks.push_back(task);
    }
  }
  return tasks;
}

}  // namespace lstm_planner
