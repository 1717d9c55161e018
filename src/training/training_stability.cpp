#include "lstm_planner/training/training_stability.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "lstm_planner/common/csv_writer.hpp"
#include "lstm_planner/common/gnuplot.hpp"
#include "lstm_planner/common/output_file.hpp"
#include "lstm_planner/common/text_table.hpp"
#include "lstm_planner/training/parameter_vector.hpp"

namespace lstm_planner {
namespace {

constexpr std::size_t kLastEpochs = 100;
constexpr std::size_t kFirstEpochs = 100;  ///< in which a low accuracy is no collapse

struct Curve {
  const char* name;
  double EpochAccuracies::*accuracy;
};

constexpr Curve kCurves[] = {{"training, while the weights move", &EpochAccuracies::moving},
                             {"training, snapshot", &EpochAccuracies::snapshot},
                             {"training, averaged weights", &EpochAccuracies::averaged},
                             {"validation, snapshot", &EpochAccuracies::validation_snapshot},
                             {"validation, averaged weights", &EpochAccuracies::validation_averaged}};

std::vector<double> valuesOf(const std::vector<EpochAccuracies>& epochs, double EpochAccuracies::*accuracy) {
  std::vector<double> values;
  for (const EpochAccuracies& epoch : epochs) values.push_back(epoch.*accuracy);
  return values;
}

void writeRows(const std::vector<EpochAccuracies>& epochs, std::ostream* file) {
  CsvWriter csv(file, CsvWriter::Digits::kExact);
  csv.row("epoch", "moving", "snapshot", "averaged", "validation_snapshot", "validation_averaged");
  for (const EpochAccuracies& epoch : epochs) {
    csv.add(epoch.epoch);
    for (const Curve& curve : kCurves) csv.add(epoch.*curve.accuracy);
    csv.endRow();
  }
}

/// One line, as gnuplot's -e wants it.
std::string gnuplotScript(const std::string& csv_path, const std::vector<EpochAccuracies>& epochs) {
  const std::string file = quotedForGnuplot(csv_path) + " skip 1 using 1:($";
  std::ostringstream script;
  script << "set datafile separator ','; set grid; set xlabel 'epoch'; set ylabel 'accuracy [%]'; set xrange [0:"
         << epochs.back().epoch + 1 << "]; set key tmargin center; set multiplot layout 2,1; "
         << "set title 'training set'; plot " << file
         << "2*100) with lines lc rgb '#e69f00' title 'mean over batches while the weights move (Eq. 4.5)', " << file
         << "3*100) with lines lc rgb '#0072b2' title 'weights at the end of the epoch', " << file
         << "4*100) with lines lw 2 lc rgb '#009e73' title 'averaged weights'; set title 'validation set'; plot "
         << file << "5*100) with lines lc rgb '#0072b2' title 'weights at the end of the epoch', " << file
         << "6*100) with lines lw 2 lc rgb '#009e73' title 'averaged weights'; unset multiplot; ";
  return script.str();
}

}  // namespace

EpochAccuracies measureEpoch(const LayerStack& layers, const TrainingState& state,
                             const std::vector<Sequence>& training, int threads) {
  if (state.averaged_weights.size() == 0 || state.curve.empty()) {
    throw std::invalid_argument("a training without averaged weights or epochs has no stability to be measured");
  }
  LayerStack measured = layers;
  const auto accuracyOf = [&](const Eigen::VectorXf& weights) {
    setParameterVector(weights, measured);
    return evaluate(measured, training, threads).accuracy();
  };
  const EpochReport& report = state.curve.back();
  EpochAccuracies epoch;
  epoch.epoch = report.epoch;
  epoch.moving = report.mean_batch_accuracy;
  epoch.snapshot = accuracyOf(state.weights);
  epoch.averaged = accuracyOf(state.averaged_weights);
  epoch.validation_snapshot = report.validation.accuracy();
  epoch.validation_averaged = report.averaged.accuracy();
  return epoch;
}

Fluctuation fluctuationOf(const std::vector<double>& curve, std::size_t epochs) {
  Fluctuation fluctuation;
  if (curve.empty()) return fluctuation;
  const std::size_t first = curve.size() - std::min(curve.size(), epochs);
  const auto count = static_cast<double>(curve.size() - first);
  double sum = 0.0;
  fluctuation.lowest = std::numeric_limits<double>::infinity();
  for (std::size_t i = first; i < curve.size(); ++i) {
    sum += curve[i];
    if (curve[i] >= fluctuation.lowest) continue;
    fluctuation.lowest = curve[i];
    fluctuation.lowest_epoch = static_cast<int>(i) + 1;
  }
  double squares = 0.0;
  double squared_changes = 0.0;
  for (std::size_t i = first; i < curve.size(); ++i) {
    squares += std::pow(curve[i] - sum / count, 2);
    if (i == first) continue;
    const double change = std::abs(curve[i] - curve[i - 1]);
    squared_changes += change * change;
    fluctuation.largest_change = std::max(fluctuation.largest_change, change);
  }
  fluctuation.deviation = std::sqrt(squares / count);
  fluctuation.usual_change = count > 1.0 ? std::sqrt(squared_changes / (count - 1.0)) : 0.0;
  return fluctuation;
}

std::string stabilityText(const std::vector<EpochAccuracies>& epochs) {
  const std::size_t settled = epochs.size() > kFirstEpochs ? epochs.size() - kFirstEpochs : 0;
  const std::string title =
      "accuracy over the last " + std::to_string(std::min(epochs.size(), kLastEpochs)) + " epochs [%]";
  const TextTable table(title + "  deviation  usual change  largest change  lowest after " +
                        std::to_string(kFirstEpochs) + " epochs  in epoch");
  std::ostringstream text;
  text << table.headings() << '\n';
  for (const Curve& curve : kCurves) {
    const std::vector<double> values = valuesOf(epochs, curve.accuracy);
    const Fluctuation last = fluctuationOf(values, kLastEpochs);
    const Fluctuation all = fluctuationOf(values, settled);
    std::vector<std::string> cells{leftText(curve.name, title.size()), fixedText(100.0 * last.deviation, 2),
                                   fixedText(100.0 * last.usual_change, 2), fixedText(100.0 * last.largest_change, 2)};
    if (settled > 0) {
      cells.push_back(fixedText(100.0 * all.lowest, 2));
      cells.push_back(std::to_string(all.lowest_epoch));
    }
    text << table.line(cells) << '\n';
  }
  double sum = 0.0;
  double largest = 0.0;
  const std::size_t first = epochs.size() - std::min(epochs.size(), kLastEpochs);
  for (std::size_t i = first; i < epochs.size(); ++i) {
    const double gap = std::abs(epochs[i].moving - epochs[i].snapshot);
    sum += gap;
    largest = std::max(largest, gap);
  }
  const auto count = static_cast<double>(std::max<std::size_t>(1, epochs.size() - first));
  text << "the accuracy of an epoch (Eq. 4.5) and that of the weights at its end on the same set differ by "
       << fixedText(100.0 * sum / count, 2) << " % on average, by " << fixedText(100.0 * largest, 2) << " % at most\n";
  return text.str();
}

void writeStability(const std::string& png_path, const std::vector<EpochAccuracies>& epochs) {
  if (epochs.empty()) throw std::runtime_error("stability '" + png_path + "' has no epochs, expected at least one");
  const std::string csv_path = csvPathBeside(png_path);
  writeOutputFile("stability", csv_path, [&](std::ostream& file) { writeRows(epochs, &file); });
  runGnuplot("stability", png_path, csv_path, "1000,900", gnuplotScript(csv_path, epochs));
}

}  // namespace lstm_planner
