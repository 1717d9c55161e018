#include <algorithm>
#include <cmath>
#include <vector>

#include "lstm_planner/common/random.hpp"
#include "lstm_planner/simulation/generated_world.hpp"
#include "simulation/building.hpp"

namespace lstm_planner {
namespace {

constexpr double kEdge = 0.2;              // m of ground around the corridors
constexpr double kWallBetween = 0.5;       // m between corridors side by side, at the least
constexpr double kShortestCorridor = 2.5;  // m of corridor
constexpr int kCorridorTries = 50;         // to find room for another corridor
constexpr double kExtent = 5.5;            // m along x or y that the corridors reach at the least
constexpr int kWorlds = 20;                // drawn, of which the last one is taken where none reaches as far

/// Where the middle of a corridor runs, m.
struct Corridor {
  Point2 start;
  bool along_x = true;
  double length = 0.0;  ///< m, negative to the left and down
  double width = 0.0;   ///< m

  Point2 at(double share) const {
    return {start.x + (along_x ? share * length : 0.0), start.y + (along_x ? 0.0 : share * length)};
  }
};

class Digger {
 public:
  Digger(const CorridorWorldParameters& parameters, Random& random, OccupancyGrid* grid)
      : parameters_(parameters), random_(random), grid_(*grid) {}

  /// Returns how far the corridors reach, m along x or y, from end to end.
  double dig() {
    const Point2 middle{0.5 * parameters_.width, 0.5 * parameters_.height};
    dig(drawAt(middle, parameters_.width >= parameters_.height));
    for (int i = 1; i < parameters_.corridors; ++i) {
      for (int trial = 0; trial < kCorridorTries; ++trial) {
        const Corridor& from = dug_[uniformIndex(random_, dug_.size())];
        // Ends are chosen often: that makes bends.
        const double share = uniform(random_) < 0.3 ? 1.0 : uniform(random_);
        const Corridor next = drawAt(from.at(share), !from.along_x);
        if (std::abs(next.length) < kShortestCorridor || runsBeside(next)) continue;
        dig(next);
        break;
      }
    }
    return extent();
  }

 private:
  Corridor drawAt(const Point2& start, bool along_x) {
    Corridor corridor{start, along_x, 0.0, uniform(random_, parameters_.narrowest, parameters_.widest)};
    const double at = along_x ? start.x : start.y;
    const double size = along_x ? parameters_.width : parameters_.height;
    const double back = std::max(0.0, at - 0.5 * corridor.width - kEdge);
    const double ahead = std::max(0.0, size - kEdge - 0.5 * corridor.width - at);
    const bool forward = uniform(random_) * (back + ahead) >= back;
    const double longest = forward ? ahead : back;
    corridor.length = (forward ? 1.0 : -1.0) * uniform(random_, std::min(kShortestCorridor, longest), longest);
    return corridor;
  }

  CellBox boxOf(const Corridor& corridor, double margin) const {
    const Point2 start = corridor.start;
    const Point2 end = corridor.at(1.0);
    const double reach = 0.5 * corridor.width + margin;
    const auto cell = [&](double coordinate, double size) {
      return static_cast<int>(std::lround(std::clamp(coordinate, kEdge, size - kEdge) / parameters_.resolution));
    };
    return {cell(std::min(start.x, end.x) - reach, parameters_.width),
            cell(std::min(start.y, end.y) - reach, parameters_.height),
            cell(std::max(start.x, end.x) + reach, parameters_.width),
            cell(std::max(start.y, end.y) + reach, parameters_.height)};
  }

  /// Whether hardly any wall would be left between it and one that goes the same way.
  bool runsBeside(const Corridor& corridor) const {
    const CellBox a = boxOf(corridor, kWallBetween);
    return std::any_of(dug_.begin(), dug_.end(), [&](const Corridor& other) {
      const CellBox b = boxOf(other, 0.0);
      return other.along_x == corridor.along_x && a.left < b.right && b.left < a.right && a.bottom < b.top &&
             b.bottom < a.top;
    });
  }

  void dig(const Corridor& corridor) {
    fillBox(boxOf(corridor, 0.0), Cell::kFree, &grid_);
    dug_.push_back(corridor);
  }

  double extent() const {
    Point2 low = dug_[0].start;
    Point2 high = low;
    for (const Corridor& corridor : dug_) {
      const Point2 end = corridor.at(1.0);
      low = {std::min(low.x, end.x), std::min(low.y, end.y)};
      high = {std::max(high.x, end.x), std::max(high.y, end.y)};
    }
    return std::max(high.x - low.x, high.y - low.y);
  }

  const CorridorWorldParameters& parameters_;
  Random& random_;
  OccupancyGrid& grid_;
  std::vector<Corridor> dug_;
};

}  // namespace

OccupancyGrid generateCorridorWorld(const CorridorWorldParameters& parameters, std::uint64_t seed) {
  const double resolution = parameters.resolution;
  const OccupancyGrid solid(toCells(parameters.width, resolution), toCells(parameters.height, resolution), resolution,
                            {}, Cell::kOccupied);
  OccupancyGrid grid = solid;
  Random random(seed);
  // In one world of some hundred hardly a corridor finds room beside the first.
  for (int i = 1; Digger(parameters, random, &grid).dig() < kExtent && i < kWorlds; ++i) grid = solid;
  return grid;
}

}  // namespace lstm_planner
