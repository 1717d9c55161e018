// Files that somebody has made on purpose: opening one takes neither long nor much memory.

#include <Poco/Data/SQLite/Connector.h>
#include <Poco/Data/Session.h>
#include <Poco/Data/Statement.h>

#include "dataset/dataset_file.hpp"
#include "lstm_planner/dataset/dataset_writer.hpp"
#include "unit/dataset/dataset_fixtures.hpp"

namespace lstm_planner::test_dataset_trust {
namespace {

class DatasetTrust : public ExampleFileTest {
 protected:
  /// Changes the file without the package.
  void change(const std::vector<std::string>& statements) {
    Poco::Data::SQLite::Connector::registerConnector();
    Poco::Data::Session session("SQLite", in("a.db"));
    for (const std::string& statement : statements) session << statement, Poco::Data::Keywords::now;
  }

  std::string refusalOfReader() const {
    return test::refusalOf<DatasetError>([this] { readDataset(in("a.db"), true); });
  }
  std::string refusalOfWriter() const {
    return test::refusalOf<DatasetError>([this] { DatasetWriter(in("a.db"), exampleDescription()); });
  }
  std::string noDataset(const std::string& reason) const {
    return "'" + in("a.db") + "' is no dataset of lstm_planner: " + reason;
  }
  std::string unreadable(const std::string& reason) const {
    return "dataset '" + in("a.db") + "' cannot be read: " + reason;
  }
};

const std::string kEndless = "WITH RECURSIVE n(x) AS (SELECT 1 UNION ALL SELECT x + 1 FROM n) SELECT count(*) FROM n";

TEST_F(DatasetTrust, AViewIsNoTable) {
  change({"ALTER TABLE episodes RENAME TO moved", "CREATE VIEW episodes AS SELECT * FROM moved, (" + kEndless + ")"});
  EXPECT_EQ(refusalOfReader(), noDataset("it has the view episodes, expected nothing but tables"));
  EXPECT_EQ(refusalOfWriter(), refusalOfReader());
}

TEST_F(DatasetTrust, ATriggerDoesNotRun) {
  change({"CREATE TRIGGER busy AFTER INSERT ON recordings BEGIN DELETE FROM steps; END"});
  EXPECT_EQ(refusalOfWriter(), noDataset("it has the trigger busy, expected nothing but tables"));
}

TEST_F(DatasetTrust, IndexesAndGeneratedColumnsOfOthersAreRefused) {
  change({"CREATE INDEX mine ON steps (label * 2)"});
  EXPECT_EQ(refusalOfReader(), noDataset("it has the index mine, expected nothing but tables"));
  change({"DROP INDEX mine", "ALTER TABLE episodes ADD COLUMN more AS (zeroblob(1000000000))"});
  EXPECT_EQ(refusalOfReader().find(noDataset("it has the column episodes.more")), 0u) << refusalOfReader();
}

TEST_F(DatasetTrust, AColumnThatIsMissingOrOfAnotherTypeIsNamed) {
  change({"ALTER TABLE scans RENAME TO old", "CREATE TABLE scans (step INTEGER, ranges TEXT)"});
  EXPECT_EQ(refusalOfReader(), noDataset("it has no column scans.step INTEGER PRIMARY KEY"));
}

TEST_F(DatasetTrust, ANullInAColumnThatHasNoneIsRefused) {
  const auto rewrite = [](const std::string& from, const std::string& to) {
    return "UPDATE sqlite_master SET sql = replace(sql, '" + from + "', '" + to + "') WHERE name = 'scans'";
  };
  change({"PRAGMA writable_schema = ON", rewrite("ranges BLOB NOT NULL", "ranges BLOB")});
  change({"UPDATE scans SET ranges = NULL WHERE step = 2"});
  EXPECT_EQ(refusalOfReader(), noDataset("it has no column scans.ranges BLOB NOT NULL"));
  change({"PRAGMA writable_schema = ON", rewrite("ranges BLOB", "ranges BLOB NOT NULL")});
  EXPECT_EQ(refusalOfReader(), unreadable("SQLite finds it damaged: NULL value in scans.ranges"));
}

TEST_F(DatasetTrust, AQueryWithoutEndIsEnded) {
  DatasetFile file(in("a.db"), DatasetFile::Use::kRead, 0);
  EXPECT_EQ(test::refusalOf<DatasetError>([&] { file.transact([&] { file.execute(kEndless); }); }),
            unreadable("a query took much longer than the file's length gives reason to"));
  EXPECT_EQ(file.numberOf("SELECT count(*) FROM recordings"), 1);
}

TEST_F(DatasetTrust, ValuesHaveABoundedLength) {
  change({"UPDATE scans SET ranges = zeroblob(2000000) WHERE step = 2"});
  EXPECT_EQ(refusalOfReader(), unreadable("string or blob too big"));
}

TEST_F(DatasetTrust, PagesAreNotUsedTwice) {
  change({"PRAGMA writable_schema = ON",
          "UPDATE sqlite_master SET rootpage = (SELECT rootpage FROM sqlite_master WHERE name = 'steps') "
          "WHERE name = 'scans'"});
  EXPECT_EQ(refusalOfReader().find(unreadable("SQLite finds it damaged: ")), 0u) << refusalOfReader();
}

}  // namespace
}  // namespace lstm_planner::test_dataset_trust
