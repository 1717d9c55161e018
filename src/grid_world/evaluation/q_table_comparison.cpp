#include "lstm_planner/grid_world/evaluation/q_table_comparison.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "lstm_planner/common/markdown_table.hpp"
#include "lstm_planner/common/parameter_check.hpp"
#include "lstm_planner/common/text_table.hpp"
#include "lstm_planner/grid/map_generators.hpp"
#include "lstm_planner/grid_world/search/grid_distances.hpp"

namespace lstm_planner {
namespace {

/// Cells of the shortest path from a start to the goal, at the least.
constexpr float kShortest = 5.0f;

constexpr int kSmallestSize = 8;

/// Small maps on which a table learns, each with a goal of its own.
struct SmallMaps {
  std::string name;
  std::function<PassableGrid(std::uint64_t seed)> generate;
};

/// Mazes with corridors two cells wide, random fill of a quarter, and caves, of `size` cells square.
std::vector<SmallMaps> smallMaps(int size) {
  MazeParameters maze;
  maze.columns = maze.rows = size;
  maze.corridor_width = 2;
  RandomFillParameters random;
  random.columns = random.rows = size;
  CaveParameters caves;
  caves.columns = caves.rows = size;
  return {{"mazes", [=](std::uint64_t seed) { return generateMaze(maze, seed); }},
          {"random fill", [=](std::uint64_t seed) { return generateRandomFill(random, seed); }},
          {"caves", [=](std::uint64_t seed) { return generateCaves(caves, seed); }}};
}

/// A map with two goals that can be reached from each other and starts for both.
struct Place {
  PassableGrid grid;
  std::vector<CellIndex> cells;  ///< from which the goals can be reached
  CellIndex goal;
  CellIndex other_goal;
  std::vector<CellIndex> starts;
};

CellIndex drawCell(const std::vector<CellIndex>& cells, Random& random) {
  return cells[uniformIndex(random, cells.size())];
}

std::vector<CellIndex> cellsFrom(const PassableGrid& grid, const GridDistances& distances, float shortest) {
  std::vector<CellIndex> cells;
  for (const CellIndex cell : grid.cells()) {
    const float distance = distances.at(cell);
    if (std::isfinite(distance) && distance >= shortest) cells.push_back(cell);
  }
  return cells;
}

Place makePlace(const QTableComparisonParameters& parameters, const SmallMaps& maps, std::uint64_t seed) {
  Random random(seed);
  constexpr int kAttempts = 1000;
  Place place;
  place.grid = maps.generate(seed);
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    const CellIndex goal{static_cast<int>(uniformIndex(random, static_cast<std::size_t>(place.grid.columns()))),
                         static_cast<int>(uniformIndex(random, static_cast<std::size_t>(place.grid.rows())))};
    if (!place.grid.passable(goal)) continue;
    const GridDistances distances(place.grid, goal, parameters.table.corner_cutting);
    const std::vector<CellIndex> far = cellsFrom(place.grid, distances, kShortest);
    if (far.empty()) continue;
    place.goal = goal;
    place.cells = cellsFrom(place.grid, distances, 0.0f);
    place.other_goal = drawCell(far, random);
    for (int start = 0; start < parameters.starts; ++start) place.starts.push_back(drawCell(far, random));
    return place;
  }
  throw std::runtime_error("a map of " + maps.name + " has no two cells far enough from each other");
}

/// The place's starts with the paths to a goal; those too near to it are left out.
void appendTasks(const QTableComparisonParameters& parameters, const Place& place, CellIndex goal, std::size_t map,
                 GridTaskSet* set) {
  const GridDistances distances(place.grid, goal, parameters.table.corner_cutting);
  for (const CellIndex& start : place.starts) {
    const float distance = distances.at(start);
    if (distance >= kShortest) set->tasks.push_back({map, start, goal, static_cast<double>(distance)});
  }
}

/// The kind's maps and what is learned about them.
class Contest {
 public:
  Contest(const QTableComparisonParameters& parameters, const SmallMaps& maps) : parameters_(parameters) {
    for (int map = 0; map < parameters.maps; ++map) {
      places_.push_back(makePlace(parameters, maps, parameters.seed + static_cast<std::uint64_t>(map)));
    }
    tables_.reserve(places_.size());
    for (const Place& place : places_) {
      tables_.emplace_back(parameters.table, place.grid, place.goal);
      randoms_.emplace_back(parameters.seed + tables_.size());
    }
  }

  void learn(int episodes) {
    for (; episodes_ < episodes; ++episodes_) {
      for (std::size_t i = 0; i < places_.size(); ++i) {
        tables_[i].runEpisode(drawCell(places_[i].cells, randoms_[i]), randoms_[i]);
      }
    }
  }

  std::int64_t stepsAMap() const {
    std::int64_t steps = 0;
    for (const QTable& table : tables_) steps += table.steps();
    return steps / static_cast<std::int64_t>(tables_.size());
  }

  QTableRow judgeTables(const std::string& name, CellIndex Place::*goal) const {
    QTableRow row{name, stepsAMap(), 0.0, 0.0};
    std::vector<GridEpisode> episodes;
    for (std::size_t i = 0; i < places_.size(); ++i) {
      const auto make = [&](const PassableGrid&) { return std::make_unique<QTableAgent>(tables_[i]); };
      append(judge(i, places_[i].*goal, make), &episodes);
    }
    return filled(row, episodes);
  }

  QTableRow judgeOther(const std::string& name, const GridAgentMaker& make) const {
    std::vector<GridEpisode> episodes;
    for (std::size_t i = 0; i < places_.size(); ++i) append(judge(i, places_[i].goal, make), &episodes);
    return filled({name, 0, 0.0, 0.0}, episodes);
  }

 private:
  static void append(const std::vector<GridEpisode>& more, std::vector<GridEpisode>* episodes) {
    episodes->insert(episodes->end(), more.begin(), more.end());
  }

  std::vector<GridEpisode> judge(std::size_t place, CellIndex goal, const GridAgentMaker& make) const {
    GridTaskSet set;
    set.maps = {places_[place].grid};
    appendTasks(parameters_, places_[place], goal, 0, &set);
    GridEvaluationOptions options;
    options.rules.corner_cutting = parameters_.table.corner_cutting;
    options.rules.max_steps = parameters_.max_steps;
    options.threads = parameters_.threads;
    return evaluateGridTasks(set, 0, set.tasks.size(), make, options);
  }

  static QTableRow filled(QTableRow row, const std::vector<GridEpisode>& episodes) {
    row.arrived = row.ratio = std::nan("");
    if (episodes.empty()) return row;  // all starts are near the other goal
    const GridSetSummary summary = summarizeGridEpisodes(row.agent, episodes);
    row.arrived = summary.share(summary.arrived);
    row.ratio = summary.mean_ratio;
    return row;
  }

  const QTableComparisonParameters& parameters_;
  std::vector<Place> places_;
  std::vector<QTable> tables_;
  std::vector<Random> randoms_;
  int episodes_ = 0;
};

}  // namespace

void validate(const QTableComparisonParameters& parameters) {
  validate(parameters.table);
  checkParameter(parameters.size >= kSmallestSize, "size", parameters.size, "at least 8 cells");
  checkAtLeastOne("maps", parameters.maps);
  checkAtLeastOne("starts", parameters.starts);
  checkAtLeastOne("max_steps", parameters.max_steps);
  checkAtLeastOne("threads", parameters.threads);
  if (parameters.episodes.empty() || !std::is_sorted(parameters.episodes.begin(), parameters.episodes.end())) {
    throw std::invalid_argument("episodes are none or not rising, expected one number or more that rise");
  }
  checkAtLeastOne("episodes", parameters.episodes.front());
}

std::vector<QTableOutcome> compareQTables(const QTableComparisonParameters& parameters,
                                          const std::vector<std::pair<std::string, GridAgentMaker>>& others,
                                          const std::function<void(double)>& progress) {
  validate(parameters);
  std::vector<QTableOutcome> outcomes;
  const std::vector<SmallMaps> kinds = smallMaps(parameters.size);
  for (const SmallMaps& kind : kinds) {
    Contest contest(parameters, kind);
    QTableOutcome outcome{kind.name, {}};
    for (const int episodes : parameters.episodes) {
      contest.learn(episodes);
      const std::string name = "table, " + std::to_string(episodes) + " episodes";
      outcome.rows.push_back(contest.judgeTables(name, &Place::goal));
    }
    outcome.rows.push_back(contest.judgeTables("the same table, another goal", &Place::other_goal));
    for (const auto& [name, make] : others) outcome.rows.push_back(contest.judgeOther(name, make));
    outcomes.push_back(std::move(outcome));
    if (progress) progress(static_cast<double>(outcomes.size()) / static_cast<double>(kinds.size()));
  }
  return outcomes;
}

std::string toMarkdown(const std::vector<QTableOutcome>& outcomes) {
  std::ostringstream text;
  MarkdownTable table({"maps", "agent", "steps learned from, a map", "arrived", "length / optimum"}, &text);
  for (const QTableOutcome& outcome : outcomes) {
    for (const QTableRow& row : outcome.rows) {
      table.row({outcome.maps, row.agent, row.steps > 0 ? std::to_string(row.steps) : "-",
                 std::isfinite(row.arrived) ? fixedText(100.0 * row.arrived, 1) + " %" : "-",
                 std::isfinite(row.ratio) ? fixedText(row.ratio, 3) : "-"});
    }
  }
  return text.str();
}

}  // namespace lstm_planner
