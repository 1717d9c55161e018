#include "lstm_planner/grid/map_generators.hpp"

#include <opencv2/imgproc.hpp>

#include "grid/map_generators.hpp"
#include "lstm_planner/common/random.hpp"

namespace lstm_planner {
namespace {

/// Blocks exactly `count` cells of an open grid, every set of them equally likely (Knuth, volume 2, algorithm S).
PassableGrid blockAtRandom(int columns, int rows, std::size_t count, Random& random) {
  PassableGrid grid(columns, rows, true);
  std::size_t left = grid.size();
  for (CellIndex cell; cell.row < rows; ++cell.row) {
    for (cell.column = 0; cell.column < columns; ++cell.column, --left) {
      if (uniformIndex(random, left) >= count) continue;
      grid.set(cell, false);
      --count;
    }
  }
  return grid;
}

PassableGrid blockAtRandom(int columns, int rows, double share, Random& random) {
  return blockAtRandom(columns, rows,
                       static_cast<std::size_t>(share * static_cast<double>(std::int64_t{columns} * rows)), random);
}

/// Passable cells are 1, others 0.
cv::Mat1b imageOf(const PassableGrid& grid) {
  cv::Mat1b image(grid.rows(), grid.columns());
  for (int row = 0; row < grid.rows(); ++row) {
    for (int column = 0; column < grid.columns(); ++column) image(row, column) = grid.passable({column, row}) ? 1 : 0;
  }
  return image;
}

PassableGrid smoothed(const PassableGrid& grid) {
  cv::Mat1b open_around;
  cv::boxFilter(imageOf(grid), open_around, CV_8U, {3, 3}, {-1, -1}, false, cv::BORDER_CONSTANT);
  PassableGrid result(grid.columns(), grid.rows(), false);
  for (int row = 0; row < grid.rows(); ++row) {
    for (int column = 0; column < grid.columns(); ++column) {
      result.set({column, row}, open_around(row, column) >= 5);
    }
  }
  return result;
}

bool anyPassable(const PassableGrid& grid) { return cv::countNonZero(imageOf(grid)) > 0; }

}  // namespace

void checkMapSize(int columns, int rows, int shortest) {
  const std::string expected = "at least " + std::to_string(shortest);
  checkParameter(columns >= shortest, "columns", columns, expected);
  checkParameter(rows >= shortest, "rows", rows, expected);
  checkParameter(std::int64_t{columns} * rows <= PassableGrid::kMostCells, "rows", rows,
                 "at most 2^26 cells with " + std::to_string(columns) + " columns");
}

void keepLargestRegion(PassableGrid* grid) {
  constexpr int kSides = 4;
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
  for (int row = 0; row < grid->rows(); ++row) {
    for (int column = 0; column < grid->columns(); ++column) {
      grid->set({column, row}, largest > 0 && labels(row, column) == largest);
    }
  }
}

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
    if (!anyPassable(grid)) continue;
    keepLargestRegion(&grid);
    return grid;
  }
  throw std::runtime_error("no cave is left open in 10 draws, expected a larger map or a smaller share of rock");
}

}  // namespace lstm_planner
