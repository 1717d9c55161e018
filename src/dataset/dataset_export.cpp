#include "lstm_planner/dataset/dataset_export.hpp"

#include <algorithm>
#include <limits>
#include <string>

#include "dataset/dataset_columns.hpp"
#include "dataset/step_quantities.hpp"
#include "lstm_planner/common/csv_writer.hpp"
#include "lstm_planner/common/output_file.hpp"

namespace lstm_planner {

namespace {

void writeNames(std::size_t beams, CsvWriter* csv) {
  csv->add("recording", "episode", "number");
  DriveStep step;
  visitColumns(step, [&](const std::string& name, const char*, auto&) { csv->add(name); });
  for (std::size_t beam = 0; beam < beams; ++beam) csv->add("beam_" + std::to_string(beam));
  csv->endRow();
}

void writeRows(const Dataset& dataset, bool with_scans, std::ostream* out) {
  CsvWriter csv(out, CsvWriter::Digits::kExact);
  const std::size_t beams = with_scans ? mostBeams(dataset) : 0;
  writeNames(beams, &csv);
  forEachStep(dataset, [&](long recording, long episode, const DriveStep& step) {
    csv.add(recording, episode, step.number);
    visitColumns(step, [&](const std::string&, const char*, const auto& number) { csv.add(number); });
    for (std::size_t beam = 0; beam < beams; ++beam) {
      csv.add(beam < step.ranges.size() ? step.ranges[beam] : std::numeric_limits<float>::quiet_NaN());
    }
    csv.endRow();
  });
}

}  // namespace

void exportCsv(const std::string& path, const Dataset& dataset, bool with_scans) {
  try {
    OutputFile file(path);
    writeRows(dataset, with_scans, &file.stream());
    file.commit();
  } catch (const OutputFileError& error) {
    throw DatasetError("'" + path + "' cannot be written: " + error.what());
  }
}

}  // namespace lstm_planner
