#pragma once

#include <cstdint>
#include <vector>

#include "lstm_planner/common/footprint.hpp"
#include "lstm_planner/common/geometry.hpp"
#include "lstm_planner/grid/distance_field.hpp"
#include "lstm_planner/grid/occupancy_grid.hpp"

namespace lstm_planner {

/// What a laser sees and a robot can touch. Thread safe to read.
class World {
 public:
  virtual ~World() = default;

  /// Distances from `origin` to the first obstacle along the directions first_direction + i * increment (rad, world
  /// frame), i = 0 .. ranges->size() - 1; distances beyond max_range (m) are +inf. 0 inside an obstacle.
  virtual void castRays(const Point2& origin, double first_direction, double increment, double max_range,
                        std::vector<double>* ranges) const = 0;

  /// Whether a disc of that radius (m) overlaps an obstacle. Exact: cells are squares, circles are circles, and a disc
  /// that only meets an obstacle at a point does not overlap. Throws std::invalid_argument for a disc that is not
  /// finite.
  virtual bool touches(const Point2& center, double radius) const = 0;

  /// The same for a footprint at a pose. Throws std::invalid_argument for a pose that is not finite.
  bool touches(const Footprint& footprint, const Pose2& pose) const;

 protected:
  virtual bool touchesPolygon(const Footprint& polygon, const Pose2& pose) const = 0;
};

/// The occupied cells of a map_server map (unknown cells are neither seen nor touched). Rays are exact at the borders
/// of the cells; a ray that meets a corner passes unless both cells beside the corner, or the cell behind it, are
/// occupied.
class GridWorld : public World {
 public:
  /// Throws as DistanceField.
  explicit GridWorld(OccupancyGrid grid);
  void castRays(const Point2& origin, double first_direction, double increment, double max_range,
                std::vector<double>* ranges) const override;
  using World::touches;
  bool touches(const Point2& center, double radius) const override;
  const OccupancyGrid& grid() const { return grid_; }
  const DistanceField& distances() const { return distances_; }

 protected:
  bool touchesPolygon(const Footprint& polygon, const Pose2& pose) const override;

 private:
  /// All in cells from the lower left corner; (dx, dy) is the unit vector along the ray.
  double castRay(double column, double row, double dx, double dy, double max_cells) const;
  OccupancyGrid grid_;
  DistanceField distances_;
  /// A cell each: 0 = occupied, otherwise 1 + whole cells that a ray can go on from anywhere in the cell without
  /// meeting an occupied one. A byte each, so that a building fits in the cache.
  CellField<std::uint8_t> leaps_;
};

/// A round obstacle, m.
struct Circle {
  Point2 center;
  double radius = 0.0;
};

/// Distance between a footprint at a pose and a circle, m; negative if they overlap.
inline double airBetween(const Footprint& footprint, const Pose2& pose, const Circle& circle) {
  return footprint.distanceTo(toLocalFrame(pose, circle.center)) - circle.radius;
}

/// Cylinders on an endless floor (BARN worlds), or in other surroundings, which must outlive this object.
class CircleWorld : public World {
 public:
  /// Throws std::invalid_argument for a circle that is not finite or has a negative radius.
  explicit CircleWorld(std::vector<Circle> circles, const World* surroundings = nullptr);
  void castRays(const Point2& origin, double first_direction, double increment, double max_range,
                std::vector<double>* ranges) const override;
  using World::touches;
  bool touches(const Point2& center, double radius) const override;

  const std::vector<Circle>& circles() const { return circles_; }
  /// To move circles; they must stay finite.
  std::vector<Circle>& circles() { return circles_; }
  const World* surroundings() const { return surroundings_; }  ///< nullptr: none

 protected:
  bool touchesPolygon(const Footprint& polygon, const Pose2& pose) const override;

 private:
  const World* surroundings_;
  std::vector<Circle> circles_;
};

}  // namespace lstm_planner
