#include "lstm_planner/dataset/dataset_export.hpp"

#include <Poco/DateTime.h>
#include <Poco/Path.h>
#include <Poco/Zip/Compress.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <sstream>
#include <string>
#include <type_traits>
#include <vector>

#include "dataset/numpy_array.hpp"
#include "dataset/step_quantities.hpp"
#include "lstm_planner/common/csv_writer.hpp"
#include "lstm_planner/common/output_file.hpp"
#include "lstm_planner/dataset/dataset.hpp"

namespace lstm_planner {
namespace {

/// Calls work(recording, episode, step) for each step that is to be learned from; episodes are counted over all
/// recordings, from 0, the discarded ones too.
template <typename Work>
void forEachStep(const Dataset& dataset, Work&& work) {
  long recording_index = 0;
  long episode_index = 0;
  for (const Recording& recording : dataset.recordings) {
    for (const RecordedEpisode& episode : recording.episodes) {
      if (!episode.episode.discarded) {
        for (const DriveStep& step : episode.steps) work(recording_index, episode_index, step);
      }
      ++episode_index;
    }
    ++recording_index;
  }
}

/// Of the longest scan.
std::size_t mostBeams(const Dataset& dataset) {
  std::size_t beams = 0;
  forEachStep(dataset, [&](long, long, const DriveStep& step) { beams = std::max(beams, step.ranges.size()); });
  return beams;
}

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

/// One array of all steps.
struct Column {
  std::string name;
  std::size_t row_length = 0;
  std::vector<double> numbers;
  std::vector<std::int64_t> integers;  ///< instead, where the quantity is an integer
};

/// Collects the quantities of steps into columns, which are made at the first step.
class ColumnCollector {
 public:
  void add(long recording, long episode, const DriveStep& step) {
    next_ = 0;
    push(columnNamed("recording"), recording);
    push(columnNamed("episode"), episode);
    push(columnNamed("number"), step.number);
    visitQuantities(step, [this](const std::string& name, const char*, const auto& quantity) {
      Column& column = columnNamed(name);
      std::size_t length = 0;
      visitNumbers(name, "", quantity, [&](const std::string&, const char*, const auto& number) {
        push(column, number);
        ++length;
      });
      column.row_length = std::is_arithmetic_v<std::decay_t<decltype(quantity)>> ? 0 : length;
    });
  }

  const std::vector<Column>& columns() const { return columns_; }

 private:
  Column& columnNamed(const std::string& name) {
    if (next_ == columns_.size()) columns_.push_back({name, 0, {}, {}});
    return columns_[next_++];
  }

  template <typename Number>
  static void push(Column& column, Number number) {
    if constexpr (std::is_integral_v<Number>) {
      column.integers.push_back(number);
    } else {
      column.numbers.push_back(number);
    }
  }

  std::vector<Column> columns_;
  std::size_t next_ = 0;
};

void addArray(const std::string& name, const std::string& npy, Poco::Zip::Compress* archive) {
  std::istringstream in(npy);
  archive->addFile(in, Poco::DateTime(), Poco::Path(name + ".npy"), Poco::Zip::ZipCommon::CM_DEFLATE,
                   Poco::Zip::ZipCommon::CL_NORMAL);
}

void addScans(const Dataset& dataset, Poco::Zip::Compress* archive) {
  const std::size_t beams = std::max<std::size_t>(mostBeams(dataset), 1);
  std::vector<float> ranges;
  std::vector<double> geometries;
  std::size_t geometry_length = 0;
  forEachStep(dataset, [&](long, long, const DriveStep& step) {
    ranges.insert(ranges.end(), step.ranges.begin(), step.ranges.end());
    ranges.resize(ranges.size() + beams - step.ranges.size(), std::numeric_limits<float>::quiet_NaN());
    const ScanGeometry& geometry = step.geometry;
    const Pose2& mount = geometry.mount.pose;
    const auto row = {geometry.angle_min,
                      geometry.angle_increment,
                      static_cast<double>(geometry.beams),
                      geometry.range_min,
                      geometry.range_max,
                      mount.x,
                      mount.y,
                      mount.yaw,
                      geometry.mount.upside_down ? 1.0 : 0.0};
    geometry_length = row.size();
    geometries.insert(geometries.end(), row);
  });
  addArray("ranges", toNpy(ranges, beams), archive);
  addArray("scan_geometry", toNpy(geometries, geometry_length), archive);
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

void exportNumpy(const std::string& path, const Dataset& dataset, bool with_scans) {
  if (stepCount(dataset) == 0) throw DatasetError("'" + path + "' is not written: the dataset has no steps");
  const std::vector<double>& angles = dataset.recordings.at(0).description.parameters.action_angles;
  for (const Recording& recording : dataset.recordings) {
    if (recording.description.parameters.action_angles == angles) continue;
    throw DatasetError("'" + path + "' is not written: the labels of its recordings stand for different angles");
  }
  ColumnCollector collector;
  forEachStep(dataset,
              [&](long recording, long episode, const DriveStep& step) { collector.add(recording, episode, step); });
  try {
    OutputFile file(path);
    Poco::Zip::Compress archive(file.stream(), true);
    for (const Column& column : collector.columns()) {
      addArray(column.name,
               column.integers.empty() ? toNpy(column.numbers, column.row_length)
                                       : toNpy(column.integers, column.row_length),
               &archive);
    }
    addArray("action_angles", toNpy(angles), &archive);
    if (with_scans) addScans(dataset, &archive);
    archive.close();
    file.commit();
  } catch (const Poco::Exception& error) {
    throw DatasetError("'" + path + "' cannot be written: " + error.displayText());
  } catch (const OutputFileError& error) {
    throw DatasetError("'" + path + "' cannot be written: " + error.what());
  }
}

}  // namespace lstm_planner
