#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "lstm_planner/common/parameter_check.hpp"
#include "lstm_planner/common/random.hpp"
#include "lstm_planner/simulation/world_generators.hpp"
#include "simulation/building.hpp"
#include "simulation/open_areas.hpp"

namespace lstm_planner {
namespace {

constexpr double kClutterWall = 0.1;  // m
constexpr double kBlock = 0.15;       // m, side of what the obstacles consist of
constexpr double kKeptFill = 0.9;     // share of the fill after obstacles are cleared
constexpr double kLeastFill = 0.01;   // below it all of them are cleared

/// Random numbers a block, each averaged with its neighbours up to `grain` blocks away, so that high ones lie together.
class Noise {
 public:
  Noise(int columns, int rows, int grain, Random& random) : values_(rows, columns) {
    for (double& value : values_) value = uniform(random);
    // What lies beyond the edge does not count.
    values_ = sumsAround(values_, grain) / sumsAround(cv::Mat1d::ones(rows, columns), grain);
    sorted_.assign(values_.begin(), values_.end());
    std::sort(sorted_.begin(), sorted_.end());
  }

  double at(int column, int row) const { return values_(row, column); }

  /// What that share of the values exceeds.
  double levelOf(double share) const {
    const auto below = static_cast<std::size_t>((1.0 - share) * static_cast<double>(sorted_.size()));
    return sorted_[std::min(below, sorted_.size() - 1)];
  }

 private:
  static cv::Mat1d sumsAround(const cv::Mat1d& values, int grain) {
    cv::Mat1d sums;
    const int side = 2 * grain + 1;
    cv::boxFilter(values, sums, CV_64F, {side, side}, {-1, -1}, false, cv::BORDER_CONSTANT);
    return sums;
  }

  cv::Mat1d values_;
  std::vector<double> sorted_;
};

/// Where what is, in cells.
struct Plan {
  explicit Plan(const ClutterParameters& p) : parameters(p), wall(std::max(1, cells(kClutterWall))) {
    const int left = cells(p.around) + wall;
    const int bottom = wall + cells(p.bay);
    field = {left, bottom, left + cells(p.width), bottom + cells(p.depth)};
    columns = field.right + left;
    rows = field.top + cells(p.beyond) + wall;
  }

  int cells(double metres) const { return static_cast<int>(std::lround(metres / parameters.resolution)); }

  const ClutterParameters& parameters;
  int wall;
  CellBox field;  ///< with the obstacles
  int columns = 0;
  int rows = 0;
};

OccupancyGrid drawClutter(const Plan& plan, const Noise& noise, double fill) {
  OccupancyGrid grid(plan.columns, plan.rows, plan.parameters.resolution, {}, Cell::kOccupied);
  fillBox({plan.wall, plan.wall, plan.columns - plan.wall, plan.rows - plan.wall}, Cell::kFree, &grid);
  const CellBox& field = plan.field;
  fillBox({field.left - plan.wall, 0, field.left, field.top}, Cell::kOccupied, &grid);
  fillBox({field.right, 0, field.right + plan.wall, field.top}, Cell::kOccupied, &grid);
  const double level = noise.levelOf(fill);
  const double blocks = plan.parameters.resolution / kBlock;
  for (int row = field.bottom; row < field.top; ++row) {
    for (int column = field.left; column < field.right; ++column) {
      const int block_column = static_cast<int>((column - field.left) * blocks);
      const int block_row = static_cast<int>((row - field.bottom) * blocks);
      if (noise.at(block_column, block_row) > level) grid.set({column, row}, Cell::kOccupied);
    }
  }
  return grid;
}

/// Whether the disc that is to get through does.
bool isOpen(const Plan& plan, const OccupancyGrid& grid) {
  cv::Mat1i labels;
  labelOpenAreas(grid, plan.parameters.passage, &labels);
  const int middle = (plan.field.left + plan.field.right) / 2;
  const int start = labels((plan.wall + plan.field.bottom) / 2, middle);
  return start > 0 && start == labels((plan.field.top + plan.rows - plan.wall) / 2, middle);
}

}  // namespace

void validate(const ClutterParameters& parameters) {
  checkRange("passage", parameters.passage, 0.05, 0.5);
  checkRange("width", parameters.width, 2.0, 50.0);
  checkRangeFrom(2.0 * parameters.passage + 0.5, "bay", parameters.bay, 50.0);
  checkRange("depth", parameters.depth, 1.0, 50.0);
  checkRangeFrom(2.0 * parameters.passage + 0.5, "beyond", parameters.beyond, 50.0);
  checkRange("around", parameters.around, 0.0, 50.0);
  checkRange("fill", parameters.fill, 0.0, 0.5);
  checkParameter(parameters.grain >= 0 && parameters.grain <= 10, "grain", parameters.grain, "0 to 10 blocks");
  checkRange("resolution", parameters.resolution, 0.01, kBlock);
}

OccupancyGrid generateClutter(const ClutterParameters& parameters, std::uint64_t seed) {
  validate(parameters);
  Random random(seed);
  const Plan plan(parameters);
  const auto blocks = [&](int cells) {
    return static_cast<int>(std::ceil(cells * parameters.resolution / kBlock)) + 1;
  };
  const Noise noise(blocks(plan.field.width()), blocks(plan.field.height()), parameters.grain, random);
  double fill = parameters.fill;
  OccupancyGrid grid = drawClutter(plan, noise, fill);
  while (fill > kLeastFill && !isOpen(plan, grid)) {
    fill *= kKeptFill;
    grid = drawClutter(plan, noise, fill);
  }
  return fill > kLeastFill ? grid : drawClutter(plan, noise, 0.0);
}

}  // namespace lstm_planner
