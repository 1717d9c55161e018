#include "tools/grid_options.hpp"

#include <algorithm>
#include <sstream>
#include <stdexcept>

namespace lstm_planner {
namespace {

MapSelection selectionNamed(const std::string& name) {
  if (name == "all") return MapSelection::kAll;
  if (name == "train") return MapSelection::kTrain;
  if (name == "validation") return MapSelection::kValidation;
  throw std::invalid_argument("--maps is '" + name + "', expected train, validation or all");
}

void checkNotNegative(const char* option, std::int64_t value) {
  if (value < 0) {
    throw std::invalid_argument(std::string(option) + " is " + std::to_string(value) + ", expected 0 or more");
  }
}

void checkPositive(const char* option, int value) {
  if (value < 1) {
    throw std::invalid_argument(std::string(option) + " is " + std::to_string(value) + ", expected at least 1");
  }
}

}  // namespace

void addGridOptions(GridOptions* options, boost::program_options::options_description* description) {
  namespace po = boost::program_options;
  ScenarioSelection& selection = options->selection;
  GridEpisodeRules& rules = options->evaluation.rules;
  HeuristicParameters& heuristic = options->agent.heuristic;
  // clang-format off
  description->add_options()
      ("scenarios", po::value(&options->folders)->multitoken()->required(),
       "folders: sets of the MovingAI benchmark (with Maps and Scenarios in them), their Scenarios folders, or folders "
       "of such sets")
      ("maps", po::value(&options->maps)->default_value(options->maps),
       "train (maps 0-5 of a set, or the first half of more than 20 maps), validation (the others) or all")
      ("min-length", po::value(&selection.min_length)->default_value(selection.min_length),
       "cells, of the shortest way")
      ("max-length", po::value(&selection.max_length), "cells, of the shortest way (default: no limit)")
      ("count", po::value(&options->count)->default_value(options->count), "scenarios of each set; 0 = all")
      ("seed", po::value(&selection.seed)->default_value(selection.seed), "of the choice of scenarios")
      ("max-steps", po::value(&rules.max_steps)->default_value(rules.max_steps),
       "of an episode; 0 = no limit but 16 times the number of the map's cells")
      ("corner-cutting", "diagonal moves may pass blocked cells at their sides")
      ("thesis-terrain", "only '.' is passable, not 'G' and 'S'")
      ("no-shield", "a network may choose moves into obstacles, which end the episode")
      ("no-escape", "no boundary following when a network gets nowhere")
      ("patience", po::value(&options->agent.patience)->default_value(options->agent.patience),
       "steps without getting nearer before the escape")
      ("heuristic", po::value(&options->heuristic)->default_value(options->heuristic),
       "of A*: manhattan, chebyshev, octile, euclidean or scaled_euclidean")
      ("scale", po::value(&heuristic.scale)->default_value(heuristic.scale), "of scaled_euclidean")
      ("keep-closed", "A* expands no cell twice, also where a heuristic that overestimates led to it by a detour")
      ("threads", po::value(&options->evaluation.threads)->default_value(options->evaluation.threads),
       "episodes at a time; does not change the result");
  // clang-format on
}

void finishGridOptions(const boost::program_options::variables_map& values, GridOptions* options) {
  ScenarioSelection& selection = options->selection;
  checkNotNegative("--count", options->count);
  checkNotNegative("--max-steps", options->evaluation.rules.max_steps);
  checkPositive("--patience", options->agent.patience);
  checkPositive("--threads", options->evaluation.threads);
  // Written so that a length that is not a number is refused, too.
  if (!(selection.min_length >= 0.0 && selection.min_length <= selection.max_length)) {
    std::ostringstream message;
    message << "--min-length is " << selection.min_length << " and --max-length " << selection.max_length
            << ", expected 0 <= min <= max";
    throw std::invalid_argument(message.str());
  }
  selection.count = static_cast<std::size_t>(options->count);
  selection.maps = selectionNamed(options->maps);
  options->agent.keep_closed = values.count("keep-closed") > 0;
  selection.rule = values.count("thesis-terrain") > 0 ? PassableRule::kThesis : PassableRule::kBenchmark;
  const auto cutting = values.count("corner-cutting") > 0 ? CornerCutting::kAllowed : CornerCutting::kForbidden;
  options->evaluation.rules.corner_cutting = cutting;
  options->agent.corner_cutting = cutting;
  options->agent.shield = values.count("no-shield") == 0;
  options->agent.escape = values.count("no-escape") == 0;
  options->agent.heuristic.kind = heuristicNamed(options->heuristic);
}

std::vector<GridTaskSet> drawGridTaskSets(const GridOptions& options) {
  std::vector<GridTaskSet> sets;
  for (const std::string& folder : options.folders) {
    for (const GridSetFiles& files : findGridSets(folder)) sets.push_back(drawGridTasks(files, options.selection));
  }
  return sets;
}

}  // namespace lstm_planner
