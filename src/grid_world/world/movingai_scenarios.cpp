#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <limits>
#include <locale>
#include <sstream>

#include "grid_world/world/movingai_text.hpp"
#include "lstm_planner/common/output_file.hpp"
#include "lstm_planner/grid_world/world/movingai.hpp"

namespace lstm_planner {
namespace {

constexpr std::uintmax_t kLargestScenarioFile = std::uintmax_t{1} << 26;  // about a million scenarios
constexpr std::size_t kLongestLine = 4096;                                // letters, most of them the map's name
constexpr std::size_t kFields = 9;
constexpr int kDigits = 6;

std::string named(CellIndex cell) { return "(" + std::to_string(cell.column) + ", " + std::to_string(cell.row) + ")"; }

std::string named(int columns, int rows) { return std::to_string(columns) + " x " + std::to_string(rows) + " cells"; }

/// Whether a name stands in one line between tabs as it is.
bool isMapName(const std::string& name) {
  const auto isControl = [](char letter) { return static_cast<unsigned char>(letter) < 0x20; };
  return !name.empty() && name.front() != ' ' && name.back() != ' ' &&
         std::none_of(name.begin(), name.end(), isControl);
}

/// Reads the lines behind the version, one after the other.
class ScenarioReader {
 public:
  explicit ScenarioReader(const std::string& path) : lines_("scenario file", path, kLargestScenarioFile) {
    number_.imbue(std::locale::classic());
  }

  std::vector<Scenario> read(std::size_t most = std::numeric_limits<std::size_t>::max()) {
    lines_.next();
    const std::vector<std::string_view> version = wordsOf(lines_.line().substr(0, kLongestLine));
    if (version.size() != 2 || version[0] != "version" || (version[1] != "1" && version[1] != "1.0")) {
      lines_.refuse(printable(lines_.line()) + ", expected 'version 1'");
    }
    std::vector<Scenario> scenarios;
    while (scenarios.size() < most && !lines_.onlyEmptyLinesFollow()) {
      lines_.next();
      scenarios.push_back(scenario());
    }
    return scenarios;
  }

 private:
  Scenario scenario() {
    if (lines_.line().size() > kLongestLine) {
      lines_.refuse("the line has " + std::to_string(lines_.line().size()) + " letters, expected at most " +
                    std::to_string(kLongestLine));
    }
    words_ = wordsOf(lines_.line());
    if (words_.size() < kFields) {
      lines_.refuse("a scenario of " + std::to_string(words_.size()) +
                    " fields, expected 9: bucket, map, its width and height, start column and row, goal column and "
                    "row, optimal length");
    }
    // The map's name may hold blanks: the other fields are counted from both ends.
    const std::size_t sizes = words_.size() - 7;
    Scenario scenario;
    scenario.bucket = integer("the bucket", words_[0], 0);
    const char* const map_end = words_[sizes - 1].data() + words_[sizes - 1].size();
    scenario.map.assign(words_[1].data(), map_end);
    if (!isMapName(scenario.map)) lines_.refuse("the map is " + printable(scenario.map) + ", expected a file's name");
    scenario.columns = integer("the map's width", words_[sizes], 1);
    scenario.rows = integer("the map's height", words_[sizes + 1], 1);
    scenario.start = {integer("the start's column", words_[sizes + 2], 0),
                      integer("the start's row", words_[sizes + 3], 0)};
    scenario.goal = {integer("the goal's column", words_[sizes + 4], 0),
                     integer("the goal's row", words_[sizes + 5], 0)};
    checkInside("start", scenario.start, scenario);
    checkInside("goal", scenario.goal, scenario);
    scenario.optimal_length = length(words_[sizes + 6]);
    return scenario;
  }

  // Names are no std::string here: making nine of them a line took longer than reading it.
  int integer(const char* name, std::string_view word, int least) const {
    int value = 0;
    if (!parseInteger(word, &value) || value < least) {
      lines_.refuse(name + (" is " + printable(word)) + ", expected a whole number of at least " +
                    std::to_string(least));
    }
    return value;
  }

  void checkInside(const char* name, CellIndex cell, const Scenario& scenario) const {
    if (cell.column < scenario.columns && cell.row < scenario.rows) return;
    lines_.refuse("the " + (name + (" " + named(cell))) + " lies outside the map of " +
                  named(scenario.columns, scenario.rows));
  }

  double length(std::string_view word) {
    double value = 0.0;
    number_.clear();
    number_.str(std::string(word));
    if (!(number_ >> value) || number_.peek() != std::istringstream::traits_type::eof() || !(value >= 0.0)) {
      lines_.refuse("the optimal length is " + printable(word) + ", expected a number of at least 0");
    }
    return value;
  }

  TextLines lines_;
  std::vector<std::string_view> words_;
  std::istringstream number_;
};

bool canBeReadAgain(const Scenario& scenario) {
  const auto inside = [&](CellIndex cell) {
    return cell.column >= 0 && cell.row >= 0 && cell.column < scenario.columns && cell.row < scenario.rows;
  };
  return isMapName(scenario.map) && scenario.bucket >= 0 && inside(scenario.start) && inside(scenario.goal) &&
         std::isfinite(scenario.optimal_length) && scenario.optimal_length >= 0.0;
}

void writeLines(const std::vector<Scenario>& scenarios, std::ostream* file) {
  file->imbue(std::locale::classic());  // no grouping of thousands
  *file << "version 1\n" << std::setprecision(kDigits);
  for (const Scenario& scenario : scenarios) {
    *file << scenario.bucket << '\t' << scenario.map << '\t' << scenario.columns << '\t' << scenario.rows << '\t'
          << scenario.start.column << '\t' << scenario.start.row << '\t' << scenario.goal.column << '\t'
          << scenario.goal.row << '\t' << scenario.optimal_length << '\n';
  }
}

/// The map that all scenarios of a file name; empty where there is none.
std::string commonMap(const std::string& path) {
  const std::vector<Scenario> scenarios = readScenarios(path);
  for (std::size_t i = 1; i < scenarios.size(); ++i) {
    if (scenarios[i].map == scenarios[0].map) continue;
    throw MovingAiFileError("the scenario file " + path + ", line " + std::to_string(i + kFirstScenarioLine) +
                            ": the map is " + printable(scenarios[i].map) + ", but that of the lines before is " +
                            printable(scenarios[0].map) + ", expected one map a file");
  }
  return scenarios.empty() ? "" : scenarios[0].map;
}

/// Where the map may be, the likeliest first.
std::vector<std::filesystem::path> placesOfMap(const std::string& named, const std::filesystem::path& scenario_path) {
  namespace fs = std::filesystem;
  const fs::path folder = scenario_path.parent_path();
  std::vector<fs::path> places;
  const auto add = [&](const fs::path& place) {
    const fs::path normal = place.lexically_normal();
    if (std::find(places.begin(), places.end(), normal) == places.end()) places.push_back(normal);
  };
  for (const fs::path& map : {fs::path(named), fs::path(named).filename(), scenario_path.stem()}) {
    if (map.empty()) continue;
    for (const fs::path& from : {folder, folder / "..", folder / ".." / "Maps"})
      add(from / map);  // or map, if absolute
  }
  if (named.empty()) return places;
  // scenarios/SET and maps/SET of the repository hog2. The map at the named path may have another size there.
  const fs::path root = folder / ".." / "..";
  add(root / "maps" / folder.filename() / fs::path(named).filename());
  add(root / named);
  return places;
}

}  // namespace

std::string mapNamedIn(const std::string& scenario_path) {
  const std::vector<Scenario> first = ScenarioReader(scenario_path).read(1);
  return first.empty() ? "" : first[0].map;
}

std::vector<Scenario> readScenarios(const std::string& path) { return ScenarioReader(path).read(); }

void writeScenarios(const std::string& path, const std::vector<Scenario>& scenarios) {
  for (std::size_t i = 0; i < scenarios.size(); ++i) {
    if (canBeReadAgain(scenarios[i])) continue;
    throw MovingAiFileError("the scenario file " + path + ", line " + std::to_string(i + kFirstScenarioLine) +
                            ": not written, expected a map with a name, start and goal inside it, and a finite length");
  }
  try {
    OutputFile file(path);
    writeLines(scenarios, &file.stream());
    file.commit();
  } catch (const OutputFileError& error) {
    throw MovingAiFileError("the scenario file " + path + " cannot be written: " + error.what());
  }
}

void checkScenario(const Scenario& scenario, std::size_t line, const PassableGrid& grid, const std::string& path) {
  const auto refuse = [&](const std::string& why) {
    throw MovingAiFileError("the scenario file " + path + ", line " + std::to_string(line) + ": " + why);
  };
  if (scenario.columns != grid.columns() || scenario.rows != grid.rows()) {
    refuse("a scenario for a map of " + named(scenario.columns, scenario.rows) + ", but the map has " +
           named(grid.columns(), grid.rows()));
  }
  const auto check = [&](const std::string& name, CellIndex cell) {
    if (!grid.contains(cell)) {
      refuse("the " + name + " " + named(cell) + " lies outside the map of " + named(grid.columns(), grid.rows()));
    }
    if (!grid.passable(cell)) refuse("the " + name + " " + named(cell) + " lies in a wall of the map");
  };
  check("start", scenario.start);
  check("goal", scenario.goal);
}

std::string mapOfScenarioFile(const std::string& scenario_path) {
  const std::string named = commonMap(scenario_path);
  std::string looked;
  for (const std::filesystem::path& place : placesOfMap(named, scenario_path)) {
    std::error_code error;  // what cannot be looked at is no map
    if (std::filesystem::is_regular_file(place, error)) return place.string();
    looked += (looked.empty() ? "" : ", ") + place.string();
  }
  throw MovingAiFileError("the scenario file " + scenario_path + " names " +
                          (named.empty() ? "no map" : "the map " + printable(named)) +
                          ", and there is none of these: " + looked);
}

}  // namespace lstm_planner
