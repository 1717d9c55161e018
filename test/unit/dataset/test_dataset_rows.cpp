// Rows that no recorder writes: whoever reads the file is told so, and works on none of it.

#include "dataset/dataset_file.hpp"
#include "lstm_planner/dataset/dataset_check.hpp"
#include "lstm_planner/dataset/dataset_edit.hpp"
#include "unit/dataset/dataset_fixtures.hpp"

namespace lstm_planner {
namespace {

class DatasetRowsTest : public DatasetTest {
 protected:
  void SetUp() override {
    DatasetTest::SetUp();
    Dataset dataset;
    dataset.recordings = {exampleRecording(2, 1)};
    writeDataset(in("a.db"), dataset);
  }

  /// What is said of a file in which `statement` has changed something.
  std::string refusalAfter(const std::string& statement) {
    std::filesystem::copy_file(in("a.db"), in("b.db"), std::filesystem::copy_options::overwrite_existing);
    {
      DatasetFile file(in("b.db"), DatasetFile::Use::kWrite, 1000);
      file.transact([&] { file.execute(statement); });
    }
    try {
      readDataset(in("b.db"), true);
    } catch (const DatasetError& error) {
      return error.what();
    }
    return "read";
  }
  std::string refused(const std::string& reason) const {
    return "dataset '" + in("b.db") + "' cannot be read: " + reason;
  }
};

TEST_F(DatasetRowsTest, LabelsNameAnAllowedAngle) {
  for (const std::string label : {"-1", "5", "500000000"}) {
    EXPECT_EQ(refusalAfter("UPDATE steps SET label = " + label + " WHERE id = 3"),
              refused("step 3: its label is " + label + ", expected 0 to 4"));
  }
  EXPECT_EQ(refusalAfter("UPDATE steps SET label = 4 WHERE id = 3"), "read");
}

TEST_F(DatasetRowsTest, ParametersAreThoseOfARecorder) {
  const std::string period = R"(UPDATE recordings SET parameters = '{"period": -1}')";
  EXPECT_EQ(refusalAfter(period), refused("recording 1: parameter period is -1, expected a positive number"));
}

}  // namespace
}  // namespace lstm_planner
