#include "simulation/open_areas.hpp"

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "lstm_planner/grid/distance_field.hpp"

namespace lstm_planner {

int labelOpenAreas(const OccupancyGrid& grid, double radius, cv::Mat1i* labels) {
  constexpr int kSides = 4;
  const DistanceField distances(grid, true);
  // Half a diagonal: the distance joins the centres of cells, and the obstacle starts at the edge of its own.
  const double clearance = radius + grid.resolution() * M_SQRT1_2;
  cv::Mat1b fits(grid.rows(), grid.columns());
  for (int row = 0; row < grid.rows(); ++row) {
    for (int column = 0; column < grid.columns(); ++column) {
      fits(row, column) = distances.at({column, row}) >= clearance ? 1 : 0;
    }
  }
  return cv::connectedComponents(fits, *labels, kSides, CV_32S) - 1;
}

}  // namespace lstm_planner
