#include <algorithm>
#include <cmath>
#include <cstdio>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <vector>

#include "lstm_planner/common/canvas.hpp"
#include "lstm_planner/common/picture_file.hpp"
#include "lstm_planner/simulation/trace_picture.hpp"
#include "lstm_planner/training/policy_gradient.hpp"
#include "tools/drive_report.hpp"

namespace lstm_planner {
namespace {

constexpr double kMargin = 0.5;          // m around what is drawn
constexpr double kBackground = 0.05;     // m a cell where there is no map
constexpr std::size_t kMostMisses = 40;  // pictures
constexpr int kLongestSide = 1200;       // pixels

struct Drive {
  const DriveWorld& world;
  const NumberedDrive& exercise;
  const DriveResult& result;
};

bool wentWell(const Drive& drive) {
  return drive.result.end == DriveResult::End::kReached && drive.result.contacts == 0;
}

/// The ratio to the shortest path; of what is not known, the length.
double detour(const Drive& drive) {
  return drive.result.shortest > 0.0 ? drive.result.path_length / drive.result.shortest : drive.result.path_length;
}

/// A map without the unknown surroundings of the building.
OccupancyGrid knownPart(const OccupancyGrid& map) {
  CellIndex low{map.columns(), map.rows()};
  CellIndex high{-1, -1};
  for (int row = 0; row < map.rows(); ++row) {
    for (int column = 0; column < map.columns(); ++column) {
      if (map.at({column, row}) == Cell::kUnknown) continue;
      low = {std::min(low.column, column), std::min(low.row, row)};
      high = {std::max(high.column, column), std::max(high.row, row)};
    }
  }
  if (high.column < 0) return map;
  const Point2 corner = toParentFrame(map.origin(), {low.column * map.resolution(), low.row * map.resolution()});
  OccupancyGrid part(high.column - low.column + 1, high.row - low.row + 1, map.resolution(),
                     {corner.x, corner.y, map.origin().yaw});
  for (int row = 0; row < part.rows(); ++row) {
    for (int column = 0; column < part.columns(); ++column) {
      part.set({column, row}, map.at({low.column + column, low.row + row}));
    }
  }
  return part;
}

/// An empty floor under circles and places.
OccupancyGrid floorUnder(const std::vector<Circle>& circles, const std::vector<Point2>& places) {
  Point2 low = places.front();
  Point2 high = low;
  const auto include = [&](const Point2& place) {
    low = {std::min(low.x, place.x), std::min(low.y, place.y)};
    high = {std::max(high.x, place.x), std::max(high.y, place.y)};
  };
  for (const Circle& circle : circles) include(circle.center);
  for (const Point2& place : places) include(place);
  const auto cells = [](double from, double to) {
    return static_cast<int>((to - from + 2.0 * kMargin) / kBackground) + 1;
  };
  return OccupancyGrid(cells(low.x, high.x), cells(low.y, high.y), kBackground,
                       {low.x - kMargin, low.y - kMargin, 0.0});
}

std::string titleOf(const Drive& drive) {
  const DriveResult& result = drive.result;
  char text[200];
  std::snprintf(text, sizeof(text), "%s: %s after %.1f s, %.1f m", drive.exercise.name.c_str(), toString(result.end),
                result.time, result.path_length);
  std::string title = text;
  if (result.shortest > 0.0) {
    std::snprintf(text, sizeof(text), " (shortest %.1f m)", result.shortest);
    title += text;
  }
  if (result.contacts > 0) title += ", contacts: " + std::to_string(result.contacts);
  if (result.bumped > 0) title += ", bumped: " + std::to_string(result.bumped);
  return title;
}

void draw(const std::string& path, const DriveCourse& course, const Drive& drive) {
  TracePicture picture;
  picture.robot_radius = footprintOf(course.rules.robot.base).circumscribedRadius();
  picture.title = titleOf(drive);
  picture.legend = true;
  picture.starts = {drive.exercise.task.start};
  picture.goals = {{drive.exercise.task.goal, "", drive.result.end == DriveResult::End::kReached}};
  picture.traces.emplace_back();
  for (std::size_t i = 0; i < drive.result.trace.size(); ++i) {
    const Point2 here{drive.result.trace[i].x, drive.result.trace[i].y};
    picture.traces.back().push_back(here);
    goOn(here, drive.result.led[i], drive.result.on_path[i] != 0, &picture.parts);
  }
  picture.contacts = drive.result.contact_places;
  picture.circles = drive.world.circles;
  picture.walkers = drive.result.walker_traces;
  writeTracePicture(path, floorOf(drive.world, drive.exercise.task, drive.result.trace), picture, kLongestSide);
}

constexpr int kTextHeight = 28;  // pixels
constexpr int kPreferenceRow = 22;
constexpr int kCellsHeight = 400;
constexpr int kLargestCellRow = 6;

/// White at 0, red upwards, blue downwards; `value` in [-1, 1].
cv::Vec3b colorOf(float value) {
  const float size = std::min(1.0f, std::abs(value));
  const auto pale = static_cast<unsigned char>(255.0f * (1.0f - size));
  const auto full = static_cast<unsigned char>(255.0f - 25.0f * size);
  return value >= 0.0f ? cv::Vec3b(pale, pale, full) : cv::Vec3b(full, pale, pale);
}

std::vector<float> probabilities(const std::vector<float>& preferences) {
  std::vector<float> shares(preferences.size());
  const float sum = fillChances(
      static_cast<int>(shares.size()), [](int) { return true; },
      [&](int action) { return preferences[static_cast<std::size_t>(action)]; }, shares.data());
  for (float& share : shares) share /= sum;
  return shares;
}

/// A row a value, a column a step, each row so many pixels high; the first row is the uppermost.
template <typename ValueOf>
cv::Mat heatmap(int rows, int steps, int row_height, int width, const ValueOf& value_of) {
  cv::Mat small(rows, steps, CV_8UC3);
  for (int row = 0; row < rows; ++row) {
    for (int step = 0; step < steps; ++step) small.at<cv::Vec3b>(row, step) = colorOf(value_of(row, step));
  }
  cv::Mat large;
  cv::resize(small, large, {width, rows * row_height}, 0.0, 0.0, cv::INTER_NEAREST);
  return large;
}

cv::Mat line(const std::string& text, int width) {
  cv::Mat strip(kTextHeight, width, CV_8UC3, cv::Scalar(255, 255, 255));
  writeText(text, {8, kTextHeight - 9}, 0.5, cv::Scalar(0, 0, 0), 1, &strip);
  return strip;
}

}  // namespace

OccupancyGrid floorOf(const DriveWorld& world, const DriveTask& task, const std::vector<Pose2>& trace) {
  if (world.map != nullptr) return knownPart(*world.map);
  std::vector<Point2> places = {task.goal, {task.start.x, task.start.y}};
  for (const Pose2& pose : trace) places.push_back({pose.x, pose.y});
  return floorUnder(world.circles, places);
}

void drawDrives(const std::string& folder, const DriveCourse& course, const DriveResults& results) {
  std::vector<Drive> good;
  std::size_t misses = 0;
  const auto nameOf = [&](const std::string& what, const Drive& drive) {
    return folder + "/" + what + "_" + drive.exercise.name + ".png";
  };
  for (std::size_t i = 0; i < course.worlds.size(); ++i) {
    for (std::size_t k = 0; k < results[i].size(); ++k) {
      const Drive drive{course.worlds[i], course.worlds[i].exercises[k], results[i][k]};
      if (wentWell(drive)) {
        good.push_back(drive);
      } else if (misses++ < kMostMisses) {
        draw(nameOf(drive.result.contacts > 0 ? "contact" : "missed", drive), course, drive);
      }
    }
  }
  if (good.empty()) return;
  std::vector<const Drive*> order;
  for (const Drive& drive : good) order.push_back(&drive);
  std::stable_sort(order.begin(), order.end(), [](const Drive* a, const Drive* b) { return detour(*a) < detour(*b); });
  draw(nameOf("best", *order.front()), course, *order.front());
  draw(nameOf("median", *order[order.size() / 2]), course, *order[order.size() / 2]);
  draw(nameOf("worst", *order.back()), course, *order.back());
}

void drawDrive(const std::string& file, const DriveCourse& course, const DriveResults& results) {
  for (std::size_t i = 0; i < course.worlds.size(); ++i) {
    if (results[i].empty()) continue;
    return draw(file, course, {course.worlds[i], course.worlds[i].exercises.front(), results[i].front()});
  }
  throw std::invalid_argument("there is no drive to draw");
}

void DriveStates::watch(NavigationAgent* agent) {
  agent->setStepListener([this, agent](const Situation&, const Observation&) -> std::optional<int> {
    steps_.push_back({agent->decision().preferences, agent->policy().hiddenState()});
    return std::nullopt;
  });
}

void DriveStates::drawBelow(const std::string& path) const {
  if (steps_.empty()) throw std::invalid_argument("no step of the drive was noted");
  const cv::Mat drive = readPicture(path);
  const int steps = static_cast<int>(steps_.size());
  const int actions = static_cast<int>(steps_.front().preferences.size());
  const int cells = static_cast<int>(steps_.front().hidden.size());
  std::vector<std::vector<float>> shares;
  for (const Step& step : steps_) shares.push_back(probabilities(step.preferences));
  const cv::Mat preferences = heatmap(actions, steps, kPreferenceRow, drive.cols, [&](int row, int step) {
    return shares[static_cast<std::size_t>(step)][static_cast<std::size_t>(actions - 1 - row)];
  });
  std::vector<cv::Mat> parts{
      drive, line("preferences, step by step: leftmost angle above, rightmost below", drive.cols), preferences};
  if (cells > 0) {  // perceptrons have none
    const int cell_row = std::clamp(kCellsHeight / cells, 1, kLargestCellRow);
    parts.push_back(line("hidden state: red positive, blue negative, a row a cell", drive.cols));
    parts.push_back(heatmap(cells, steps, cell_row, drive.cols, [&](int row, int step) {
      return std::tanh(steps_[static_cast<std::size_t>(step)].hidden[row]);
    }));
  }
  cv::Mat all;
  cv::vconcat(parts, all);
  writePicture(path, all);
}

}  // namespace lstm_planner
