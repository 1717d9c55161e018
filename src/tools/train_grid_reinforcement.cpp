#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "lstm_planner/common/csv_writer.hpp"
#include "lstm_planner/common/gnuplot.hpp"
#include "lstm_planner/common/text_table.hpp"
#include "lstm_planner/grid_world/learning/grid_actor_critic.hpp"
#include "lstm_planner/grid_world/learning/grid_q_learning.hpp"
#include "lstm_planner/grid_world/learning/grid_reinforcement.hpp"
#include "lstm_planner/training/q_learner.hpp"
#include "tools/output_file.hpp"
#include "tools/ranges.hpp"
#include "tools/ranks.hpp"
#include "tools/train_commands.hpp"
#include "tools/train_grid_judge.hpp"
#include "tools/train_grid_maps.hpp"
#include "tools/train_grid_options.hpp"
#include "tools/training_host.hpp"
#include "tools/visited_settings.hpp"

namespace lstm_planner {
namespace {

/// What is to be trained, and how.
struct GridReinforcementPlan {
  GridTrainingOptions options;
  GridReinforcementParameters training;
  nlohmann::json settings;  ///< what the result depends on
};

/// All options that ways of reinforcement have in common. `plan` and `parameters`, the learner's, hold the defaults and
/// take the values.
template <typename Parameters>
void addGridReinforcementOptions(const std::string& method, const std::vector<std::string>& arguments,
                                 GridReinforcementPlan* plan, Parameters* parameters, CommandLine* line) {
  Parameters& p = *parameters;
  GridCourseParameters& course = plan->training.course;
  plan->options.method = method;
  plan->options.epochs = plan->training.epochs;
  plan->options.encoder = p.encoder;
  addGridTrainingOptions(arguments, &plan->options, line);
  line->add("goals", &course.goals, {1, 1e5},
            "goals in memory at the same time; each needs 4 bytes per cell of its map");
  line->add("short-share", &course.short_share, kAnyShare,
            "share of the training episodes whose length is drawn with a probability proportional to 1 / length; the "
            "others uniformly");
  visitGridLearnerParameters(p, line->everyParameter());
}

/// Hands what was parsed to the training and to the learner's parameters, and notes it in the plan's settings. Throws
/// std::invalid_argument with a sentence for values that make no sense.
template <typename Parameters>
void finishGridReinforcement(GridReinforcementPlan* plan, Parameters* parameters) {
  Parameters& p = *parameters;
  GridTrainingOptions& options = plan->options;
  GridReinforcementParameters& training = plan->training;
  training.course.min_length = options.min_length;
  training.course.max_length = options.max_length;
  training.course.dead_end_share = options.dead_ends;
  training.updates = p.updates;
  training.epochs = options.epochs;
  training.seed = p.seed = options.seed;
  training.threads = p.threads = options.threads;
  p.communicator = ranks();
  validate(training);
  validate(p);
  plan->settings = settingsOf(options);
  plan->settings.update({{"goals", training.course.goals}, {"short-share", training.course.short_share}});
  visitGridLearnerParameters(p, noteIn(&plan->settings));
}

/// One epoch of learning by reinforcement.
struct GridCurvePoint {
  int epoch = 0;                ///< from 1
  double steps = 0.0;           ///< of all agents since the start
  double reward = 0.0;          ///< mean a step, cells
  double arrival = 0.0;         ///< share of the training episodes
  double ratio = 0.0;           ///< mean length / optimum of those that arrived
  std::vector<double> success;  ///< share of each validation set's scenarios
  double mean_success = 0.0;
  bool best = false;
};

constexpr int kFirstSetColumn = 8;

std::string csvOf(const std::vector<std::string>& set_names, const std::vector<GridCurvePoint>& points) {
  std::ostringstream text;
  CsvWriter csv(&text, CsvWriter::Digits::kExact);
  csv.add("epoch", "steps", "reward", "arrival", "ratio", "mean_success", "best");
  for (const std::string& name : set_names) csv.add("success " + name);
  csv.endRow();
  for (const GridCurvePoint& point : points) {
    csv.add(point.epoch, point.steps, point.reward, point.arrival, point.ratio, point.mean_success, point.best);
    csv.addAll(point.success);
    csv.endRow();
  }
  return text.str();
}

std::string script(const std::string& csv_path, const std::string& png_path,
                   const std::vector<std::string>& set_names) {
  const std::string file = quotedForGnuplot(csv_path);
  std::ostringstream text;
  text << "set terminal pngcairo size 900,800; set output " << quotedForGnuplot(png_path)
       << "; set datafile separator ','; set grid; set xlabel 'steps [million]'; set multiplot layout 2,1; "
       << "set key outside right; set ylabel 'arrival [%]'; set yrange [0:100]; "
       << "plot " << file << " skip 1 using ($2/1e6):($4*100) title 'training' with lines dt 2 lc 'gray40'";
  for (std::size_t i = 0; i < set_names.size(); ++i) {
    text << ", " << file << " skip 1 using ($2/1e6):($" << kFirstSetColumn + static_cast<int>(i) << "*100) title "
         << quotedForGnuplot(set_names[i]) << " noenhanced with linespoints pt 7 ps 0.4";
  }
  text << "; set autoscale y; set ylabel 'length / optimum'; plot " << file
       << " skip 1 using ($2/1e6):5 title 'training' with linespoints pt 7 ps 0.4; unset multiplot; ";
  return text.str();
}

nlohmann::json toJson(const GridCurvePoint& point) {
  return {{"epoch", point.epoch},
          {"steps", point.steps},
          {"reward", point.reward},
          {"arrival", point.arrival},
          {"ratio", point.ratio},
          {"success", point.success},
          {"mean_success", point.mean_success},
          {"best", point.best}};
}

GridCurvePoint curvePointFrom(const nlohmann::json& json) {
  GridCurvePoint point;
  point.epoch = json.at("epoch").get<int>();
  point.steps = json.at("steps").get<double>();
  point.reward = json.at("reward").get<double>();
  point.arrival = json.at("arrival").get<double>();
  point.ratio = json.at("ratio").get<double>();
  point.success = json.at("success").get<std::vector<double>>();
  point.mean_success = json.at("mean_success").get<double>();
  point.best = json.at("best").get<bool>();
  return point;
}

/// Writes the points as CSV beside the picture and draws them over the steps with gnuplot: success on the validation
/// sets and arrival above, length / optimum below. Throws std::runtime_error when a file cannot be written or gnuplot
/// is missing or fails; the CSV file is complete by then.
void writeGridCurve(const std::string& png_path, const std::vector<std::string>& set_names,
                    const std::vector<GridCurvePoint>& points) {
  const std::string csv_path = csvPathBeside(png_path);
  writeTextFile(csv_path, csvOf(set_names, points));
  runGnuplot("learning curve", png_path, csv_path,
             [&](const std::string& path) { return script(csv_path, path, set_names); });
}

class GridReinforcementHost : public ToolTrainingHost {
 public:
  GridReinforcementHost(const TrainingLoopOptions& loop, GridJudge judge, const GridReinforcement& training,
                        GridLearner* learner)
      : ToolTrainingHost(loop),
        judge_(std::move(judge)),
        table_(tableOf(judge_.names())),
        training_(training),
        learner_(*learner) {}

  double judge(const LayerStack& layers) override {
    score_ = judge_.judge(layers);
    return score_.mean;
  }
  void keep(const LayerStack& layers) override { judge_.write(layers, score_); }
  void judged(const Judgement& judgement) override {
    if (!judgement.due) return;
    const ReinforcementReport report = learner_.report();
    points_.push_back({training_.epoch(), report.steps, report.reward, report.arrival, report.ratio, score_.success,
                       score_.mean, judgement.best});
    print(points_.back());
  }

  nlohmann::json notes() const override {
    nlohmann::json curve = nlohmann::json::array();
    for (const GridCurvePoint& point : points_) curve.push_back(toJson(point));
    return {{"epoch", training_.epoch()}, {"curve", curve}};
  }
  void restoreNotes(const nlohmann::json& progress) override {
    for (const auto& point : progress.at("curve")) points_.push_back(curvePointFrom(point));
  }

  void drawCurve(const std::string& file) const {
    if (!file.empty() && !points_.empty() && isFirstRank()) writeGridCurve(file, judge_.names(), points_);
  }

 private:
  double progress() const override { return training_.progress(); }
  std::string position() const override { return "epoch " + std::to_string(training_.epoch()); }
  std::string scoreText(double score) const override { return namedScore("mean arrival", score); }
  std::string resumption() const override {
    // What was learned since the last epoch ended is lost: that epoch starts anew.
    return training_.epoch() == 0 ? "there is no checkpoint before the end of the first epoch"
                                  : "the same command goes on after " + position();
  }

  void printHeader() const override {
    std::cout << table_.headings() << std::endl;
    for (const GridCurvePoint& point : points_) print(point);
  }

  static TextTable tableOf(const std::vector<std::string>& set_names) {
    constexpr std::size_t kWidth = 9;
    std::string headings = "epoch    steps [M]  reward  arrival  ratio";
    for (const std::string& name : set_names) {
      headings += "  " + std::string(kWidth - std::min(kWidth, name.size()), ' ') + name;
    }
    return TextTable(headings + "       mean");
  }

  void print(const GridCurvePoint& point) const {
    std::vector<std::string> cells = {std::to_string(point.epoch), fixedText(point.steps / 1e6, 1),
                                      fixedText(point.reward, 3), fixedText(point.arrival, 3),
                                      fixedText(point.ratio, 2)};
    for (const double success : point.success) cells.push_back(fixedText(success, 3));
    cells.push_back(fixedText(point.mean_success, 3));
    std::cout << table_.line(cells) << (point.best ? "  best" : "") << std::endl;
  }

  GridJudge judge_;
  const TextTable table_;
  const GridReinforcement& training_;
  GridLearner& learner_;
  GridScore score_;  ///< what was judged last
  std::vector<GridCurvePoint> points_;
};

/// Learns epoch by epoch, with a line for each; see GridReinforcement and runTraining(). Returns the exit status.
int trainByReinforcement(const GridReinforcementPlan& plan, GridLearner* learner) {
  const GridTrainingOptions& options = plan.options;
  TrainingLoopOptions loop;
  loop.checkpoint = options.checkpoint;
  loop.settings = plan.settings;
  loop.output = options.output;
  loop.communicator = ranks();
  GridTrainingMaps maps = loadGridTrainingMaps(options);
  GridReinforcement training(plan.training, std::move(maps.training), learner);
  GridReinforcementHost host(loop, GridJudge(options, std::move(maps.validation)), training, learner);
  const TrainingOutcome outcome = runTraining(loop, &training, &host);
  host.drawCurve(options.curve);
  return host.end(outcome);
}

/// By the names of --reward.
const Choices<QLearningParameters::Reward>& rewards() {
  static const Choices<QLearningParameters::Reward> choices = {{"progress", QLearningParameters::Reward::kProgress},
                                                               {"thesis", QLearningParameters::Reward::kThesis}};
  return choices;
}

}  // namespace

int trainGridByActorCritic(const std::vector<std::string>& arguments) {
  GridReinforcementPlan plan;
  GridActorCriticParameters parameters;
  CommandLine line("train --task grid --method actor-critic",
                   "trains a network for the grid world by actor-critic learning");
  addGridReinforcementOptions("actor-critic", arguments, &plan, &parameters, &line);
  visitActorCriticParameters(parameters, "cells", line.everyParameter());
  visitGridActorCriticParameters(parameters, line.everyParameter());
  if (!line.parse(arguments)) return 0;
  finishGridReinforcement(&plan, &parameters);
  visitActorCriticParameters(parameters, "cells", noteIn(&plan.settings));
  visitGridActorCriticParameters(parameters, noteIn(&plan.settings));
  LayerStack layers = firstLayers(&plan.options);
  parameters.encoder = plan.options.encoder;
  const auto learner = makeGridActorCritic(parameters, std::move(layers));
  return trainByReinforcement(plan, learner.get());
}

int trainGridByQLearning(const std::vector<std::string>& arguments) {
  GridReinforcementPlan plan;
  GridQLearningParameters parameters;
  CommandLine line("train --task grid --method q-learning",
                   "trains a network for the grid world by recurrent Q-learning");
  addGridReinforcementOptions("q-learning", arguments, &plan, &parameters, &line);
  line.addChoice(
      "reward", &parameters.reward, rewards(),
      "progress (how much shorter the true shortest path to the goal has become, minus a cost) or thesis (Eq. 2.36)");
  visitQLearningParameters(parameters, "cells", "updates", line.everyParameter());
  if (!line.parse(arguments)) return 0;
  finishGridReinforcement(&plan, &parameters);
  plan.settings["reward"] = nameOf(parameters.reward, rewards());
  visitQLearningParameters(parameters, "cells", "updates", noteIn(&plan.settings));
  LayerStack layers = firstLayers(&plan.options);
  parameters.encoder = plan.options.encoder;
  const auto learner = makeGridQLearning(parameters, std::move(layers));
  return trainByReinforcement(plan, learner.get());
}

}  // namespace lstm_planner
