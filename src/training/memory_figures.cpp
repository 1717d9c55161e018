#include <sstream>

#include "lstm_planner/common/csv_writer.hpp"
#include "lstm_planner/common/gnuplot.hpp"
#include "lstm_planner/common/output_file.hpp"
#include "lstm_planner/training/memory_comparison.hpp"

namespace lstm_planner {
namespace {

void drawCurves(const std::string& folder, const std::vector<MemoryOutcome>& outcomes) {
  const std::string file = folder + "/sensitivity.csv";
  std::ostringstream text;
  CsvWriter csv(&text, CsvWriter::Digits::kExact);
  csv.add("step");
  std::vector<Eigen::VectorXd> columns;
  for (const MemoryOutcome& outcome : outcomes) {
    csv.add(outcome.network.name + " before", outcome.network.name + " after");
    columns.push_back(relativeSensitivity(outcome.before));
    columns.push_back(relativeSensitivity(outcome.after));
  }
  csv.endRow();
  for (Eigen::Index step = 0; step < columns.front().size(); ++step) {
    csv.add(step);
    for (const Eigen::VectorXd& column : columns) csv.add(column[step]);
    csv.endRow();
  }
  writeOutputFile("sensitivity", file, [&](std::ostream& out) { out << text.str(); });
  std::ostringstream plot;
  plot << "set datafile separator ','; set grid; set logscale y; set format y '10^{%L}'; set xlabel 'steps after the "
          "first'; set ylabel 'sensitivity to the first input, relative'; set key outside right center; plot ";
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const MemoryOutcome& outcome = outcomes[i / 2];
    plot << (i > 0 ? ", " : "") << quotedForGnuplot(file) << " skip 1 using 1:" << i + 2 << " with lines lw 2 lc "
         << i / 2 + 1 << (i % 2 == 0 ? " dt 2" : "") << " title "
         << quotedForGnuplot(outcome.network.name + (i % 2 == 0 ? ", initial weights" : ", trained"));
  }
  runGnuplot("sensitivity", folder + "/sensitivity.png", file, "1100,600", plot.str());
}

/// Writes the units' sensitivities as shares of the highest: a line a unit, a column a step.
std::string writeShades(const std::string& path, const Eigen::MatrixXd& sensitivity) {
  std::ostringstream text;
  CsvWriter csv(&text, CsvWriter::Digits::kExact);
  const Eigen::MatrixXd shades = sensitivity / sensitivity.maxCoeff();
  for (Eigen::Index unit = 0; unit < shades.rows(); ++unit) {
    for (Eigen::Index step = 0; step < shades.cols(); ++step) csv.add(shades(unit, step));
    csv.endRow();
  }
  writeOutputFile("sensitivity of units", path, [&](std::ostream& file) { file << text.str(); });
  return path;
}

/// Shades as in the thesis: black is the most sensitive unit at the most sensitive step.
void drawShades(const std::string& folder, const MemoryOutcome& outcome) {
  const std::string stem = folder + "/" + outcome.network.figure;
  const std::string before = writeShades(stem + "_initial.csv", outcome.before);
  const std::string after = writeShades(stem + "_trained.csv", outcome.after);
  const auto panel = [&](const char* what, const std::string& csv) {
    return "; set title " + quotedForGnuplot(outcome.network.name + ", " + what) + "; plot " + quotedForGnuplot(csv) +
           " matrix with image notitle";
  };
  std::ostringstream script;
  script << "set datafile separator ','; set palette defined (0 'white', 1 'black'); set cbrange [0:1]; set xlabel "
            "'steps after the first'; set ylabel 'unit'; set xrange [-0.5:"
         << static_cast<double>(outcome.after.cols()) - 0.5
         << "]; set yrange [-0.5:" << static_cast<double>(outcome.after.rows()) - 0.5 << "]; set multiplot layout 2,1"
         << panel("initial weights", before) << panel("trained", after) << "; unset multiplot";
  runGnuplot("sensitivity of units", stem + ".png", after, "900,600", script.str());
}

}  // namespace

void writeMemoryFigures(const std::string& folder, const std::vector<MemoryOutcome>& outcomes) {
  if (outcomes.empty()) return;
  drawCurves(folder, outcomes);
  for (const MemoryOutcome& outcome : outcomes) {
    if (!outcome.network.figure.empty()) drawShades(folder, outcome);
  }
}

}  // namespace lstm_planner
