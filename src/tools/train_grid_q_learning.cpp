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
#include "lstm_planner/grid_world/learning/grid_q_learning.hpp"
#include "tools/command.hpp"
#include "tools/command_line.hpp"
#include "tools/output_file.hpp"
#include "tools/train_grid.hpp"
#include "tools/training.hpp"

namespace lstm_planner {
namespace {

/// One epoch of learning.
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

std::string script(const std::string& csv_path, const std::vector<std::string>& set_names) {
  const std::string file = quotedForGnuplot(csv_path);
  std::ostringstream text;
  text << "set datafile separator ','; set grid; set xlabel 'steps [million]'; set multiplot layout 2,1; "
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
  return {json.at("epoch"),        json.at("steps"), json.at("reward"),
          json.at("arrival"),      json.at("ratio"), json.at("success").get<std::vector<double>>(),
          json.at("mean_success"), json.at("best")};
}

/// Writes the points as CSV beside the picture and draws them over the steps with gnuplot: success on the validation
/// sets and arrival above, length / optimum below. Throws std::runtime_error when a file cannot be written or gnuplot
/// is missing or fails; the CSV file is complete by then.
void writeGridCurve(const std::string& png_path, const std::vector<std::string>& set_names,
                    const std::vector<GridCurvePoint>& points) {
  const std::string csv_path = csvPathBeside(png_path);
  writeTextFile(csv_path, csvOf(set_names, points));
  runGnuplot("learning curve", png_path, csv_path, "900,800", script(csv_path, set_names));
}

class GridQLearningHost : public GridTrainingHost {
 public:
  GridQLearningHost(const GridTrainingOptions& options, std::vector<GridTaskSet> sets, GridQLearning* training)
      : GridTrainingHost(options, std::move(sets)), table_(tableOf(names())), training_(*training) {}

  void judged(const Judgement& judgement) override {
    // An epoch that the checkpoint brought is judged again if its network is gone, but has its row.
    const bool is_known = !points_.empty() && points_.back().epoch == training_.epoch();
    if (!judgement.due || is_known) return;
    const GridQLearning::Report report = training_.report();
    points_.push_back({training_.epoch(), report.steps, report.reward, report.arrival, report.ratio, success(),
                       judgement.score, judgement.best});
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
    if (!file.empty() && !points_.empty()) writeGridCurve(file, names(), points_);
  }

 private:
  double progress() const override { return training_.progress(); }
  std::string position() const override { return "epoch " + std::to_string(training_.epoch()); }
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

  const TextTable table_;
  GridQLearning& training_;
  std::vector<GridCurvePoint> points_;
};

/// False when the help was asked for. Throws with a sentence for values that make no sense.
bool readOptions(const std::vector<std::string>& arguments, GridTrainingOptions* options,
                 GridQLearningParameters* parameters) {
  GridQLearningParameters& p = *parameters;
  CommandLine line("train --task grid --method q-learning",
                   "trains a network for the grid world by recurrent Q-learning");
  options->method = "q-learning";
  options->epochs = p.epochs;
  addGridTrainingOptions(arguments, options, &line);
  line.add("goals", &p.course.goals, {1, 1e5},
           "goals in memory at the same time; each needs 4 bytes per cell of its map");
  visitGridQLearningParameters(p, line.everyParameter());
  visitQLearningParameters(p, line.everyParameter());
  if (!line.parse(arguments)) return false;
  p.epochs = options->epochs;
  takeOver(*options, &p);
  validate(p);
  options->loop.settings = line.settings();
  return true;
}

}  // namespace

int trainGridByQLearning(const std::vector<std::string>& arguments) {
  GridTrainingOptions options;
  GridQLearningParameters parameters;
  if (!readOptions(arguments, &options, &parameters)) return 0;
  GridTrainingMaps maps = loadGridTrainingMaps(options);
  const auto training = makeGridQLearning(parameters, std::move(maps.training), firstLayers(options));
  GridQLearningHost host(options, std::move(maps.validation), training.get());
  const TrainingOutcome outcome = runTraining(options.loop, training.get(), &host);
  host.drawCurve(options.curve);
  return host.end(outcome);
}

}  // namespace lstm_planner
