#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "lstm_planner/grid/passable_grid.hpp"
#include "lstm_planner/grid_world/agent/grid_agent.hpp"

namespace lstm_planner {

/// One text a line of the map, as in a map file: `.` is passable.
inline PassableGrid gridFrom(const std::vector<std::string>& lines) {
  PassableGrid grid(static_cast<int>(lines.front().size()), static_cast<int>(lines.size()), false);
  for (std::size_t row = 0; row < lines.size(); ++row) {
    for (std::size_t column = 0; column < lines[row].size(); ++column) {
      if (lines[row][column] == '.') grid.set({static_cast<int>(column), static_cast<int>(row)}, true);
    }
  }
  return grid;
}

constexpr int kEast = 0;
constexpr int kNorthEast = 1;
constexpr int kWest = 4;

/// Decides for the given directions, again and again from the first. Three steps are the network's, the others those of
/// boundary following.
class ScriptedAgent : public GridAgent {
 public:
  explicit ScriptedAgent(std::vector<int> directions) : directions_(std::move(directions)) {}
  void start(CellIndex /*start*/, CellIndex /*goal*/) override { steps_ = 0; }
  void observe(const GridObservation& observation) override { observations.push_back(observation); }
  int decide() override { return directions_[steps_ % directions_.size()]; }
  GridLeader leader() const override { return steps_ < 3 ? GridLeader::kNetwork : GridLeader::kBoundary; }
  Overruled overruled() const override { return steps_ == 1 ? Overruled::kByShield : Overruled::kByBound; }
  bool onPath() const override { return steps_ == 0; }
  void step(int /*direction*/, bool moved) override {
    last_moved = moved;
    ++steps_;
  }
  std::size_t peakBytes() const override { return 100 + steps_; }

  std::vector<GridObservation> observations;
  bool last_moved = true;

 private:
  std::vector<int> directions_;
  std::size_t steps_ = 0;
};

}  // namespace lstm_planner
