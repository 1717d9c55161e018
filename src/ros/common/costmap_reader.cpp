#include "ros/common/costmap_reader.hpp"

#include <ros/console.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "lstm_planner/common/segment.hpp"
#include "lstm_planner/drive/perception/costmap_obstacles.hpp"
#include "lstm_planner/ros/common/conversions.hpp"

namespace lstm_planner {

namespace {

constexpr double kCostmapLogPeriod = 10.0;  // s
constexpr double kNear = 1.0;               // m, of what is worth a line

/// m from the origin to the nearest side of the footprint, as inflation has it; 0 for none.
double inscribedRadius(const std::vector<geometry_msgs::Point>& footprint) {
  double squared = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < footprint.size(); ++i) {
    const geometry_msgs::Point& from = footprint[i];
    const geometry_msgs::Point& to = footprint[(i + 1) % footprint.size()];
    squared = std::min(squared, squaredDistanceToSegment({0.0, 0.0}, {from.x, from.y}, {to.x, to.y}));
  }
  return std::isfinite(squared) ? std::sqrt(squared) : 0.0;
}

}  // namespace

std::unique_lock<costmap_2d::Costmap2D::mutex_t> lockOf(costmap_2d::Costmap2DROS* costmap) {
  using Lock = std::unique_lock<costmap_2d::Costmap2D::mutex_t>;
  return costmap == nullptr ? Lock() : Lock(*costmap->getCostmap()->getMutex());
}

std::string CostmapReader::frame() const { return frameName(costmap_->getGlobalFrameID()); }

const std::vector<Point2>& CostmapReader::read(const Pose2& base, const std::vector<Point2>& returns) {
  const auto lock = lockOf(costmap_);
  const costmap_2d::Costmap2D& costmap = *costmap_->getCostmap();
  CostGrid grid;
  grid.costs = costmap.getCharMap();
  grid.columns = static_cast<int>(costmap.getSizeInCellsX());
  grid.rows = static_cast<int>(costmap.getSizeInCellsY());
  grid.resolution = costmap.getResolution();
  grid.origin = {costmap.getOriginX(), costmap.getOriginY()};
  grid.inscribed_radius = inscribedRadius(costmap_->getRobotFootprint());
  obstacles_ = costmapObstacles(grid, base, returns, reach_);
  sayWhatIsNear();
  return obstacles_;
}

void CostmapReader::sayWhatIsNear() const {
  double nearest = kNear;
  for (const Point2& place : obstacles_) nearest = std::min(nearest, std::hypot(place.x, place.y));
  if (nearest < kNear) {
    ROS_INFO_THROTTLE(kCostmapLogPeriod,
                      "the costmap has an obstacle %.2f m from the robot's middle that the scan does not show",
                      nearest);
  }
}

}  // namespace lstm_planner
