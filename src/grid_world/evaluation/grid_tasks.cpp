#include "lstm_planner/grid_world/evaluation/grid_tasks.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <numeric>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "grid_world/search/a_star.hpp"
#include "lstm_planner/common/parallel_for.hpp"
#include "lstm_planner/common/random.hpp"

namespace lstm_planner {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLargestNumberedSet = 20;
constexpr int kTrainMaps = 6;

/// The name, without folders and ending, of the map that a scenario file is for.
std::string mapName(const std::string& scenario_file) {
  const fs::path named = mapNamedIn(scenario_file);
  const fs::path map = named.empty() ? fs::path(scenario_file).stem() : named.filename();
  return (map.extension() == ".map" ? map.stem() : map).string();
}

/// In the order of the files' names.
std::vector<GridMapFiles> mapsIn(const fs::path& folder) {
  std::vector<std::string> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".scen" && entry.is_regular_file()) files.push_back(entry.path().string());
  }
  std::sort(files.begin(), files.end());
  std::vector<GridMapFiles> maps;
  std::map<std::string, std::size_t> places;
  for (const std::string& file : files) {
    const std::string name = mapName(file);
    const std::size_t place = places.emplace(name, maps.size()).first->second;
    if (place == maps.size()) maps.push_back({name, {}});
    maps[place].scenario_files.push_back(file);
  }
  return maps;
}

/// The set that a folder is, if it is one.
std::optional<GridSetFiles> setIn(const fs::path& folder) {
  const fs::path scenarios = folder / "Scenarios";
  GridSetFiles files;
  if (fs::is_directory(scenarios)) {
    files = {folder.filename().string(), mapsIn(scenarios)};
  } else {
    const bool is_scenarios = folder.filename() == scenarios.filename();
    files = {(is_scenarios ? folder.parent_path() : folder).filename().string(), mapsIn(folder)};
  }
  if (files.maps.empty()) return std::nullopt;
  return files;
}

/// NAME of NAME-3; empty for a name that does not end in a hyphen and a number.
std::string numberedName(const std::string& name) {
  const std::size_t hyphen = name.rfind('-');
  if (hyphen == std::string::npos || hyphen + 1 == name.size()) return "";
  return name.find_first_not_of("0123456789", hyphen + 1) == std::string::npos ? name.substr(0, hyphen) : "";
}

/// The benchmark's archives hold several sets in one folder (maze512-1-0 ... maze512-32-9): one set a name then.
std::vector<GridSetFiles> splitByName(const GridSetFiles& files) {
  std::map<std::string, GridSetFiles> sets;
  for (const GridMapFiles& map : files.maps) {
    const std::string name = numberedName(map.name);
    if (name.empty()) return {files};
    sets[name].name = name;
    sets[name].maps.push_back(map);
  }
  if (sets.size() == 1) return {files};
  std::vector<GridSetFiles> split;
  for (auto& [name, set] : sets) split.push_back(std::move(set));
  return split;
}

/// The number that a map's name ends in, or its place where it ends in none.
int mapNumber(const std::string& name, std::size_t place) {
  std::size_t digits = name.size();
  while (digits > 0 && std::isdigit(static_cast<unsigned char>(name[digits - 1])) != 0) --digits;
  constexpr std::size_t kMostDigits = 9;
  if (digits == name.size() || name.size() - digits > kMostDigits) return static_cast<int>(place);
  return std::stoi(name.substr(digits));
}

struct FoundScenario {
  const GridMapFiles* map = nullptr;
  const std::string* file = nullptr;
  std::size_t line = 0;
  Scenario scenario;
};

/// Scenarios that were left out, by the reason.
struct LeftOut {
  std::size_t shorter = 0;
  std::size_t longer = 0;
  std::size_t without_path = 0;
  std::size_t with_blocked_end = 0;
};

std::string noScenarioMessage(const GridSetFiles& files, const ScenarioSelection& selection, std::size_t maps,
                              const LeftOut& left_out) {
  static const char* const kSelections[] = {"", "training ", "validation "};
  std::ostringstream message;
  message << "set " << files.name << " has no scenario to run in its " << maps << ' '
          << kSelections[static_cast<std::size_t>(selection.maps)] << "maps";
  const char* separator = ": ";
  const auto add = [&](std::size_t count, const auto&... why) {
    if (count == 0) return;
    message << separator << count;
    (message << ... << why);
    separator = ", ";
  };
  add(left_out.shorter, " shorter than ", selection.min_length, " cells");
  add(left_out.longer, " longer than ", selection.max_length, " cells");
  add(left_out.without_path, " of the optimal length 0 although start and goal differ: there is no path");
  add(left_out.with_blocked_end, " that start or end on a cell that is not passable");
  if (*separator == ':') message << ": the files name none";
  return message.str();
}

/// The scenarios that a selection asks for. Their maps are not looked at.
std::vector<FoundScenario> scenariosOf(const std::vector<GridMapFiles>& maps, const ScenarioSelection& selection,
                                       LeftOut* left_out) {
  std::vector<FoundScenario> found;
  for (const GridMapFiles& map : maps) {
    for (const std::string& file : map.scenario_files) {
      std::vector<Scenario> scenarios = readScenarios(file);
      for (std::size_t i = 0; i < scenarios.size(); ++i) {
        const double length = scenarios[i].optimal_length;
        if (length < selection.min_length) {
          ++left_out->shorter;
        } else if (length > selection.max_length) {
          ++left_out->longer;
        } else if (length == 0.0 && scenarios[i].start != scenarios[i].goal) {
          ++left_out->without_path;
        } else {
          found.push_back({&map, &file, i + kFirstScenarioLine, std::move(scenarios[i])});
        }
      }
    }
  }
  return found;
}

/// The places of `scenarios` in the order in which they are drawn, `count` of them or, for 0, all.
std::vector<std::size_t> drawingOrder(std::size_t scenarios, std::size_t count, std::uint64_t seed) {
  std::vector<std::size_t> order(scenarios);
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (count == 0 || count >= scenarios) return order;
  Random random(seed);
  shuffle(&order, random);
  return order;
}

/// Maps, each read when a scenario in it is drawn: a large set has a hundred, and few scenarios need few of them.
class MapsOfScenarios {
 public:
  explicit MapsOfScenarios(PassableRule rule) : rule_(rule) {}

  /// Whether start and goal are passable. Throws MovingAiFileError for a scenario that does not fit its map.
  bool canBeRun(const FoundScenario& one) {
    const PassableGrid& map = grid(pathFor(*one.file));
    const auto is_blocked = [&map](CellIndex cell) { return map.contains(cell) && !map.passable(cell); };
    if (is_blocked(one.scenario.start) || is_blocked(one.scenario.goal)) return false;
    checkScenario(one.scenario, one.line, map, *one.file);
    return true;
  }

  const std::string& pathFor(const std::string& scenario_file) {
    std::string& path = paths_[scenario_file];
    if (path.empty()) path = mapOfScenarioFile(scenario_file);
    return path;
  }

  PassableGrid take(const std::string& path) { return std::move(grid(path)); }

 private:
  PassableGrid& grid(const std::string& path) {
    PassableGrid& map = grids_[path];
    if (map.size() == 0) map = readMovingAiMap(path, rule_);
    return map;
  }

  PassableRule rule_;
  std::map<std::string, std::string> paths_;
  std::map<std::string, PassableGrid> grids_;
};

/// `count` of the scenarios, or all, in their order, drawn without putting back. In place of one that cannot be run,
/// another one is drawn.
std::vector<FoundScenario> drawSome(std::vector<FoundScenario> found, const ScenarioSelection& selection,
                                    MapsOfScenarios* maps, LeftOut* left_out) {
  std::vector<std::size_t> kept;
  for (const std::size_t place : drawingOrder(found.size(), selection.count, selection.seed)) {
    if (selection.count > 0 && kept.size() == selection.count) break;
    if (maps->canBeRun(found[place])) {
      kept.push_back(place);
    } else {
      ++left_out->with_blocked_end;
    }
  }
  std::sort(kept.begin(), kept.end());
  std::vector<FoundScenario> drawn;
  for (const std::size_t place : kept) drawn.push_back(std::move(found[place]));
  return drawn;
}

void addTasks(const std::vector<FoundScenario>& drawn, MapsOfScenarios* maps, GridTaskSet* set) {
  std::map<std::string, std::size_t> places;
  for (const FoundScenario& one : drawn) {
    const std::string& path = maps->pathFor(*one.file);
    const auto [place, is_new] = places.try_emplace(path, set->maps.size());
    if (is_new) {
      set->maps.push_back(maps->take(path));
      set->map_names.push_back(one.map->name);
    }
    set->tasks.push_back({place->second, one.scenario.start, one.scenario.goal, one.scenario.optimal_length});
  }
}

}  // namespace

std::vector<GridSetFiles> findGridSets(const std::string& folder) {
  if (!fs::is_directory(folder)) {
    throw std::invalid_argument("scenarios '" + folder + "' cannot be read: expected a folder with .scen files");
  }
  const fs::path path = fs::canonical(folder);
  if (const std::optional<GridSetFiles> set = setIn(path)) return splitByName(*set);
  std::vector<GridSetFiles> sets;
  for (const fs::directory_entry& entry : fs::directory_iterator(path)) {
    if (!entry.is_directory()) continue;
    const std::optional<GridSetFiles> set = setIn(entry.path());
    if (!set) continue;
    for (GridSetFiles& named : splitByName(*set)) sets.push_back(std::move(named));
  }
  const fs::path of_sets = path / "scenarios";
  if (sets.empty() && fs::is_directory(of_sets)) return findGridSets(of_sets.string());
  if (sets.empty()) {
    throw std::invalid_argument("folder '" + folder + "' has no scenarios: expected .scen files in it, in " +
                                "Scenarios/, in SET/Scenarios/ or in scenarios/SET/");
  }
  std::sort(sets.begin(), sets.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  return sets;
}

std::vector<GridMapFiles> selectMaps(const GridSetFiles& files, MapSelection selection) {
  if (selection == MapSelection::kAll) return files.maps;
  const std::size_t maps = files.maps.size();
  std::vector<GridMapFiles> selected;
  for (std::size_t place = 0; place < maps; ++place) {
    const GridMapFiles& map = files.maps[place];
    const bool train = maps > kLargestNumberedSet ? place < maps / 2 : mapNumber(map.name, place) < kTrainMaps;
    if (train == (selection == MapSelection::kTrain)) selected.push_back(map);
  }
  return selected;
}

GridTaskSet drawGridTasks(const GridSetFiles& files, const ScenarioSelection& selection) {
  const std::vector<GridMapFiles> selected = selectMaps(files, selection.maps);
  LeftOut left_out;
  MapsOfScenarios maps(selection.rule);
  const std::vector<FoundScenario> drawn =
      drawSome(scenariosOf(selected, selection, &left_out), selection, &maps, &left_out);
  if (drawn.empty()) throw std::invalid_argument(noScenarioMessage(files, selection, selected.size(), left_out));
  GridTaskSet set;
  set.name = files.name;
  set.without_path = left_out.without_path;
  set.with_blocked_end = left_out.with_blocked_end;
  addTasks(drawn, &maps, &set);
  return set;
}

void allowCornerCutting(GridTaskSet* set, int threads) {
  AStarParameters parameters;
  parameters.corner_cutting = CornerCutting::kAllowed;
  parallelFor(static_cast<int>(set->tasks.size()), threads, [&](int index, int) {
    GridTask& task = set->tasks[static_cast<std::size_t>(index)];
    const GridPath path = AStar(set->maps[task.map], parameters).find(task.start, task.goal).path;
    if (path.found()) task.optimal_length = path.length();
  });
}

}  // namespace lstm_planner
