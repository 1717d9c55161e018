#include "lstm_planner/simulation/floor_plan.hpp"

#include <algorithm>
#include <boost/pending/disjoint_sets.hpp>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <sstream>
#include <utility>

#include "lstm_planner/common/parameter_visitors.hpp"
#include "lstm_planner/grid/distance_field.hpp"
#include "simulation/building.hpp"

namespace lstm_planner {
namespace {

constexpr double kCorridorWidth = 1.8;  // m
constexpr double kDoorPost = 0.2;       // m of wall between a door and the next corner

/// A wall between two rooms, as far as both lie along it.
struct SharedWall {
  std::size_t first = 0;
  std::size_t second = 0;
  CellBox box;
  bool is_upright = false;
  int kind = 0;  ///< corridors that lie beside the wall, 2 to 0
};

/// Cuts a rectangle into corridors and rooms.
class RoomCutter {
 public:
  RoomCutter(const FloorPlanParameters& parameters, Random& random)
      : random_(random),
        wall_(toCells(parameters.wall_thickness, parameters.resolution)),
        room_(toCells(parameters.smallest_room, parameters.resolution)),
        corridor_(toCells(std::max(kCorridorWidth, parameters.door_width + 3.0 * kDoorPost), parameters.resolution)) {}

  std::vector<Room> cut(const CellBox& box) {
    cutByCorridor(box, box.width() >= box.height());
    return std::move(rooms_);
  }

  int wall() const { return wall_; }

 private:
  /// A corridor along the longer side, the next ones at right angles to it so that they open into it.
  void cutByCorridor(const CellBox& box, bool along_x) {
    const int across = along_x ? box.height() : box.width();
    const int along = along_x ? box.width() : box.height();
    if (across < 2 * (room_ + wall_) + corridor_ || along < 2 * room_ + wall_) {
      cutIntoRooms(box);
      return;
    }
    const int spare = across - 2 * (room_ + wall_) - corridor_;
    // Near the middle: offices on both sides of a corridor are about equally deep.
    const int begin = room_ + wall_ + static_cast<int>(spare * uniform(random_, 0.3, 0.7));
    const CellBox corridor = slice(box, along_x, begin, begin + corridor_);
    rooms_.push_back({corridor, true});
    cutByCorridor(slice(box, along_x, 0, begin - wall_), !along_x);
    cutByCorridor(slice(box, along_x, begin + corridor_ + wall_, across), !along_x);
  }

  void cutIntoRooms(const CellBox& box) {
    const bool cut_x = box.width() >= box.height();
    const int length = cut_x ? box.width() : box.height();
    const int breadth = cut_x ? box.height() : box.width();
    const int spare = length - 2 * room_ - wall_;
    // Some large rooms stay, but no long halls.
    const bool stays_large = length < 3 * room_ && 2 * length < 3 * breadth && uniform(random_) < 0.5;
    if (spare < 0 || stays_large) {
      rooms_.push_back({box, false});
      return;
    }
    const int end = room_ + static_cast<int>(uniformIndex(random_, static_cast<std::size_t>(spare) + 1));
    cutIntoRooms(slice(box, !cut_x, 0, end));
    cutIntoRooms(slice(box, !cut_x, end + wall_, length));
  }

  /// The part of a box from `start` to `end` across the direction of the cut.
  static CellBox slice(const CellBox& box, bool along_x, int begin, int end) {
    if (along_x) return {box.left, box.bottom + begin, box.right, box.bottom + end};
    return {box.left + begin, box.bottom, box.left + end, box.top};
  }

  Random& random_;
  int wall_;
  int room_;
  int corridor_;
  std::vector<Room> rooms_;
};

std::vector<SharedWall> sharedWalls(const std::vector<Room>& rooms, int wall, int shortest) {
  std::vector<SharedWall> walls;
  for (std::size_t i = 0; i < rooms.size(); ++i) {
    for (std::size_t j = 0; j < rooms.size(); ++j) {
      const CellBox& a = rooms[i].box;
      const CellBox& b = rooms[j].box;
      const int bottom = std::max(a.bottom, b.bottom);
      const int top = std::min(a.top, b.top);
      const int left = std::max(a.left, b.left);
      const int right = std::min(a.right, b.right);
      const int kind = (rooms[i].is_corridor ? 1 : 0) + (rooms[j].is_corridor ? 1 : 0);
      if (a.right + wall == b.left && top - bottom >= shortest) {
        walls.push_back({i, j, {a.right, bottom, b.left, top}, true, kind});
      } else if (a.top + wall == b.bottom && right - left >= shortest) {
        walls.push_back({i, j, {left, a.top, right, b.bottom}, false, kind});
      }
    }
  }
  return walls;
}

Building buildRooms(const FloorPlanParameters& parameters, Random& random) {
  const int columns = toCells(parameters.width, parameters.resolution);
  const int rows = toCells(parameters.height, parameters.resolution);
  const int door = std::max(3, toCells(parameters.door_width, parameters.resolution));
  const int post = toCells(kDoorPost, parameters.resolution);

  RoomCutter cutter(parameters, random);
  const int wall = cutter.wall();
  Building building;
  building.rooms = cutter.cut({wall, wall, columns - wall, rows - wall});
  building.grid = OccupancyGrid(columns, rows, parameters.resolution, {}, Cell::kOccupied);
  for (const Room& room : building.rooms) fillBox(room.box, Cell::kFree, &building.grid);

  std::vector<SharedWall> walls = sharedWalls(building.rooms, wall, door + 2 * post);
  shuffle(&walls, random);
  // Corridors first: a room beside a corridor is entered from there and not through its neighbour.
  std::stable_sort(walls.begin(), walls.end(), [](const auto& a, const auto& b) { return a.kind > b.kind; });
  boost::disjoint_sets_with_storage<> connected(building.rooms.size());
  for (const SharedWall& shared : walls) {
    const bool is_needed = connected.find_set(shared.first) != connected.find_set(shared.second);
    connected.union_set(shared.first, shared.second);
    const bool joins_corridors = shared.kind == 2;
    if (!is_needed && !joins_corridors && uniform(random) >= parameters.extra_doors) continue;
    CellBox opening = shared.box;
    if (!joins_corridors) {
      const int length = shared.is_upright ? opening.height() : opening.width();
      const auto places = static_cast<std::size_t>(length - door - 2 * post) + 1;
      const int begin = post + static_cast<int>(uniformIndex(random, places));
      int& low = shared.is_upright ? opening.bottom : opening.left;
      int& high = shared.is_upright ? opening.top : opening.right;
      low += begin;
      high = low + door;
    }
    fillBox(opening, Cell::kFree, &building.grid);
    building.doors.push_back(opening);
  }
  return building;
}

}  // namespace

int toCells(double metres, double resolution) {
  return std::max(1, static_cast<int>(std::lround(metres / resolution)));
}

void fillBox(const CellBox& box, Cell cell, OccupancyGrid* grid) {
  for (int row = box.bottom; row < box.top; ++row) {
    for (int column = box.left; column < box.right; ++column) grid->set({column, row}, cell);
  }
}

int labelOpenAreas(const OccupancyGrid& grid, double radius, cv::Mat1i* labels) {
  constexpr int kSides = 4;
  const DistanceField distances(grid, true);
  // Half a diagonal: the distance joins the centres of cells, and the obstacle starts at the edge of its own.
  const double clearance = radius + grid.resolution() * M_SQRT1_2;
  cv::Mat1b fits(grid.rows(), grid.columns());
  for (const CellIndex cell : grid.cells()) fits(cell.row, cell.column) = distances.at(cell) >= clearance ? 1 : 0;
  return cv::connectedComponents(fits, *labels, kSides, CV_32S) - 1;
}

void validate(const FloorPlanParameters& parameters) {
  visitFloorPlanParameters(parameters, RangeCheck());
  const auto atLeast = [](const char* name, double value, double least) {
    std::ostringstream expected;
    expected << "at least " << least;
    checkParameter(isAtMost(least, value), name, value, expected.str());
  };
  atLeast("wall_thickness", parameters.wall_thickness, parameters.resolution);
  atLeast("smallest_room", parameters.smallest_room, parameters.door_width + 0.6);
  const double shortest_side = parameters.smallest_room + 2.0 * (parameters.wall_thickness + parameters.resolution);
  atLeast("width", parameters.width, shortest_side);
  atLeast("height", parameters.height, shortest_side);
}

OccupancyGrid generateFloorPlan(const FloorPlanParameters& parameters, std::uint64_t seed) {
  validate(parameters);
  Random random(seed);
  Building building = buildRooms(parameters, random);
  furnish(parameters, random, &building);
  return building.grid;
}

}  // namespace lstm_planner
