// Rows that no recorder writes: whoever reads the file is told so, and works on none of it.

#include "dataset/dataset_file.hpp"
#include "lstm_planner/dataset/dataset_check.hpp"
#include "unit/dataset/dataset_fixtures.hpp"

namespace lstm_planner::test_dataset_rows {
namespace {

class DatasetRowsTest : public ExampleFileTest {
 protected:
  /// What is said of a file in which `statement` has changed something; empty when it is read.
  std::string refusalAfter(const std::string& statement) {
    std::filesystem::copy_file(in("a.db"), in("b.db"), std::filesystem::copy_options::overwrite_existing);
    {
      DatasetFile file(in("b.db"), DatasetFile::Use::kWrite, 1000);
      file.transact([&] { file.execute(statement); });
    }
    return test::refusalOf<DatasetError>([this] { readDataset(in("b.db"), true); });
  }
  std::string refused(const std::string& reason) const {
    return "dataset '" + in("b.db") + "' cannot be read: " + reason;
  }
};

TEST_F(DatasetRowsTest, LabelsNameAnAllowedAngle) {
  for (const std::string label : {"5", "500000000"}) {
    EXPECT_EQ(refusalAfter("UPDATE steps SET label = " + label + " WHERE id = 3"),
              refused("step 3: its label is " + label + ", expected 0 to 4"));
  }
  EXPECT_EQ(refusalAfter("UPDATE steps SET label = -1 WHERE id = 3"),
            refused("row 3 of table steps: label is -1, expected a whole number from 0 to 2147483647"));
  EXPECT_EQ(refusalAfter("UPDATE steps SET label = 4 WHERE id = 3"), "");
}

TEST_F(DatasetRowsTest, ParametersAreThoseOfARecorder) {
  const auto with = [this](const std::string& json) {
    return refusalAfter("UPDATE recordings SET parameters = '" + json + "'");
  };
  EXPECT_EQ(with(R"({"period": -1})"),
            refused("recording 1: parameter period is -1, expected a number in [0.0001, 3600]"));
  EXPECT_EQ(with(R"({"range_cap": 1e300})"),
            refused("recording 1: parameter range_cap is 1e+300, expected a number in [0.01, 1000]"));
  EXPECT_EQ(with("[]"), refused("recording 1: the recorder's parameters are of type array, expected an object"));
  EXPECT_EQ(with("{").find(refused("recording 1: ")), 0u) << with("{");
}

TEST_F(DatasetRowsTest, ValuesAreOfTheColumnsType) {
  const std::string whole = ", expected a whole number from 0 to 2147483647";
  const std::string number = ", expected a number from -1e+10 to 1e+10";
  const auto with = [this](const std::string& table, const std::string& value) {
    return refusalAfter("UPDATE " + table + " SET " + value + " WHERE rowid = 2");
  };
  const std::string step = "row 2 of table steps: ";
  EXPECT_EQ(with("steps", "label = 4294967297"), refused(step + "label is 4294967297" + whole)) << "1 in 32 bits";
  EXPECT_EQ(with("steps", "beams_3 = 4294967298"), refused(step + "beams_3 is 4294967298" + whole));
  EXPECT_EQ(with("steps", "label = 1.5"), refused(step + "label is 1.5" + whole));
  EXPECT_EQ(with("steps", "pose_x = 'far'"), refused(step + "pose_x is text" + number));
  EXPECT_EQ(with("steps", "pose_x = x'00'"), refused(step + "pose_x is blob" + number));
  EXPECT_EQ(with("steps", "goal_x = 9e999"), refused(step + "goal_x is Inf" + number));
  EXPECT_EQ(with("steps", "goal_x = -1e11"), refused(step + "goal_x is -100000000000.0" + number));
  EXPECT_EQ(with("steps", "minimum_range_0 = 'near'"),
            refused(step + "minimum_range_0 is text" + number + ", or NULL"));
  EXPECT_EQ(with("steps", "minimum_range_0 = NULL"), "");
  EXPECT_EQ(with("scans", "ranges = 'none'"), refused("row 2 of table scans: ranges is text, expected a blob"));
  EXPECT_EQ(with("episodes", "goal_frame = x'00'"),
            refused("row 2 of table episodes: goal_frame is blob, expected a text"));
}

TEST_F(DatasetRowsTest, GeometriesAreThoseOfAScanner) {
  const auto with = [this](const std::string& value) { return refusalAfter("UPDATE geometries SET " + value); };
  const std::string geometry = "geometry 1: the scan ";
  EXPECT_EQ(with("beams = -7"),
            refused("row 1 of table geometries: beams is -7, expected a whole number from 0 to 2147483647"));
  EXPECT_EQ(with("beams = 0"), refused("geometry 1: it has 0 beams, expected 1 to 100000"));
  EXPECT_EQ(with("beams = 2147483647"), refused("geometry 1: it has 2147483647 beams, expected 1 to 100000"));
  EXPECT_EQ(with("angle_increment = 0").find(refused(geometry + "has angle_min ")), 0u);
  EXPECT_EQ(with("angle_increment = 0.001").find(refused(geometry + "covers ")), 0u);
  EXPECT_EQ(with("range_min = 40").find(refused(geometry + "has range_min ")), 0u);
  EXPECT_EQ(with("range_max = 9e999"), "") << "some simulators have that";
}

TEST_F(DatasetRowsTest, ScansHaveARangeOfEachBeam) {
  const auto with = [this](const std::string& ranges) {
    return refusalAfter("UPDATE scans SET ranges = " + ranges + " WHERE step = 2");
  };
  for (const std::string bytes : {"0", "60", "63", "900000"}) {
    EXPECT_EQ(with("zeroblob(" + bytes + ")"),
              refused("step 2: its scan has " + bytes + " bytes, expected 64 of 16 beams"));
  }
}

TEST_F(DatasetRowsTest, AScanOfZerosWasNotMeasured) {
  ASSERT_EQ(refusalAfter("UPDATE scans SET ranges = zeroblob(64) WHERE step = 2"), "");
  const std::vector<std::string> sentences = checkDatasetFile(in("b.db"));
  ASSERT_FALSE(sentences.empty());
  EXPECT_EQ(sentences[0].find("recording 0, episode 0, step 1: the scan has 0 of 2 beams measured from -90"), 0u)
      << sentences[0];
}

}  // namespace
}  // namespace lstm_planner::test_dataset_rows
