#include "lstm_planner/training/learning_curve.hpp"

#include <sstream>
#include <stdexcept>

#include "lstm_planner/common/csv_writer.hpp"
#include "lstm_planner/common/gnuplot.hpp"
#include "lstm_planner/common/output_file.hpp"

namespace lstm_planner {
namespace {

bool hasValidation(const std::vector<EpochReport>& curve) {
  return !curve.empty() && curve.front().validation.confusion.size() != 0;
}

bool hasAverage(const std::vector<EpochReport>& curve) {
  return !curve.empty() && curve.front().averaged.confusion.size() != 0;
}

int bestEpoch(const std::vector<EpochReport>& curve) {
  int best = 0;
  for (const EpochReport& report : curve) {
    if (report.best) best = report.epoch;
  }
  return best;
}

/// One line, as gnuplot's -e wants it.
std::string gnuplotScript(const std::string& csv_path, const std::vector<EpochReport>& curve) {
  const std::string csv = quotedForGnuplot(csv_path);
  std::ostringstream script;
  const auto plot = [&](const char* label, int training_column, int averaged_column, const char* scale) {
    script << "set ylabel '" << label << "'; "
           << "plot " << csv << " using 1:($" << training_column << scale
           << ") title 'training' with linespoints pt 7 ps 0.4";
    if (hasValidation(curve)) {
      script << ", " << csv << " using 1:($" << training_column + 2 << scale
             << ") title 'validation' with linespoints pt 7 ps 0.4";
    }
    if (hasAverage(curve)) {
      script << ", " << csv << " using 1:($" << averaged_column << scale
             << ") title 'validation of the averaged weights' with lines lw 2";
    }
    script << "; ";
  };
  script << "set datafile separator ','; set key autotitle columnhead; set grid; set xlabel 'epoch'; "
         << "set xrange [0:" << curve.back().epoch + 1 << "]; "
         << "set multiplot layout 2,1; ";
  const int best = bestEpoch(curve);
  script << "set arrow from " << best << ", graph 0 to " << best << ", graph 1 nohead dt 2 lc 'gray40'; "
         << "set key right bottom; ";
  plot("accuracy [%]", 3, 8, "*100");
  script << "set key right top; ";
  plot("loss", 4, 9, "*1");
  script << "unset multiplot; ";
  return script.str();
}

void writeRows(const std::vector<EpochReport>& curve, std::ostream& file) {
  CsvWriter csv(&file, CsvWriter::Digits::kExact);
  const bool has_validation = hasValidation(curve);
  const bool has_average = hasAverage(curve);
  csv.add("epoch", "learning_rate", "training_accuracy", "training_loss", "validation_accuracy", "validation_loss",
          "best");
  if (has_average) csv.add("averaged_accuracy", "averaged_loss");
  csv.endRow();
  for (const EpochReport& report : curve) {
    csv.add(report.epoch, report.learning_rate, report.training.accuracy(), report.training.meanLoss());
    if (has_validation) {
      csv.add(report.validation.accuracy(), report.validation.meanLoss());
    } else {
      csv.add("", "");
    }
    csv.add(report.best);
    if (has_average) csv.add(report.averaged.accuracy(), report.averaged.meanLoss());
    csv.endRow();
  }
}

}  // namespace

void writeLearningCurveCsv(const std::string& csv_path, const std::vector<EpochReport>& curve) {
  writeOutputFile("learning curve", csv_path, [&](std::ostream& file) { writeRows(curve, file); });
}

void writeLearningCurve(const std::string& png_path, const std::vector<EpochReport>& curve) {
  const std::string csv_path = csvPathBeside(png_path);
  writeLearningCurveCsv(csv_path, curve);
  if (curve.empty()) throw std::runtime_error("learning curve '" + png_path + "' has no epochs, expected at least one");
  runGnuplot("learning curve", png_path, csv_path, "900,800", gnuplotScript(csv_path, curve));
}

}  // namespace lstm_planner
