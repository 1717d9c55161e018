#include <algorithm>
#include <cmath>
#include <vector>

#include "lstm_planner/common/random.hpp"
#include "lstm_planner/simulation/generated_world.hpp"
#include "lstm_planner/simulation/world.hpp"
#include "simulation/building.hpp"

namespace lstm_planner {
namespace {

constexpr double kForestWall = 0.1;  // m
constexpr double kEnds = 1.2;        // m at both ends without poles, for starts and goals
constexpr int kTriesAPole = 30;
constexpr std::size_t kFelledAtOnce = 20;  // 1 of so many

class Forester {
 public:
  Forester(const ForestParameters& parameters, Random& random) : parameters_(parameters), random_(random) {}

  std::vector<Circle> plant() {
    std::vector<Circle> poles;
    const double floor = (parameters_.width - 2.0 * kEnds) * parameters_.height;
    double covered = 0.0;
    int failures = 0;
    while (covered < parameters_.density * floor && failures < kTriesAPole) {
      const double radius = uniform(random_, parameters_.smallest_radius, parameters_.largest_radius);
      const Circle pole{{uniform(random_, kEnds, parameters_.width - kEnds),
                         uniform(random_, kForestWall + radius, parameters_.height - kForestWall - radius)},
                        radius};
      if (!fits(pole, poles)) {
        ++failures;
        continue;
      }
      failures = 0;
      poles.push_back(pole);
      covered += M_PI * radius * radius;
    }
    return poles;
  }

  OccupancyGrid draw(const std::vector<Circle>& poles) const {
    const double resolution = parameters_.resolution;
    OccupancyGrid grid(toCells(parameters_.width, resolution), toCells(parameters_.height, resolution), resolution, {},
                       Cell::kOccupied);
    const int wall = toCells(kForestWall, resolution);
    fillBox({wall, wall, grid.columns() - wall, grid.rows() - wall}, Cell::kFree, &grid);
    for (const Circle& pole : poles) draw(pole, &grid);
    return grid;
  }

  /// Whether the disc that is to get through does.
  bool isOpen(const OccupancyGrid& grid) const {
    cv::Mat1i labels;
    labelOpenAreas(grid, parameters_.passage, &labels);
    const int left = static_cast<int>(0.5 * kEnds / parameters_.resolution);
    const int right = grid.columns() - 1 - left;
    const int middle = grid.rows() / 2;
    return labels(middle, left) > 0 && labels(middle, left) == labels(middle, right);
  }

 private:
  bool fits(const Circle& pole, const std::vector<Circle>& others) const {
    if (parameters_.gap <= 0.0) return true;
    const double low = std::min(pole.center.y, parameters_.height - pole.center.y) - kForestWall - pole.radius;
    // Flush with the wall, or far enough away from it to be passed.
    if (low < parameters_.gap && low > parameters_.resolution) return false;
    return std::none_of(others.begin(), others.end(), [&](const Circle& other) {
      return distanceBetween(pole.center, other.center) < pole.radius + other.radius + parameters_.gap;
    });
  }

  static void draw(const Circle& pole, OccupancyGrid* grid) {
    const CellIndex low = grid->cellAt({pole.center.x - pole.radius, pole.center.y - pole.radius});
    const CellIndex high = grid->cellAt({pole.center.x + pole.radius, pole.center.y + pole.radius});
    // A pole thinner than a cell is one cell.
    grid->set(grid->cellAt(pole.center), Cell::kOccupied);
    for (int row = low.row; row <= high.row; ++row) {
      for (int column = low.column; column <= high.column; ++column) {
        if (!grid->contains({column, row})) continue;
        const Point2 center = grid->centerOf({column, row});
        const double dx = center.x - pole.center.x;
        const double dy = center.y - pole.center.y;
        if (dx * dx + dy * dy <= pole.radius * pole.radius) grid->set({column, row}, Cell::kOccupied);
      }
    }
  }

  const ForestParameters& parameters_;
  Random& random_;
};

}  // namespace

OccupancyGrid generateForest(const ForestParameters& parameters, std::uint64_t seed) {
  Random random(seed);
  Forester forester(parameters, random);
  std::vector<Circle> poles = forester.plant();
  OccupancyGrid grid = forester.draw(poles);
  while (!poles.empty() && !forester.isOpen(grid)) {
    poles.resize(poles.size() - std::max<std::size_t>(1, poles.size() / kFelledAtOnce));
    grid = forester.draw(poles);
  }
  return grid;
}

}  // namespace lstm_planner
