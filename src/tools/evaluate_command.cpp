#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "lstm_planner/common/csv_writer.hpp"
#include "lstm_planner/common/words.hpp"
#include "lstm_planner/grid_world/evaluation/grid_agent_factory.hpp"
#include "lstm_planner/grid_world/evaluation/grid_evaluation.hpp"
#include "lstm_planner/grid_world/evaluation/grid_gallery.hpp"
#include "tools/command.hpp"
#include "tools/command_line.hpp"
#include "tools/grid_options.hpp"
#include "tools/output_file.hpp"
#include "tools/report_files.hpp"
#include "tools/shared_file.hpp"

namespace lstm_planner {

namespace {

struct EvaluateOptions {
  GridOptions grid;
  std::string json;
  std::string details;
  std::string pictures;
};

bool readOptions(const std::vector<std::string>& arguments, EvaluateOptions* options) {
  GridAgentOptions& agent = options->grid.agent;
  CommandLine line("evaluate", "prints how well an agent does in scenarios of grid maps");
  line.addChoice("agent", &agent.agent, gridAgentNames(), joined(gridAgentNames()));
  line.addFile("model", &agent.model, "ONNX file, if the agent is a network (default: the file in the package)");
  addGridOptions(&options->grid, &line);
  line.addOutput("json", &options->json,
                 "write the result to this file; success, collisions and timeouts are shares of the scenarios, means "
                 "are over the scenarios with success");
  line.addOutput("details", &options->details, "write one CSV line per scenario to this file");
  line.addFolder("pictures", &options->pictures,
                 "draw some failed scenarios, and the longest detour, of each set into this folder");
  line.whenParsed([&] {
    if (isNetworkAgent(agent.agent)) {
      agent.model = findSharedFile(line.given("model") ? agent.model : shippedModelOf(agent.agent));
    } else if (line.given("model")) {
      throw std::invalid_argument("agent " + agent.agent + " has no --model");
    }
    if (agent.agent != "astar") {
      line.refuseIdle({"heuristic", "keep-closed", "four-moves", "straight-cost", "diagonal-cost"},
                      "without --agent astar");
    }
    if (!isNetworkAgent(agent.agent)) line.refuseIdle({"no-shield", "no-escape"}, "with --agent " + agent.agent);
    if (!isNetworkAgent(agent.agent) || !agent.network.guided) {
      line.refuseIdle({"detour-allowance", "detour-share"}, "without a network under the bound");
    }
    if (agent.network.guided) line.refuseIdle({"draw-after"}, "without --no-escape");
  });
  return line.parse(arguments);
}

void writeJson(const EvaluateOptions& options, const std::vector<GridSetSummary>& summaries) {
  nlohmann::json json = {{"agent", options.grid.agent.agent}, {"model", options.grid.agent.model}};
  json["sets"] = nlohmann::json::array();
  for (const GridSetSummary& summary : summaries) json["sets"].push_back(toJson(summary));
  writeJsonFile(options.json, json);
}

/// The lines of one set.
void writeDetails(const GridTaskSet& set, const std::vector<GridEpisode>& episodes, CsvWriter* csv) {
  for (std::size_t i = 0; i < episodes.size(); ++i) {
    const GridTask& task = set.tasks[i];
    const GridEpisode& episode = episodes[i];
    csv->add(set.name, set.map_names[task.map], task.start.column, task.start.row, task.goal.column, task.goal.row,
             toString(episode.end), task.optimal_length, episode.length(), episode.steps(), episode.seconds,
             episode.expanded, episode.peak_bytes);
    csv->addAll(episode.led);
    csv->row(episode.on_path, episode.overruled_by_shield, episode.overruled_by_bound);
  }
}

void printLeftOut(const GridTaskSet& set, std::size_t scenarios, const std::string& why) {
  if (scenarios == 0) return;
  std::cout << "left out of " << set.name << ": " << scenarios << " scenarios " << why << '\n';
}

void drawSome(const EvaluateOptions& options, const GridTaskSet& set, const std::vector<GridEpisode>& episodes,
              const GridAgentMaker& make_agent) {
  std::vector<NamedGridAgent> agents = {{options.grid.agent.agent, make_agent}};
  if (options.grid.agent.agent != "astar") {
    GridAgentOptions optimal;
    optimal.agent = "astar";
    optimal.corner_cutting = options.grid.agent.corner_cutting;
    agents.push_back({"A*", gridAgentMaker(optimal)});
  }
  const auto drawTask = [&](const char* what, std::size_t task) {
    const std::string path = options.pictures + "/" + set.name + "_" + what + "_" + std::to_string(task) + ".png";
    writeGridPicture(path, set.maps[set.tasks[task].map],
                     pictureOfTask(set, task, agents, options.grid.evaluation.rules));
  };
  using End = GridEpisode::End;
  constexpr std::size_t kMisses = 3;
  for (const End end : {End::kCollision, End::kTimeout, End::kNoPath}) {
    const std::vector<std::size_t> missed = tasksThatEnded(episodes, end);
    for (std::size_t i = 0; i < std::min(kMisses, missed.size()); ++i) {
      drawTask(end == End::kNoPath ? "no_path" : toString(end), missed[i]);
    }
  }
  if (const auto task = typicalArrival(episodes)) drawTask("typical", *task);
  if (const auto task = longestDetour(episodes)) drawTask("longest_detour", *task);
}

}  // namespace

int runEvaluate(const std::vector<std::string>& arguments) {
  EvaluateOptions options;
  if (!readOptions(arguments, &options)) return 0;
  if (!options.pictures.empty()) makeOutputFolder(options.pictures);
  const GridAgentMaker make_agent = gridAgentMaker(options.grid.agent);
  GridComparison comparison;
  comparison.agents = {{{options.grid.agent.agent, make_agent}, false}};
  comparison.sets = drawGridTaskSets(options.grid);
  evaluateAll(options.grid.evaluation, &comparison);

  std::ostringstream details;
  CsvWriter csv(&details);
  csv.row("set", "map", "start_column", "start_row", "goal_column", "goal_row", "end", "optimum", "length", "steps",
          "seconds", "expanded", "peak_bytes", "network_steps", "search_steps", "boundary_steps", "greedy_steps",
          "network_steps_on_path", "steps_overruled_by_shield", "steps_overruled_by_bound");
  std::vector<GridSetSummary> summaries;
  for (std::size_t i = 0; i < comparison.sets.size(); ++i) {
    const GridTaskSet& set = comparison.sets[i];
    const std::vector<GridEpisode>& episodes = comparison.episodes[i].front();
    summaries.push_back(summarizeGridEpisodes(set.name, episodes));
    writeDetails(set, episodes, &csv);
  }
  printGridSummaries(std::cout, summaries);
  for (const GridTaskSet& set : comparison.sets) {
    printLeftOut(set, set.without_path, "without a path (length 0)");
    printLeftOut(set, set.with_blocked_end, "that start or end on a cell that is not passable");
  }
  if (!options.json.empty()) writeJson(options, summaries);
  if (!options.details.empty()) writeTextFile(options.details, details.str());
  if (options.pictures.empty()) return 0;
  for (std::size_t i = 0; i < comparison.sets.size(); ++i) {
    drawSome(options, comparison.sets[i], comparison.episodes[i].front(), make_agent);
  }
  return 0;
}

}  // namespace lstm_planner
