#include "unit/drive/decision/agent_fixtures.hpp"

#include <cmath>
#include <string>

namespace lstm_planner::test {

LayerStack layersPreferring(const std::vector<float>& preferences) {
  const auto inputs = static_cast<Eigen::Index>(EncoderParameters().input_layout.size());
  // h' = tanh(h / 2 + 0.1) grows from step to step.
  RecurrentLayer memory;
  memory.input = Eigen::MatrixXf::Zero(1, inputs);
  memory.recurrent = Eigen::MatrixXf::Constant(1, 1, 0.5f);
  memory.bias = Eigen::VectorXf::Constant(1, 0.1f);
  DenseLayer output;
  const auto outputs = static_cast<Eigen::Index>(preferences.size());
  output.weights = Eigen::MatrixXf::Zero(outputs, 1);
  output.bias = Eigen::Map<const Eigen::VectorXf>(preferences.data(), outputs);
  return {memory, output};
}

DrivePolicy policyPreferring(const std::vector<float>& preferences) {
  return DrivePolicy(PolicyDescription(), layersPreferring(preferences));
}

AgentParameters routeLed() {
  AgentParameters parameters;
  parameters.leader = Leader::kRoute;
  return parameters;
}

DrivePolicy straightAheadPolicy() { return policyPreferring({0.0f, 1.0f, 2.0f, 1.0f, 0.0f}); }

Situation situationAt(const Pose2& pose, double time, const std::vector<Point2>& obstacles) {
  Situation situation;
  situation.time = time;
  situation.pose = pose;
  situation.sectors.range.fill(6.0);
  situation.obstacles = obstacles;
  return situation;
}

std::vector<Point2> wall(const Point2& begin, const Point2& end) {
  std::vector<Point2> points;
  const int count = static_cast<int>(std::ceil(distanceBetween(begin, end) / 0.01));
  for (int i = 0; i <= count; ++i) {
    const double share = static_cast<double>(i) / count;
    points.push_back({begin.x + share * (end.x - begin.x), begin.y + share * (end.y - begin.y)});
  }
  return points;
}

std::vector<Point2> ring(double radius) {
  std::vector<Point2> points;
  for (int i = 0; i < 360; ++i) {
    points.push_back(pointAlong(Point2{}, degreesToRadians(i), radius));
  }
  return points;
}

OccupancyGrid emptyHall(double width, double height, double resolution) {
  OccupancyGrid grid(static_cast<int>(std::lround(width / resolution)),
                     static_cast<int>(std::lround(height / resolution)), resolution);
  fillBox(0.0, 0.0, width, 0.1, &grid);
  fillBox(0.0, height - 0.1, width, height, &grid);
  fillBox(0.0, 0.0, 0.1, height, &grid);
  fillBox(width - 0.1, 0.0, width, height, &grid);
  return grid;
}

void fillBox(double left, double bottom, double right, double top, OccupancyGrid* grid) {
  for (int row = 0; row < grid->rows(); ++row) {
    for (int column = 0; column < grid->columns(); ++column) {
      const Point2 center = grid->centerOf({column, row});
      if (center.x > left && center.x < right && center.y > bottom && center.y < top) {
        grid->set({column, row}, Cell::kOccupied);
      }
    }
  }
}

OccupancyGrid spiral() {
  // clang-format off
  const std::vector<std::string> rows = {
      "##################",
      "#................#",
      "#................#",
      "#..############..#",
      "#..#..........#..#",
      "#..#..........#..#",
      "#..#..######..#..#",
      "#..#..#....#..#..#",
      "#..#..#....#..#..#",
      "#..#..#..###..#..#",
      "#..#..#.......#..#",
      "#..#..#.......#..#",
      "#..#..#########..#",
      "#..#.............#",
      "#..#.............#",
      "##################",
  };
  // clang-format on
  OccupancyGrid grid(static_cast<int>(rows.front().size()), static_cast<int>(rows.size()), 0.4);
  for (int row = 0; row < grid.rows(); ++row) {
    const std::string& cells = rows[rows.size() - 1 - static_cast<std::size_t>(row)];
    for (int column = 0; column < grid.columns(); ++column) {
      grid.set({column, row}, cells[static_cast<std::size_t>(column)] == '#' ? Cell::kOccupied : Cell::kFree);
    }
  }
  return grid;
}

DriveParameters quickDrive(double time_limit) {
  DriveParameters parameters;
  parameters.robot.scanner.beams = 361;
  parameters.robot.scanner.angle_increment = 2.0 * 2.35619 / 360.0;
  parameters.time_limit = time_limit;
  return parameters;
}

}  // namespace lstm_planner::test
