#include "lstm_planner/training/confusion.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "lstm_planner/common/csv_writer.hpp"
#include "lstm_planner/common/gnuplot.hpp"
#include "lstm_planner/common/output_file.hpp"
#include "lstm_planner/common/text_table.hpp"

namespace lstm_planner {
namespace {

double share(std::int64_t part, std::int64_t whole) {
  return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole) : std::numeric_limits<double>::quiet_NaN();
}

void requireNames(const ConfusionMatrix& confusion, const std::vector<std::string>& names) {
  if (static_cast<Eigen::Index>(names.size()) == confusion.rows()) return;
  throw std::invalid_argument("the confusion matrix has " + std::to_string(confusion.rows()) + " classes, expected " +
                              std::to_string(names.size()) + " as there are names");
}

std::string percent(double value) {
  if (std::isnan(value)) return "-";
  return fixedText(100.0 * value, 1);
}

void writeCsv(std::ostream& file, const ConfusionMatrix& confusion, const std::vector<std::string>& names) {
  CsvWriter csv(&file);
  csv.add("label");
  for (const std::string& name : names) csv.add("answer " + name);
  csv.endRow();
  for (Eigen::Index row = 0; row < confusion.rows(); ++row) {
    csv.add(names[static_cast<std::size_t>(row)]);
    for (Eigen::Index column = 0; column < confusion.cols(); ++column) csv.add(confusion(row, column));
    csv.endRow();
  }
}

/// Cells coloured by their share of the row, with share and count written on them. One line, as gnuplot's -e wants it.
std::string gnuplotScript(const ConfusionMatrix& confusion, const std::vector<std::string>& names) {
  std::ostringstream script;
  script << std::fixed << std::setprecision(4);
  const Eigen::Index classes = confusion.rows();
  script << "unset key; unset colorbox; set xrange [-0.5:" << classes << "-0.5]; set yrange [" << classes
         << "-0.5:-0.5]; "
         << "set xlabel 'answer'; set ylabel 'label'; set tics scale 0; set title 'accuracy "
         << percent(share(confusion.trace(), confusion.sum())) << " %, balanced "
         << percent(balancedAccuracy(confusion)) << " %'; ";
  for (const char axis : {'x', 'y'}) {
    script << "set " << axis << "tics (";
    for (std::size_t i = 0; i < names.size(); ++i) {
      script << (i == 0 ? "" : ", ") << quotedForGnuplot(names[i]) << ' ' << i;
    }
    script << "); ";
  }
  for (Eigen::Index row = 0; row < classes; ++row) {
    const std::int64_t whole = confusion.row(row).sum();
    for (Eigen::Index column = 0; column < classes; ++column) {
      const double part = whole > 0 ? share(confusion(row, column), whole) : 0.0;
      const int light = static_cast<int>(255.0 - 200.0 * part);
      script << "set object rectangle center " << column << ',' << row << " size 1,1 fillcolor rgb "
             << (light << 16 | light << 8 | 0xff) << " fillstyle solid border rgb 'gray70' behind; set label \""
             << (whole > 0 ? percent(part) + " %" : "-") << "\\n"
             << confusion(row, column) << "\" at " << column << ',' << row << " center textcolor rgb '"
             << (part > 0.6 ? "white" : "black") << "'; ";
    }
  }
  script << "plot NaN notitle; ";
  return script.str();
}

}  // namespace

std::vector<double> recalls(const ConfusionMatrix& confusion) {
  std::vector<double> shares;
  for (Eigen::Index label = 0; label < confusion.rows(); ++label) {
    shares.push_back(share(confusion(label, label), confusion.row(label).sum()));
  }
  return shares;
}

std::vector<double> precisions(const ConfusionMatrix& confusion) { return recalls(confusion.transpose()); }

double balancedAccuracy(const ConfusionMatrix& confusion) {
  double sum = 0.0;
  int labels = 0;
  for (const double recall : recalls(confusion)) {
    if (std::isnan(recall)) continue;
    sum += recall;
    ++labels;
  }
  return labels > 0 ? sum / labels : 0.0;
}

double accuracyOf(const ConfusionMatrix& confusion) {
  const auto steps = static_cast<double>(confusion.sum());
  return steps > 0.0 ? static_cast<double>(confusion.trace()) / steps : 0.0;
}

ConfusionMatrix constantAnswer(const ConfusionMatrix& confusion) {
  ConfusionMatrix constant = ConfusionMatrix::Zero(confusion.rows(), confusion.cols());
  if (confusion.size() == 0) return constant;
  Eigen::Index label = 0;
  confusion.rowwise().sum().maxCoeff(&label);
  constant.col(label) = confusion.rowwise().sum();
  return constant;
}

std::string confusionText(const ConfusionMatrix& confusion, const std::vector<std::string>& names) {
  requireNames(confusion, names);
  constexpr std::size_t kNarrowest = 6;
  std::size_t widest = kNarrowest;
  for (const std::string& name : names) widest = std::max(widest, name.size());
  const std::string label = "label \\ answer";
  std::string headings = label;
  for (const std::string& name : names) headings += "  " + std::string(widest - name.size(), ' ') + name;
  const TextTable table(headings + "  " + std::string(widest - kNarrowest, ' ') + "recall");
  std::string text = table.headings() + '\n';
  const std::vector<double> recall = recalls(confusion);
  for (std::size_t row = 0; row < names.size(); ++row) {
    std::vector<std::string> cells = {names[row]};
    for (Eigen::Index column = 0; column < confusion.cols(); ++column) {
      cells.push_back(std::to_string(confusion(static_cast<Eigen::Index>(row), column)));
    }
    cells.push_back(percent(recall[row]));
    text += table.line(cells) + '\n';
  }
  std::vector<std::string> cells = {leftText("precision", label.size())};
  for (const double precision : precisions(confusion)) cells.push_back(percent(precision));
  return text + table.line(cells) + '\n';
}

void writeConfusion(const std::string& png_path, const ConfusionMatrix& confusion,
                    const std::vector<std::string>& names) {
  requireNames(confusion, names);
  const std::string csv_path = csvPathBeside(png_path);
  writeOutputFile("confusion matrix", csv_path, [&](std::ostream& file) { writeCsv(file, confusion, names); });
  runGnuplot("confusion matrix", png_path, csv_path, "720,640", gnuplotScript(confusion, names));
}

}  // namespace lstm_planner
