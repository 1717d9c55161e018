#include "lstm_planner/base/learning/confusion.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "lstm_planner/base/common/gnuplot.hpp"
#include "lstm_planner/base/common/output_file.hpp"

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
  std::ostringstream text;
  text << std::fixed << std::setprecision(1) << 100.0 * value;
  return text.str();
}

void writeCsv(std::ostream& file, const ConfusionMatrix& confusion, const std::vector<std::string>& names) {
  file << "label";
  for (const std::string& name : names) file << ",answer " << name;
  file << '\n';
  for (Eigen::Index row = 0; row < confusion.rows(); ++row) {
    file << names[static_cast<std::size_t>(row)];
    for (Eigen::Index column = 0; column < confusion.cols(); ++column) file << ',' << confusion(row, column);
    file << '\n';
  }
}

/// Cells coloured by their share of the row, with share and count written on them. One line, as gnuplot's -e wants it.
std::string gnuplotScript(const std::string& png_path, const ConfusionMatrix& confusion,
                          const std::vector<std::string>& names) {
  std::ostringstream script;
  script << std::fixed << std::setprecision(4);
  const Eigen::Index classes = confusion.rows();
  script << "set terminal pngcairo size 720,640; set output " << quotedForGnuplot(png_path) << "; unset key; "
         << "unset colorbox; set xrange [-0.5:" << classes << "-0.5]; set yrange [" << classes << "-0.5:-0.5]; "
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
  constexpr int kLabelWidth = 14;
  std::size_t widest = 8;
  for (const std::string& name : names) widest = std::max(widest, name.size() + 2);
  const int width = static_cast<int>(widest);
  std::ostringstream text;
  text << std::left << std::setw(kLabelWidth) << "label \\ answer" << std::right;
  for (const std::string& name : names) text << std::setw(width) << name;
  text << std::setw(width) << "recall" << '\n';
  const std::vector<double> recall = recalls(confusion);
  for (std::size_t row = 0; row < names.size(); ++row) {
    text << std::setw(kLabelWidth) << names[row];
    for (Eigen::Index column = 0; column < confusion.cols(); ++column) {
      text << std::setw(width) << confusion(static_cast<Eigen::Index>(row), column);
    }
    text << std::setw(width) << percent(recall[row]) << '\n';
  }
  text << std::left << std::setw(kLabelWidth) << "precision" << std::right;
  for (const double precision : precisions(confusion)) text << std::setw(width) << percent(precision);
  text << '\n';
  return text.str();
}

void writeConfusion(const std::string& png_path, const ConfusionMatrix& confusion,
                    const std::vector<std::string>& names) {
  requireNames(confusion, names);
  const std::string csv_path = csvPathBeside(png_path);
  writeOutputFile("confusion matrix", csv_path, [&](std::ostream& file) { writeCsv(file, confusion, names); });
  runGnuplot("confusion matrix", png_path, csv_path,
             [&](const std::string& path) { return gnuplotScript(path, confusion, names); });
}

}  // namespace lstm_planner
