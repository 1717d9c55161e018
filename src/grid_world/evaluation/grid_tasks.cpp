#include "lstm_planner/grid_world/evaluation/grid_tasks.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <utility>

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

struct DrawnScenario {
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
  std::size_t in_swamp = 0;
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
  add(left_out.in_swamp, " with start or goal in swamp");
  if (*separator == ':') message << ": the files name none";
  return message.str();
}

/// `count` of them in their order, drawn without putting back.
void keepSome(std::size_t count, std::uint64_t seed, std::vector<DrawnScenario>* scenarios) {
  if (count == 0 || count >= scenarios->size()) return;
  std::vector<std::size_t> order(scenarios->size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  Random random(seed);
  shuffle(&order, random);
  order.resize(count);
  std::sort(order.begin(), order.end());
  std::vector<DrawnScenario> kept;
  for (const std::size_t i : order) kept.push_back(std::move((*scenarios)[i]));
  *scenarios = std::move(kept);
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
  if (sets.empty()) {
    throw std::invalid_argument("folder '" + folder + "' has no scenarios: expected .scen files in it, in " +
                                "Scenarios/ or in SET/Scenarios/");
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
  const std::vector<GridMapFiles> maps = selectMaps(files, selection.maps);
  GridTaskSet set;
  set.name = files.name;
  LeftOut left_out;
  std::vector<DrawnScenario> drawn;
  for (const GridMapFiles& map : maps) {
    for (const std::string& file : map.scenario_files) {
      std::vector<Scenario> scenarios = readScenarios(file);
      for (std::size_t i = 0; i < scenarios.size(); ++i) {
        const double length = scenarios[i].optimal_length;
        if (length < selection.min_length) {
          ++left_out.shorter;
        } else if (length > selection.max_length) {
          ++left_out.longer;
        } else if (length == 0.0 && scenarios[i].start != scenarios[i].goal) {
          ++left_out.without_path;
        } else {
          drawn.push_back({&map, &file, i + kFirstScenarioLine, std::move(scenarios[i])});
        }
      }
    }
  }
  set.without_path = left_out.without_path;
  keepSome(selection.count, selection.seed, &drawn);

  const std::string* file = nullptr;
  std::string loaded;
  for (const DrawnScenario& one : drawn) {
    const Scenario& scenario = one.scenario;
    if (one.file != file) {
      file = one.file;
      const std::string path = mapOfScenarioFile(*file);
      if (path != loaded) {
        loaded = path;
        set.maps.push_back(readMovingAiMap(path, selection.rule));
        set.map_names.push_back(one.map->name);
      }
    }
    const PassableGrid& map = set.maps.back();
    const bool swamp_ends = selection.rule == PassableRule::kThesis && map.contains(scenario.start) &&
                            map.contains(scenario.goal) &&
                            !(map.passable(scenario.start) && map.passable(scenario.goal));
    if (swamp_ends) {
      ++left_out.in_swamp;
      continue;
    }
    checkScenario(scenario, one.line, map, *one.file);
    set.tasks.push_back({set.maps.size() - 1, scenario.start, scenario.goal, scenario.optimal_length});
  }
  if (set.tasks.empty()) throw std::invalid_argument(noScenarioMessage(files, selection, maps.size(), left_out));
  return set;
}

}  // namespace lstm_planner
