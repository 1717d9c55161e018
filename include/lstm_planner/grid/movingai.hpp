#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "lstm_planner/grid/passable_grid.hpp"

namespace lstm_planner {

/// A map or scenario file that cannot be used; what() is one sentence with the file, the line and what was expected.
class MovingAiFileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Which letters of a map may be entered. `.` and `G` are ground, `S` is swamp, `W` water, `@`, `O` and `T` (trees) are
/// blocked everywhere.
enum class PassableRule {
  kBenchmark,  ///< `.`, `G` and `S`; see the header of the benchmark's format: swamp is passable from ground
  kThesis,     ///< `.` only
};

/// Reads a MovingAI `.map` file (type octile). Throws MovingAiFileError.
PassableGrid readMovingAiMap(const std::string& path, PassableRule rule = PassableRule::kBenchmark);

/// Writes passable cells as `.`, others as `@`. Throws MovingAiFileError when the file cannot be written.
void writeMovingAiMap(const std::string& path, const PassableGrid& grid);

/// One line of a `.scen` file, version 1.
struct Scenario {
  int bucket = 0;
  std::string map;  ///< as written in the file
  int columns = 0;  ///< size of the map that the scenario is meant for
  int rows = 0;
  CellIndex start;
  CellIndex goal;
  double optimal_length = 0.0;  ///< cells, without corner cutting; 6 significant digits
};

/// Reads a `.scen` file. Throws MovingAiFileError.
std::vector<Scenario> readScenarios(const std::string& path);
void writeScenarios(const std::string& path, const std::vector<Scenario>& scenarios);

/// Throws MovingAiFileError naming `path` and the scenario's line (its place in the file) when it does not fit the map:
/// another size, start or goal outside or in a wall.
void checkScenario(const Scenario& scenario, std::size_t line, const PassableGrid& grid, const std::string& path);

/// The map file that a scenario file of the benchmark's folders belongs to: `<set>/Scenarios/NAME.map.scen` is about
/// `<set>/Maps/NAME.map`; a map beside the scenario file comes first.
std::string mapOfScenarioFile(const std::string& scenario_path);

}  // namespace lstm_planner
