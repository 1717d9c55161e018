#include "lstm_planner/grid/map_generators.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "lstm_planner/common/parameter_check.hpp"
#include "lstm_planner/common/random.hpp"
#include "lstm_planner/grid/passable_grid.hpp"

namespace lstm_planner {
namespace {

/// Blocks exactly that share of an open grid, rounded down to whole cells, every set of them equally likely (Knuth,
/// volume 2, algorithm S).
PassableGrid blockAtRandom(int columns, int rows, double share, Random& random) {
  PassableGrid grid(columns, rows, true);
  std::size_t left = grid.size();
  auto count = static_cast<std::size_t>(share * static_cast<double>(left));
  for (CellIndex cell; cell.row < rows; ++cell.row) {
    for (cell.column = 0; cell.column < columns; ++cell.column, --left) {
      if (uniformIndex(random, left) >= count) continue;
      grid.set(cell, false);
      --count;
    }
  }
  return grid;
}

/// Passable cells are 1, others 0.
cv::Mat1b imageOf(const PassableGrid& grid) {
  cv::Mat1b image(grid.rows(), grid.columns());
  for (const CellIndex cell : grid.cells()) image(cell.row, cell.column) = grid.passable(cell) ? 1 : 0;
  return image;
}

PassableGrid smoothed(const PassableGrid& grid) {
  cv::Mat1b open_around;
  cv::boxFilter(imageOf(grid), open_around, CV_8U, {3, 3}, {-1, -1}, false, cv::BORDER_CONSTANT);
  PassableGrid result(grid.columns(), grid.rows(), false);
  for (const CellIndex cell : grid.cells()) result.set(cell, open_around(cell.row, cell.column) >= 5);
  return result;
}

/// Squares of equal size in rows and columns with walls of one cell before and between them; the last ones are cut
/// where the map ends.
class Lattice {
 public:
  Lattice(int columns, int rows, int square)
      : square_(square), squares_across_(count(columns)), squares_down_(count(rows)), grid_(columns, rows, false) {
    for (int index = 0; index < size(); ++index) open(first(index), square_, square_);
  }

  int size() const { return squares_across_ * squares_down_; }
  const PassableGrid& grid() const { return grid_; }

  /// The square east (0), south (1), west (2) or north (3) of one; -1 where the lattice ends. South is towards the last
  /// row.
  int beside(int index, int side) const {
    const int across = index % squares_across_ + (side == 0 ? 1 : side == 2 ? -1 : 0);
    const int down = index / squares_across_ + (side == 1 ? 1 : side == 3 ? -1 : 0);
    const bool inside = across >= 0 && down >= 0 && across < squares_across_ && down < squares_down_;
    return inside ? down * squares_across_ + across : -1;
  }

  /// Length of the wall to a square beside, cells.
  int wallLength(int index, int side) const {
    const CellIndex cell = first(index);
    return std::min(square_, isUpright(side) ? grid_.rows() - cell.row : grid_.columns() - cell.column);
  }

  /// Opens `length` cells of the wall to a square beside, from the cell `from` on.
  void openWall(int index, int side, int from, int length) {
    CellIndex cell = first(side < 2 ? index : beside(index, side));
    (isUpright(side) ? cell.column : cell.row) += square_;
    (isUpright(side) ? cell.row : cell.column) += from;
    open(cell, isUpright(side) ? 1 : length, isUpright(side) ? length : 1);
  }

 private:
  static bool isUpright(int side) { return side % 2 == 0; }
  int count(int cells) const { return (cells - 1 + square_) / (square_ + 1); }
  CellIndex first(int index) const {
    return {1 + index % squares_across_ * (square_ + 1), 1 + index / squares_across_ * (square_ + 1)};
  }

  void open(CellIndex corner, int columns, int rows) {
    const CellIndex end{std::min(corner.column + columns, grid_.columns()), std::min(corner.row + rows, grid_.rows())};
    for (CellIndex cell = corner; cell.row < end.row; ++cell.row) {
      for (cell.column = corner.column; cell.column < end.column; ++cell.column) grid_.set(cell, true);
    }
  }

  int square_;
  int squares_across_;
  int squares_down_;
  PassableGrid grid_;
};

constexpr int kSides = 4;

/// A wall of a lattice: between a square and the one beside it.
struct Wall {
  int index;
  int side;
};

/// The walls to open so that one path leads between any two squares ("growing tree").
std::vector<Wall> growTree(const Lattice& lattice, double branching, Random& random) {
  std::vector<bool> reached(static_cast<std::size_t>(lattice.size()));
  std::vector<int> open{static_cast<int>(uniformIndex(random, reached.size()))};
  reached[static_cast<std::size_t>(open[0])] = true;
  std::vector<Wall> opened;
  while (!open.empty()) {
    int& from = uniform(random) < branching ? open[uniformIndex(random, open.size())] : open.back();
    std::array<int, kSides> sides{};
    std::size_t side_count = 0;
    for (int side = 0; side < kSides; ++side) {
      const int next = lattice.beside(from, side);
      if (next >= 0 && !reached[static_cast<std::size_t>(next)]) sides[side_count++] = side;
    }
    if (side_count == 0) {
      from = open.back();
      open.pop_back();
      continue;
    }
    const Wall wall{from, sides[uniformIndex(random, side_count)]};
    const int next = lattice.beside(wall.index, wall.side);
    reached[static_cast<std::size_t>(next)] = true;
    open.push_back(next);
    opened.push_back(wall);
  }
  return opened;
}

void openDoor(const Wall& wall, int door_cells, Random& random, Lattice* lattice) {
  const int wall_length = lattice->wallLength(wall.index, wall.side);
  const int width = std::min(door_cells, wall_length);
  const auto from = static_cast<int>(uniformIndex(random, static_cast<std::size_t>(wall_length - width + 1)));
  lattice->openWall(wall.index, wall.side, from, width);
}

/// Throws std::invalid_argument for sides below `shortest` and for more cells than a grid holds.
void checkMapSize(int columns, int rows, int shortest) {
  const std::string expected = "at least " + std::to_string(shortest);
  checkParameter(columns >= shortest, "columns", columns, expected);
  checkParameter(rows >= shortest, "rows", rows, expected);
  checkParameter(std::int64_t{columns} * rows <= PassableGrid::kMostCells, "rows", rows,
                 "at most 2^26 cells with " + std::to_string(columns) + " columns");
}

/// Blocks every cell that is not of the largest region. Regions are connected by sides: without corner cutting a
/// diagonal move needs both cells at its side, and so reaches nothing more.
void keepLargestRegion(PassableGrid* grid) {
  cv::Mat1i labels;
  cv::Mat1i regions;
  cv::Mat1d centers;
  const int count = cv::connectedComponentsWithStats(imageOf(*grid), labels, regions, centers, kSides, CV_32S);
  int largest = 0;
  int largest_area = 0;
  for (int label = 1; label < count; ++label) {  // 0 are the blocked cells
    if (regions(label, cv::CC_STAT_AREA) <= largest_area) continue;
    largest = label;
    largest_area = regions(label, cv::CC_STAT_AREA);
  }
  for (const CellIndex cell : grid->cells()) {
    grid->set(cell, largest > 0 && labels(cell.row, cell.column) == largest);
  }
}

}  // namespace

void validate(const RandomFillParameters& parameters) {
  checkMapSize(parameters.columns, parameters.rows, 1);
  checkParameter(parameters.share >= 0.0 && parameters.share < 1.0, "share", parameters.share,
                 "a share of at least 0 and below 1");
}

PassableGrid generateRandomFill(const RandomFillParameters& parameters, std::uint64_t seed) {
  validate(parameters);
  Random random(seed);
  PassableGrid grid = blockAtRandom(parameters.columns, parameters.rows, parameters.share, random);
  if (parameters.fill_pockets) keepLargestRegion(&grid);
  return grid;
}

void validate(const CaveParameters& parameters) {
  constexpr int kSmallest = 8;
  constexpr int kMostRounds = 100;
  constexpr double kMostRock = 0.6;
  checkMapSize(parameters.columns, parameters.rows, kSmallest);
  checkParameter(parameters.share >= 0.0 && parameters.share <= kMostRock, "share", parameters.share,
                 "a share of at least 0 and at most 0.6");
  checkParameter(parameters.rounds >= 0 && parameters.rounds <= kMostRounds, "rounds", parameters.rounds,
                 "a number from 0 to 100");
}

PassableGrid generateCaves(const CaveParameters& parameters, std::uint64_t seed) {
  constexpr int kMostDraws = 10;
  validate(parameters);
  Random random(seed);
  for (int draw = 0; draw < kMostDraws; ++draw) {
    PassableGrid grid = blockAtRandom(parameters.columns, parameters.rows, parameters.share, random);
    for (int round = 0; round < parameters.rounds; ++round) grid = smoothed(grid);
    if (cv::countNonZero(imageOf(grid)) == 0) continue;
    keepLargestRegion(&grid);
    return grid;
  }
  throw std::runtime_error("no cave is left open in 10 draws, expected a larger map or a smaller share of rock");
}

void validate(const MazeParameters& parameters) {
  checkAtLeastOne("corridor_width", parameters.corridor_width);
  checkMapSize(parameters.columns, parameters.rows, 2);
  checkParameter(parameters.corridor_width < std::min(parameters.columns, parameters.rows), "corridor_width",
                 parameters.corridor_width, "less than the map's columns and rows");
  checkParameter(parameters.branching >= 0.0 && parameters.branching <= 1.0, "branching", parameters.branching,
                 "a probability in [0, 1]");
}

PassableGrid generateMaze(const MazeParameters& parameters, std::uint64_t seed) {
  validate(parameters);
  Random random(seed);
  Lattice lattice(parameters.columns, parameters.rows, parameters.corridor_width);
  for (const Wall& wall : growTree(lattice, parameters.branching, random)) {
    lattice.openWall(wall.index, wall.side, 0, lattice.wallLength(wall.index, wall.side));
  }
  return lattice.grid();
}

void validate(const RoomParameters& parameters) {
  checkAtLeastOne("room_size", parameters.room_size);
  checkMapSize(parameters.columns, parameters.rows, 2);
  checkParameter(parameters.room_size < std::min(parameters.columns, parameters.rows), "room_size",
                 parameters.room_size, "less than the map's columns and rows");
  checkParameter(parameters.door_cells >= 1 && parameters.door_cells <= parameters.room_size, "door_cells",
                 parameters.door_cells, "at least 1 and at most room_size");
  checkParameter(parameters.extra_doors >= 0.0 && parameters.extra_doors <= 1.0, "extra_doors", parameters.extra_doors,
                 "a probability in [0, 1]");
}

PassableGrid generateRooms(const RoomParameters& parameters, std::uint64_t seed) {
  constexpr double kBranching = 1.0;  // long detours are what mazes are for
  validate(parameters);
  Random random(seed);
  Lattice lattice(parameters.columns, parameters.rows, parameters.room_size);
  std::vector<std::array<bool, 2>> has_door(static_cast<std::size_t>(lattice.size()));
  for (const Wall& wall : growTree(lattice, kBranching, random)) {
    openDoor(wall, parameters.door_cells, random, &lattice);
    const int owner = wall.side < 2 ? wall.index : lattice.beside(wall.index, wall.side);
    has_door[static_cast<std::size_t>(owner)][static_cast<std::size_t>(wall.side % 2)] = true;
  }
  for (int index = 0; index < lattice.size(); ++index) {
    for (int side = 0; side < 2; ++side) {
      const bool needs_none = has_door[static_cast<std::size_t>(index)][static_cast<std::size_t>(side)];
      if (needs_none || lattice.beside(index, side) < 0 || uniform(random) >= parameters.extra_doors) continue;
      openDoor({index, side}, parameters.door_cells, random, &lattice);
    }
  }
  return lattice.grid();
}

}  // namespace lstm_planner
