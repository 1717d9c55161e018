#include "tools/train_grid_curve.hpp"

#include <sstream>

#include "lstm_planner/common/csv_writer.hpp"
#include "lstm_planner/common/gnuplot.hpp"
#include "tools/output_file.hpp"

namespace lstm_planner {
namespace {

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

}  // namespace

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

void writeGridCurve(const std::string& png_path, const std::vector<std::string>& set_names,
                    const std::vector<GridCurvePoint>& points) {
  const std::string csv_path = csvPathBeside(png_path);
  writeTextFile(csv_path, csvOf(set_names, points));
  runGnuplot("learning curve", png_path, csv_path,
             [&](const std::string& path) { return script(csv_path, path, set_names); });
}

}  // namespace lstm_planner
