#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "lstm_planner/grid/occupancy_grid.hpp"

namespace lstm_planner {

/// How often and how long ago an agent was at a place.
struct Visit {
  int count = 0;  ///< times that it came in; 0 = never, as far as it is remembered
  int age = 0;    ///< steps since it was there last; 0 = it is there now
};

/// A bounded memory of where the agent has been, on three scales: cells, and square blocks of 4 and of 8 cells.
///
/// Each scale is a window of fixed size that lies over the plane like a torus: a place takes the entry of another that
/// lies a whole window away, of which it forgets. 24 KiB, whatever the map.
class VisitTrace {
 public:
  enum Scale { kCell = 0, kSmallBlock = 1, kLargeBlock = 2 };
  static constexpr int kScales = 3;

  VisitTrace();

  void clear();

  /// The agent is in `cell` now; each call is one step later than the one before. Whether its large block is new.
  bool visit(CellIndex cell);

  /// About the block of a scale that `cell` lies in.
  Visit at(Scale scale, CellIndex cell) const;

  static std::size_t bytes();

 private:
  /// What is remembered of a place.
  struct Entry {
    std::uint16_t stamp = 0;
    std::uint8_t count = 0;
    std::uint8_t tag = 0;  ///< which of the places that share the entry
  };
  /// Where that stands.
  struct Place {
    std::size_t entry;
    std::uint8_t tag;
  };
  static Place placeOf(Scale scale, CellIndex cell);

  std::vector<Entry> entries_;
  std::uint16_t now_ = 0;
  std::array<CellIndex, kScales> blocks_;  ///< where the agent is
};

}  // namespace lstm_planner
