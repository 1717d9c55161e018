// What other programs read of a dataset.

#include <fstream>
#include <sstream>

#include "dataset/numpy_array.hpp"
#include "dataset/step_quantities.hpp"
#include "lstm_planner/dataset/dataset_export.hpp"
#include "support/refusal.hpp"
#include "support/shell.hpp"
#include "unit/dataset/dataset_fixtures.hpp"

namespace lstm_planner::test_dataset_export {
namespace {

class DatasetExport : public DatasetTest {
 protected:
  /// Two recordings; the second episode of the first is discarded.
  static Dataset example() {
    Dataset dataset;
    dataset.recordings = {exampleRecording(2, 1), exampleRecording(1, 50)};
    dataset.recordings[0].episodes[1].episode.discarded = true;
    return dataset;
  }

  /// What Python prints; empty, and status 77, where it has no NumPy.
  std::string python(const std::string& program, int* status) const {
    const std::string command =
        "cd " + folder_ + "; for p in /usr/bin/python3 python3; do $p -c 'import numpy' >/dev/null && exec $p -c \"" +
        "import numpy as np\nd=np.load('a.npz')\n" + program + "\"; done; exit 77";
    const test::Outcome outcome = test::runShell(command);
    *status = outcome.status;
    return outcome.output;
  }
};

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream in(line + ",");
  for (std::string field; std::getline(in, field, ',');) fields.push_back(field);
  return fields;
}

TEST_F(DatasetExport, WritesARowAStepThatReadsBackExactly) {
  const Dataset dataset = example();
  exportCsv(in("a.csv"), dataset, true);
  std::ifstream file(in("a.csv"));
  std::string line;
  ASSERT_TRUE(std::getline(file, line));
  const std::vector<std::string> names = split(line);
  EXPECT_EQ(names[0], "recording");
  EXPECT_EQ(names[2], "number");
  EXPECT_EQ(names.back(), "beam_15");

  int row = 0;
  for (const auto& [recording, episode, index] :
       std::vector<std::array<int, 3>>{{0, 0, 0}, {1, 2, 0}}) {  // without the discarded episode 1
    const RecordedEpisode& expected = dataset.recordings[static_cast<std::size_t>(recording)].episodes[index];
    for (const DriveStep& step : expected.steps) {
      ASSERT_TRUE(std::getline(file, line));
      ++row;
      const std::vector<std::string> fields = split(line);
      ASSERT_EQ(fields.size(), names.size());
      EXPECT_EQ(fields[0], std::to_string(recording));
      EXPECT_EQ(fields[1], std::to_string(episode));
      EXPECT_EQ(fields[2], std::to_string(step.number));
      std::size_t column = 3;
      visitColumns(step, [&](const std::string& name, const char*, const auto& number) {
        EXPECT_EQ(names[column], name);
        if (std::isfinite(static_cast<double>(number))) {
          EXPECT_EQ(std::strtod(fields[column].c_str(), nullptr), static_cast<double>(number)) << name;
        } else {
          EXPECT_EQ(fields[column], "") << name;
        }
        ++column;
      });
      EXPECT_EQ(std::strtof(fields[column].c_str(), nullptr), step.ranges[0]);
      EXPECT_EQ(fields[column + 2], "") << "a beam without a range";
    }
  }
  EXPECT_EQ(row, 4 + 4);
  EXPECT_FALSE(std::getline(file, line));
}

TEST_F(DatasetExport, WritesArraysThatNumpyLoads) {
  const Dataset dataset = example();
  exportNumpy(in("a.npz"), dataset, true);
  const DriveStep& step = dataset.recordings[1].episodes[0].steps[2];
  int status = -1;
  const std::string shapes = python("for k in sorted(d.files): print(k, d[k].shape, d[k].dtype)", &status);
  if (status == 77) GTEST_SKIP() << "python3-numpy is not installed";
  EXPECT_EQ(shapes,
            "action_angles (5,) float64\nbeams (8, 8) int64\ndriven_angle (8,) float64\nepisode (8,) int64\n"
            "goal (8, 2) float64\ngoal_bearing (8,) float64\ngoal_distance (8,) float64\nheading (8,) float64\n"
            "label (8,) int64\nmeasured (8, 8) int64\nminimum_range (8, 8) float64\nnext_pose (8, 3) float64\n"
            "next_stamp (8,) float64\nnumber (8,) int64\npose (8, 3) float64\nprevious_action (8,) float64\n"
            "ranges (8, 16) float32\nrecording (8,) int64\nroute_bearing (8,) float64\nroute_length (8,) float64\n"
            "scan_geometry (8, 9) float64\nsector_range (8, 8) float64\nstamp (8,) float64\ntwist (8, 2) float64\n"
            "visits (8, 8) float64\n");
  EXPECT_EQ(python("print(*d['episode'], *d['recording'])", &status), "0 0 0 0 2 2 2 2 0 0 0 0 1 1 1 1\n");
  std::ostringstream expected;
  expected.precision(17);
  expected << step.pose.yaw << " " << step.observation.sector_ranges[7] << " " << step.label << " " << step.beams[0]
           << " inf " << step.ranges[15] << " nan " << step.geometry.mount.pose.yaw << " 1\n";
  EXPECT_EQ(python("g='%.17g'\nprint(g%d['pose'][6,2], g%d['sector_range'][6,7], d['label'][6], d['beams'][6,0], "
                   "d['minimum_range'][6,3], g%d['ranges'][6,15], d['ranges'][6,2], g%d['scan_geometry'][6,7], "
                   "int(d['scan_geometry'][6,8]))",
                   &status),
            expected.str());
}

TEST_F(DatasetExport, DescribesAnArrayAsTheFormatWantsIt) {
  const std::string file = toNpy(std::vector<double>{1.0, 2.0, 3.0, 4.0, 5.0, 6.0}, 3);
  EXPECT_EQ(file.substr(0, 8), std::string("\x93NUMPY\x01\x00", 8));
  const std::size_t length = static_cast<unsigned char>(file[8]) + 256u * static_cast<unsigned char>(file[9]);
  EXPECT_EQ((10 + length) % 64, 0u);
  EXPECT_EQ(file[10 + length - 1], '\n');
  EXPECT_EQ(file.size(), 10 + length + 6 * sizeof(double));
  EXPECT_EQ(file.find("{'descr': '<f8', 'fortran_order': False, 'shape': (2, 3), }"), 10u);
  EXPECT_NE(toNpy(std::vector<float>(5)).find("'<f4', 'fortran_order': False, 'shape': (5,), }"), std::string::npos);
  EXPECT_EQ(test::refusalOf<std::invalid_argument>([] { toNpy(std::vector<float>(5), 2); }),
            "5 numbers are no rows of 2");
}

TEST_F(DatasetExport, SaysWhenTheFileCannotBeWritten) {
  const std::string no_folder = "' cannot be written: No such file or directory";
  EXPECT_EQ(test::refusalOf<DatasetError>([&] { exportCsv(in("none/a.csv"), example(), false); }),
            "'" + in("none/a.csv") + no_folder);
  EXPECT_EQ(test::refusalOf<DatasetError>([&] { exportNumpy(in("none/a.npz"), example(), false); }),
            "'" + in("none/a.npz") + no_folder);
  EXPECT_EQ(test::refusalOf<DatasetError>([&] { exportNumpy(in("a.npz"), {}, false); }),
            "'" + in("a.npz") + "' is not written: the dataset has no steps");
}

TEST_F(DatasetExport, HasOneMeaningOfTheLabelsInArrays) {
  Dataset dataset = example();
  dataset.recordings[1].description.parameters.action_angles[0] = -1.4;
  EXPECT_EQ(test::refusalOf<DatasetError>([&] { exportNumpy(in("a.npz"), dataset, false); }),
            "'" + in("a.npz") + "' is not written: the labels of its recordings stand for different angles");
}

}  // namespace
}  // namespace lstm_planner::test_dataset_export
