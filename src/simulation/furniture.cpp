#include <algorithm>
#include <cmath>
#include <cstddef>

#include "simulation/building.hpp"

namespace lstm_planner {
namespace {

constexpr double kRobotRadius = 0.175;  // m

struct Furniture {
  CellBox box;
  bool is_round = false;
  std::size_t room = 0;
};

/// Cells that the two boxes are apart, squared; 0 when they touch or overlap.
long squaredGap(const CellBox& a, const CellBox& b) {
  const long across = std::max({0, a.left - b.right, b.left - a.right});
  const long up = std::max({0, a.bottom - b.top, b.bottom - a.top});
  return across * across + up * up;
}

void paint(const Furniture& furniture, Cell cell, OccupancyGrid* grid) {
  const CellBox& box = furniture.box;
  if (!furniture.is_round) {
    fillBox(box, cell, grid);
    return;
  }
  // In half cells: the centre of a cell lies inside the circle.
  const int diameter = box.width();
  for (int row = box.bottom; row < box.top; ++row) {
    for (int column = box.left; column < box.right; ++column) {
      const int across = 2 * column + 1 - box.left - box.right;
      const int up = 2 * row + 1 - box.bottom - box.top;
      if (across * across + up * up <= diameter * diameter) grid->set({column, row}, cell);
    }
  }
}

/// Proposes furniture at random places and keeps what leaves enough room around it.
class Furnisher {
 public:
  Furnisher(const FloorPlanParameters& parameters, const Building& building, Random& random)
      : parameters_(parameters),
        building_(building),
        random_(random),
        gap_(static_cast<int>(std::ceil(parameters.smallest_gap / parameters.resolution - 1e-9))),
        door_clearance_(toCells(std::max(parameters.smallest_gap, parameters.door_width), parameters.resolution)) {}

  std::vector<Furniture> place() {
    std::vector<std::size_t> rooms;
    double floor = 0.0;
    for (std::size_t i = 0; i < building_.rooms.size(); ++i) {
      floor += static_cast<double>(building_.rooms[i].box.width()) * building_.rooms[i].box.height();
      if (!building_.rooms[i].is_corridor) rooms.push_back(i);
    }
    double covered = 0.0;
    for (std::size_t attempt = 0; attempt < rooms.size() * static_cast<std::size_t>(parameters_.tries); ++attempt) {
      if (covered >= parameters_.furniture * floor) break;
      Furniture furniture;
      if (!propose(rooms[uniformIndex(random_, rooms.size())], &furniture) || !fits(furniture)) continue;
      const double area = static_cast<double>(furniture.box.width()) * furniture.box.height();
      covered += furniture.is_round ? area * M_PI_4 : area;
      placed_.push_back(furniture);
    }
    return std::move(placed_);
  }

 private:
  bool propose(std::size_t room, Furniture* furniture) {
    furniture->room = room;
    furniture->is_round = uniform(random_) < 0.3;
    int width =
        toCells(furniture->is_round ? uniform(random_, 0.3, 1.0) : uniform(random_, 0.6, 1.8), parameters_.resolution);
    int height = furniture->is_round ? width : toCells(uniform(random_, 0.4, 0.9), parameters_.resolution);
    if (uniform(random_) < 0.5) std::swap(width, height);
    if (width < 2 || height < 2) return false;

    // Cupboards and desks stand along walls or in corners, round things free.
    const double place = furniture->is_round ? 1.0 : uniform(random_);
    const bool in_corner = place < 0.15;
    const bool along_wall = place < 0.7;
    const bool wall_is_upright = width < height;
    const CellBox& floor = building_.rooms[room].box;
    const bool flush_x = in_corner || (along_wall && wall_is_upright);
    const bool flush_y = in_corner || (along_wall && !wall_is_upright);
    CellBox& box = furniture->box;
    if (!choose(floor.left, floor.right, width, flush_x, &box.left)) return false;
    if (!choose(floor.bottom, floor.top, height, flush_y, &box.bottom)) return false;
    box.right = box.left + width;
    box.top = box.bottom + height;
    return true;
  }

  /// Chooses where a thing of `size` cells starts between the walls at `low` and `high`; false when it does not fit.
  bool choose(int low, int high, int size, bool flush, int* start) {
    const int spare = high - low - size - 2 * gap_;
    // With less room than that, a gap behind it would be too narrow on one of its sides.
    if (spare < 0) return false;
    if (flush) {
      *start = uniform(random_) < 0.5 ? low : high - size;
    } else {
      *start = low + gap_ + static_cast<int>(uniformIndex(random_, static_cast<std::size_t>(spare) + 1));
    }
    return true;
  }

  bool fits(const Furniture& furniture) const {
    const long gap = static_cast<long>(gap_) * gap_;
    const long door_clearance = static_cast<long>(door_clearance_) * door_clearance_;
    // Even where no gap is wanted, two things do not overlap.
    const auto collides = [&](const Furniture& other) {
      return other.room == furniture.room && squaredGap(other.box, furniture.box) < std::max(1L, gap);
    };
    const auto blocks = [&](const CellBox& door) { return squaredGap(door, furniture.box) < door_clearance; };
    return std::none_of(placed_.begin(), placed_.end(), collides) &&
           std::none_of(building_.doors.begin(), building_.doors.end(), blocks);
  }

  const FloorPlanParameters& parameters_;
  const Building& building_;
  Random& random_;
  int gap_;
  int door_clearance_;
  std::vector<Furniture> placed_;
};

/// Parts of the floor that the robot fits in and that it cannot go between.
int separateAreas(const OccupancyGrid& grid) {
  cv::Mat1i labels;
  return labelOpenAreas(grid, kRobotRadius, &labels);
}

}  // namespace

void furnish(const FloorPlanParameters& parameters, Random& random, Building* building) {
  OccupancyGrid& grid = building->grid;
  std::vector<Furniture> placed = Furnisher(parameters, *building, random).place();
  for (const Furniture& furniture : placed) paint(furniture, Cell::kOccupied, &grid);

  // Gaps narrower than the robot can cut an area off: what does so goes again.
  int areas = separateAreas(grid);
  for (auto furniture = placed.rbegin(); areas > 1 && furniture != placed.rend(); ++furniture) {
    paint(*furniture, Cell::kFree, &grid);
    const int areas_without = separateAreas(grid);
    if (areas_without < areas) {
      areas = areas_without;
    } else {
      paint(*furniture, Cell::kOccupied, &grid);
    }
  }
  // Several things may close a gap only together; an empty building is always connected.
  if (areas <= 1) return;
  for (const Furniture& furniture : placed) paint(furniture, Cell::kFree, &grid);
}

}  // namespace lstm_planner
