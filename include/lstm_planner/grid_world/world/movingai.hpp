#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "lstm_planner/grid/passable_grid.hpp"

namespace lstm_planner {

// The files of the grid benchmark that the thesis uses (N. Sturtevant, "Benchmarks for Grid-Based Pathfinding", 2012,
// movingai.com). Lines end in LF or CR LF, the last one may end without; empty lines may follow it.

/// A map or scenario file that cannot be used; what() is one sentence with the file, the line and what was expected.
class MovingAiFileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Which letters of a map may be entered. All letters of the format are read under both rules: `.` and `G` (ground),
/// `S` (swamp), `W` (water), `T` (trees), `@` and `O` (out of bounds).
enum class PassableRule {
  /// `.`, `G` and `S`. The format calls swamp "passable from regular terrain" and water "traversable, but not passable
  /// from terrain". Swamp is therefore ground here; water, which a robot on ground can never enter, is blocked.
  kBenchmark,
  kThesis,  ///< `.` only
};

/// Reads a `.map` file of type octile: `type octile`, then `height ROWS` and `width COLUMNS` in either order, `map`,
/// and the rows. Throws MovingAiFileError for anything else, before memory for the grid is allocated: sizes that are
/// not positive numbers or larger than PassableGrid allows, too few or too many rows, rows of another length, other
/// letters.
PassableGrid readMovingAiMap(const std::string& path, PassableRule rule = PassableRule::kBenchmark);

/// Writes passable cells as `.`, others as `@`. Throws MovingAiFileError when the file cannot be written or the grid
/// has no cells.
void writeMovingAiMap(const std::string& path, const PassableGrid& grid);

/// One line of a `.scen` file, version 1.
struct Scenario {
  int bucket = 0;   ///< floor(optimal length / 4) in the benchmark's files
  std::string map;  ///< as written in the file, often with folders: see mapOfScenarioFile()
  int columns = 0;  ///< size of the map that the scenario is meant for
  int rows = 0;
  CellIndex start;
  CellIndex goal;
  double optimal_length = 0.0;  ///< cells, without corner cutting; 6 significant digits
};

/// Scenario i is line i + 2 of its file: `version` is the first line, and no line between scenarios may be empty.
constexpr std::size_t kFirstScenarioLine = 2;

/// Reads a `.scen` file (`version 1` or `version 1.0`). Throws MovingAiFileError, also for a start or a goal outside
/// the size that the scenario itself names. The map file is not read: see checkScenario().
std::vector<Scenario> readScenarios(const std::string& path);

/// Writes version 1 with lengths of 6 significant digits. Throws MovingAiFileError when the file cannot be written or a
/// scenario could not be read again.
void writeScenarios(const std::string& path, const std::vector<Scenario>& scenarios);

/// Throws MovingAiFileError naming `path` and the scenario's line in that file if the scenario does not fit the map:
/// another size, or a start or goal that is outside or in a wall.
void checkScenario(const Scenario& scenario, std::size_t line, const PassableGrid& grid, const std::string& path);

/// The map that a scenario file names, as written in its first scenario; empty if it has no scenario. Throws
/// MovingAiFileError for a file whose first scenario cannot be read.
std::string mapNamedIn(const std::string& scenario_path);

/// The file of the map that all scenarios of a file name. It is looked for at the named path, absolute or from the
/// scenario file's folder, the folder above it, or `Maps` beside it; then by its name alone in these folders; then,
/// because a map may have been renamed with its scenario file, as NAME.map of NAME.map.scen; then, for files in
/// `scenarios/SET`, by its name alone in `maps/SET`, and at the named path from the folder above `scenarios`. Throws
/// MovingAiFileError if it is not found, with the places, or if the scenarios name several maps.
std::string mapOfScenarioFile(const std::string& scenario_path);

}  // namespace lstm_planner
