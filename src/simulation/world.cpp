#include "lstm_planner/simulation/world.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "lstm_planner/common/text_table.hpp"

namespace lstm_planner {
namespace {

constexpr double kNothing = std::numeric_limits<double>::infinity();
constexpr std::size_t kBeamsBetweenSines = 16;

double directionOf(double first, double increment, std::size_t beam) {
  return first + static_cast<double>(beam) * increment;
}

/// Where the line start + t * slope is inside [0, size]; narrows [*enter, *leave].
void clip(double start, double slope, double size, double* enter, double* leave) {
  if (slope == 0.0) {
    if (start < 0.0 || start >= size) *leave = -kNothing;
    return;
  }
  const double a = -start / slope;
  const double b = (size - start) / slope;
  *enter = std::max(*enter, std::min(a, b));
  *leave = std::min(*leave, std::max(a, b));
}

/// m^2 of how far a cell at (x, y) reaches beyond each side of a polygon at most: negative where a side parts them.
double leastReach(const std::vector<Point2>& corners, double x, double y) {
  double least = kNothing;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point2& from = corners[i];
    const Point2& to = corners[(i + 1) % corners.size()];
    double most = -kNothing;
    for (const Point2& corner : {Point2{x, y}, {x + 1.0, y}, {x, y + 1.0}, {x + 1.0, y + 1.0}}) {
      most = std::max(most, (to.x - from.x) * (corner.y - from.y) - (to.y - from.y) * (corner.x - from.x));
    }
    least = std::min(least, most);
  }
  return least;
}

/// Lowers those ranges, of beams as in World::castRays(), that the circle cuts short.
void castRaysAtCircle(const Circle& circle, const Point2& origin, double first_direction, double increment,
                      double max_range, std::vector<double>* ranges) {
  if (ranges->empty() || !std::isfinite(origin.x + origin.y + first_direction + increment)) return;
  const double distance = distanceBetween(origin, circle.center);
  if (distance <= circle.radius) {
    std::fill(ranges->begin(), ranges->end(), 0.0);
    return;
  }
  if (distance - circle.radius > max_range) return;
  // Angles are counted from the first beam in the sense of rotation, so that the increment is positive.
  const double sense = increment < 0.0 ? -1.0 : 1.0;
  const double step = std::max(std::abs(increment), 1e-12);
  const double last_beam = static_cast<double>(ranges->size() - 1);
  const double bearing = sense * normalizeAngle(directionTo(origin, circle.center) - first_direction);
  const double half_width = std::asin(circle.radius / distance);
  const double last_turn = std::floor((last_beam * step + half_width - bearing) / (2.0 * M_PI));
  for (double turn = std::ceil((-half_width - bearing) / (2.0 * M_PI)); turn <= last_turn; turn += 1.0) {
    const double middle = bearing + turn * 2.0 * M_PI;
    const double first = std::max(0.0, std::floor((middle - half_width) / step));
    const double last = std::min(last_beam, std::ceil((middle + half_width) / step));
    for (long beam = static_cast<long>(first); beam <= static_cast<long>(last); ++beam) {
      const double angle = static_cast<double>(beam) * step - middle;
      const double across = distance * std::sin(angle);
      const double inside = circle.radius * circle.radius - across * across;
      if (inside < 0.0) continue;
      const double range = distance * std::cos(angle) - std::sqrt(inside);
      double& nearest = (*ranges)[static_cast<std::size_t>(beam)];
      if (range <= max_range) nearest = std::min(nearest, range);
    }
  }
}

}  // namespace

bool World::touches(const Footprint& footprint, const Pose2& pose) const {
  if (footprint.isCircle()) return touches(Point2{pose.x, pose.y}, footprint.circumscribedRadius());
  if (!isFinite(pose)) throw std::invalid_argument("a footprint at a pose that is not finite cannot touch anything");
  // Most are far from everything.
  if (!touches(Point2{pose.x, pose.y}, footprint.circumscribedRadius())) return false;
  return touchesPolygon(footprint, pose);
}

GridWorld::GridWorld(OccupancyGrid grid)
    : grid_(std::move(grid)), distances_(grid_, false), leaps_(grid_.columns(), grid_.rows(), 0) {
  for (const CellIndex cell : grid_.cells()) {
    // The distance joins centres; a ray may start at a corner of this cell and meet a corner of the other: sqrt(2),
    // and a little for the float.
    const double free = distances_.at(cell) / grid_.resolution() - M_SQRT2 - 1e-3;
    if (grid_[cell] == Cell::kOccupied) continue;
    leaps_[cell] = static_cast<std::uint8_t>(1.0 + std::clamp(std::floor(free), 0.0, 254.0));
  }
}

void GridWorld::castRays(const Point2& origin, double first_direction, double increment, double max_range,
                         std::vector<double>* ranges) const {
  const Point2 local = toLocalFrame(grid_.origin(), origin);
  const double first = first_direction - grid_.origin().yaw;
  const double column = local.x / grid_.resolution();
  const double row = local.y / grid_.resolution();
  const double max_cells = max_range / grid_.resolution();
  const bool usable = std::isfinite(column + row + first + increment) && grid_.columns() > 0;
  if (!usable) {
    std::fill(ranges->begin(), ranges->end(), kNothing);
    return;
  }
  // Turning the last direction on is much cheaper than a sine; a fresh one now and then keeps rounding from adding up.
  const double cos_increment = std::cos(increment);
  const double sin_increment = std::sin(increment);
  double dx = 0.0;
  double dy = 0.0;
  for (std::size_t beam = 0; beam < ranges->size(); ++beam) {
    if (beam % kBeamsBetweenSines == 0) {
      dx = std::cos(directionOf(first, increment, beam));
      dy = std::sin(directionOf(first, increment, beam));
    }
    (*ranges)[beam] = castRay(column, row, dx, dy, max_cells) * grid_.resolution();
    const double turned_dx = dx * cos_increment - dy * sin_increment;
    dy = dx * sin_increment + dy * cos_increment;
    dx = turned_dx;
  }
}

double GridWorld::castRay(double column, double row, double dx, double dy, double max_cells) const {
  double travelled = 0.0;
  double leave = max_cells;
  clip(column, dx, grid_.columns(), &travelled, &leave);
  clip(row, dy, grid_.rows(), &travelled, &leave);
  if (!(travelled <= leave)) return kNothing;

  const int right = dx > 0.0 ? 1 : -1;
  const int up = dy > 0.0 ? 1 : -1;
  const int border_right = dx > 0.0 ? 1 : 0;
  const int border_up = dy > 0.0 ? 1 : 0;
  const double per_column = dx != 0.0 ? 1.0 / dx : kNothing;
  const double per_row = dy != 0.0 ? 1.0 / dy : kNothing;
  const int columns = grid_.columns();
  const int rows = grid_.rows();
  // Rounding at the edge of the map must not put the entry outside.
  int x = std::clamp(static_cast<int>(std::floor(column + travelled * dx)), 0, columns - 1);
  int y = std::clamp(static_cast<int>(std::floor(row + travelled * dy)), 0, rows - 1);

  while (travelled <= leave) {
    const int leap = leaps_[{x, y}];
    if (leap == 0) return travelled;
    if (leap > 2) {
      travelled += leap - 1;
      const double at_column = column + travelled * dx;
      const double at_row = row + travelled * dy;
      if (at_column < 0.0 || at_row < 0.0 || at_column >= columns || at_row >= rows) return kNothing;
      x = static_cast<int>(at_column);
      y = static_cast<int>(at_row);
      continue;
    }
    // The borders are computed from the start of the ray, so that no rounding adds up on the way.
    const double to_column = dx != 0.0 ? (x + border_right - column) * per_column : kNothing;
    const double to_row = dy != 0.0 ? (y + border_up - row) * per_row : kNothing;
    travelled = std::min(to_column, to_row);
    const int next_x = to_column <= to_row ? x + right : x;
    const int next_y = to_row <= to_column ? y + up : y;
    if (next_x < 0 || next_y < 0 || next_x >= columns || next_y >= rows) return kNothing;
    const bool through_corner = next_x != x && next_y != y;
    if (through_corner && leaps_[{next_x, y}] == 0 && leaps_[{x, next_y}] == 0) {
      return travelled <= leave ? travelled : kNothing;
    }
    x = next_x;
    y = next_y;
  }
  return kNothing;
}

bool GridWorld::touches(const Point2& center, double radius) const {
  if (grid_.columns() == 0) return false;
  const Point2 local = toLocalFrame(grid_.origin(), center);
  const double column = local.x / grid_.resolution();
  const double row = local.y / grid_.resolution();
  const double cells = radius / grid_.resolution();
  if (!std::isfinite(column + row + cells)) {
    throw std::invalid_argument("a disc that is not finite cannot be checked for contacts");
  }
  const auto cellNumber = [](double coordinate, int size) {
    return static_cast<int>(std::clamp(std::floor(coordinate), 0.0, static_cast<double>(size - 1)));
  };
  const int last_row = cellNumber(row + cells, grid_.rows());
  const int last_column = cellNumber(column + cells, grid_.columns());
  for (int y = cellNumber(row - cells, grid_.rows()); y <= last_row; ++y) {
    for (int x = cellNumber(column - cells, grid_.columns()); x <= last_column; ++x) {
      if (grid_.at({x, y}) != Cell::kOccupied) continue;
      const double dx = column - std::clamp(column, static_cast<double>(x), x + 1.0);
      const double dy = row - std::clamp(row, static_cast<double>(y), y + 1.0);
      if (dx * dx + dy * dy < cells * cells) return true;
    }
  }
  return false;
}

bool GridWorld::touchesPolygon(const Footprint& polygon, const Pose2& pose) const {
  std::vector<Point2> in_cells;
  Point2 low{kNothing, kNothing};
  Point2 high{-kNothing, -kNothing};
  for (const Point2& corner : polygon.corners()) {
    const Point2 local = toLocalFrame(grid_.origin(), toParentFrame(pose, corner));
    in_cells.push_back({local.x / grid_.resolution(), local.y / grid_.resolution()});
    low = {std::min(low.x, in_cells.back().x), std::min(low.y, in_cells.back().y)};
    high = {std::max(high.x, in_cells.back().x), std::max(high.y, in_cells.back().y)};
  }
  const int last_row = std::min(grid_.rows() - 1, static_cast<int>(std::ceil(high.y)) - 1);
  const int last_column = std::min(grid_.columns() - 1, static_cast<int>(std::ceil(high.x)) - 1);
  for (int y = std::max(0, static_cast<int>(std::floor(low.y))); y <= last_row; ++y) {
    for (int x = std::max(0, static_cast<int>(std::floor(low.x))); x <= last_column; ++x) {
      if (grid_.at({x, y}) == Cell::kOccupied && leastReach(in_cells, x, y) > 0.0) return true;
    }
  }
  return false;
}

CircleWorld::CircleWorld(std::vector<Circle> circles, const World* surroundings)
    : surroundings_(surroundings), circles_(std::move(circles)) {
  for (const Circle& circle : circles_) {
    if (std::isfinite(circle.center.x + circle.center.y + circle.radius) && circle.radius >= 0.0) continue;
    throw std::invalid_argument("a circle at (" + numberText(circle.center.x) + ", " + numberText(circle.center.y) +
                                ") has the radius " + numberText(circle.radius) +
                                ", expected finite numbers and a radius of at least 0");
  }
}

void CircleWorld::castRays(const Point2& origin, double first_direction, double increment, double max_range,
                           std::vector<double>* ranges) const {
  if (surroundings_ != nullptr) {
    surroundings_->castRays(origin, first_direction, increment, max_range, ranges);
  } else {
    std::fill(ranges->begin(), ranges->end(), kNothing);
  }
  for (const Circle& circle : circles_) {
    castRaysAtCircle(circle, origin, first_direction, increment, max_range, ranges);
  }
}

bool CircleWorld::touches(const Point2& center, double radius) const {
  const auto isTouched = [&](const Circle& circle) {
    return distanceBetween(center, circle.center) < radius + circle.radius;
  };
  return std::any_of(circles_.begin(), circles_.end(), isTouched) ||
         (surroundings_ != nullptr && surroundings_->touches(center, radius));
}

bool CircleWorld::touchesPolygon(const Footprint& polygon, const Pose2& pose) const {
  const auto isTouched = [&](const Circle& circle) { return airBetween(polygon, pose, circle) < 0.0; };
  return std::any_of(circles_.begin(), circles_.end(), isTouched) ||
         (surroundings_ != nullptr && surroundings_->touches(polygon, pose));
}

}  // namespace lstm_planner
