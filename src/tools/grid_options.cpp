#include "tools/grid_options.hpp"

#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "tools/command_line.hpp"

namespace lstm_planner {
namespace {

const Choices<Heuristic> kHeuristicNames = {{"manhattan", Heuristic::kManhattan},
                                            {"chebyshev", Heuristic::kChebyshev},
                                            {"octile", Heuristic::kOctile},
                                            {"euclidean", Heuristic::kEuclidean},
                                            {"scaled_euclidean", Heuristic::kScaledEuclidean}};

void finish(GridOptions* options) {
  ScenarioSelection& selection = options->selection;
  if (selection.min_length > selection.max_length) {
    std::ostringstream message;
    message << "--min-length is " << selection.min_length << " and --max-length " << selection.max_length
            << ", expected 0 <= min <= max";
    throw std::invalid_argument(message.str());
  }
  options->agent.corner_cutting = options->evaluation.rules.corner_cutting;
  options->agent.costs = moveCosts(options->straight_cost, options->diagonal_cost);
}

/// As many steps as of the robot (AgentParameters::draw_after).
constexpr int kDrawAfter = 60;

}  // namespace

void addGridOptions(GridOptions* options, CommandLine* line) {
  ScenarioSelection& selection = options->selection;
  GridEpisodeRules& rules = options->evaluation.rules;
  GridAgentOptions& agent = options->agent;
  selection.count = 0;
  agent.network.draw_after = kDrawAfter;
  line->addFiles(
          "scenarios", &options->folders,
          "folders: sets of the MovingAI benchmark (with Maps and Scenarios in them), their Scenarios folders, or "
          "folders of such sets")
      .required();
  line->addChoice("maps", &selection.maps, kMapSelections,
                  "train (maps 0-5 of a set, or the first half of more than 20 maps), validation (the others) or all");
  line->add("min-length", &selection.min_length, kAnyLength,
            "cells; smallest length of the shortest path, as the scenario says: without corner cutting");
  line->add("max-length", &selection.max_length, kAnyLength, "cells; largest length of it (default: no limit)");
  line->add("count", &selection.count, {0, 1e9}, "scenarios of each set; 0 = all");
  line->addSeed(&selection.seed, "seed of the random choice of scenarios");
  line->add("max-steps", &rules.max_steps, {0, 1e12},
            "largest number of steps of an episode; 0 = no limit, but walking in circles among known cells counts as a "
            "timeout");
  line->addFlag("corner-cutting", &rules.corner_cutting, CornerCutting::kAllowed,
                "diagonal moves may pass blocked cells at their sides");
  line->addFlag("thesis-terrain", &selection.rule, PassableRule::kThesis, "only '.' is passable, not 'G' and 'S'");
  line->addFlag("no-shield", &agent.network.shield, false,
                "a network may choose moves into obstacles, which end the episode");
  line->addFlag(
      "no-escape", &agent.network.guided, false,
      "nothing is remembered for a network, and no bound limits its detours: the network and the shield alone");
  line->add("detour-allowance", &agent.network.detour.allowance, kAnyLength,
            "cells; the regrets of a network's moves since the start, against the remembered path, may be as large as "
            "this and --detour-share of the path walked");
  line->add("detour-share", &agent.network.detour.share, kAnyShare, "share of the path walked; see --detour-allowance");
  line->add("draw-after", &agent.network.draw_after, {0, 1e9},
            "with --no-escape: steps without progress after which a network's moves are drawn with the probabilities "
            "that it gives, so that it leaves circles; 0 = never");
  line->addChoice(
      "heuristic", &agent.heuristic, kHeuristicNames,
      "heuristic of A*: manhattan, chebyshev, octile, euclidean or scaled_euclidean (25 times, thesis Eq. 1.5)");
  line->addFlag("keep-closed", &agent.keep_closed, true,
                "A* expands no cell twice, even if an overestimating heuristic first found it by a detour");
  line->addFlag("four-moves", &agent.diagonal_moves, false, "A* makes no diagonal moves");
  line->add("straight-cost", &options->straight_cost, {0.01, 100.0},
            "cost of a straight move in A*: c of the thesis (Eq. 1.3)");
  line->add(
      "diagonal-cost", &options->diagonal_cost, {0.01, 200.0},
      "cost of a diagonal move in A*: d of the thesis (Eq. 1.4), from c to 2 c; the printed lengths are true lengths");
  line->add("threads", &options->evaluation.threads, kAnyThreads,
            "number of episodes at the same time; does not change the result");
  line->whenParsed([options] { finish(options); });
}

std::vector<GridTaskSet> drawGridTaskSets(const GridOptions& options) {
  std::vector<GridTaskSet> sets;
  for (const std::string& folder : options.folders) {
    for (const GridSetFiles& files : findGridSets(folder)) {
      const auto has_its_name = [&](const GridTaskSet& set) { return set.name == files.name; };
      if (std::any_of(sets.begin(), sets.end(), has_its_name)) {
        throw std::invalid_argument("set " + files.name + " is given twice, again in '" + folder + "'");
      }
      sets.push_back(drawTasksOfSet(files, options.selection, options.evaluation));
    }
  }
  return sets;
}

GridTaskSet drawTasksOfSet(const GridSetFiles& files, const ScenarioSelection& selection,
                           const GridEvaluationOptions& evaluation) {
  GridTaskSet set = drawGridTasks(files, selection);
  if (evaluation.rules.corner_cutting == CornerCutting::kAllowed) allowCornerCutting(&set, evaluation.threads);
  return set;
}

}  // namespace lstm_planner
