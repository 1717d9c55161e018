#include <Poco/Data/SQLite/Connector.h>
#include <Poco/Data/SQLite/Utility.h>
#include <Poco/Data/Session.h>
#include <Poco/Exception.h>
#include <sqlite3.h>

#include <array>
#include <string>

#include "fuzz/fuzz_dataset.hpp"
#include "fuzz/fuzz_input.hpp"
#include "fuzz/scratch_file.hpp"

namespace lstm_planner::fuzz::dataset_sql_harness {
namespace {

/// SQL that somebody may have run on a dataset, from a small grammar.
class StatementMaker {
 public:
  explicit StatementMaker(FuzzInput* input) : input_(*input) {}

  std::string statement() {
    const std::string name = table();
    switch (input_.byte() % 16) {
      case 0:
        return "DROP TABLE " + name;
      case 1:
        return "ALTER TABLE " + name + " RENAME TO old_" + name;
      case 2:
        return "CREATE VIEW " + name + " AS " + query();
      case 3:
        return "CREATE TRIGGER fuzz BEFORE INSERT ON " + name + " BEGIN " + query() + "; END";
      case 4:
        return "CREATE TABLE " + name + " (id INTEGER PRIMARY KEY, " + column() + " AS (" + value() + "))";
      case 5:
        return "CREATE TABLE " + name + " AS " + query();
      case 6:
        return "CREATE INDEX fuzz ON " + name + " (" + expression() + ")";
      case 7:
        return "ALTER TABLE " + name + " RENAME COLUMN " + column() + " TO " + column();
      case 8:
        return "INSERT INTO " + name + " " + query();
      case 9:
        return "DELETE FROM " + name + " WHERE " + expression();
      case 10:
        return "PRAGMA " + pragma();
      case 11:
        return "UPDATE sqlite_master SET sql = replace(sql, '" + name + "', '" + table() + "'), type = '" +
               (input_.flag() ? "view" : "table") + "' WHERE name = '" + name + "'";
      default:
        return "UPDATE " + name + " SET " + column() + " = " + expression();
    }
  }

 private:
  std::string table() {
    static const std::array<std::string, 7> kTables = {"recordings", "episodes",   "geometries", "steps",
                                                       "scans",      "rejections", "others"};
    return input_.pick(kTables);
  }

  std::string column() {
    static const std::array<std::string, 36> kColumns = {"id",
                                                         "recording",
                                                         "source",
                                                         "software_version",
                                                         "odometry_frame",
                                                         "begun",
                                                         "parameters",
                                                         "finished",
                                                         "goal_frame",
                                                         "goal_x",
                                                         "goal_yaw",
                                                         "ended",
                                                         "ending",
                                                         "discarded",
                                                         "frame",
                                                         "angle_min",
                                                         "angle_increment",
                                                         "beams",
                                                         "range_min",
                                                         "range_max",
                                                         "mount_x",
                                                         "upside_down",
                                                         "episode",
                                                         "geometry",
                                                         "number",
                                                         "stamp",
                                                         "next_stamp",
                                                         "pose_x",
                                                         "sector_range_0",
                                                         "minimum_range_0",
                                                         "beams_0",
                                                         "measured_0",
                                                         "label",
                                                         "step",
                                                         "ranges",
                                                         "count"};
    return input_.pick(kColumns);
  }

  std::string value() {
    static const std::array<std::string, 24> kValues = {"NULL",
                                                        "0",
                                                        "1",
                                                        "-1",
                                                        "-7",
                                                        "5",
                                                        "500000000",
                                                        "2147483648",
                                                        "4294967297",
                                                        "9223372036854775807",
                                                        "-9223372036854775808",
                                                        "1e300",
                                                        "-1e300",
                                                        "9e999",
                                                        "1e-320",
                                                        "'text'",
                                                        "''",
                                                        "x''",
                                                        "x'00'",
                                                        "zeroblob(64)",
                                                        "zeroblob(1048577)",
                                                        "'[]'",
                                                        "'{\"action_angles\":[]}'",
                                                        "'{\"range_cap\":1e300,\"memory_width\":1e9}'"};
    return input_.pick(kValues);
  }

  std::string expression() {
    switch (input_.byte() % 8) {
      case 0:
        return column();
      case 1:
        return column() + " + " + value();
      case 2:
        return "(SELECT count(*) FROM " + table() + ")";
      case 3:
        return "randomblob(" + std::to_string(input_.byte()) + ")";
      default:
        return value();
    }
  }

  std::string query() {
    switch (input_.byte() % 4) {
      case 0:
        return "SELECT * FROM " + table();
      case 1:
        return "SELECT " + value() + " AS " + column() + ", " + value() + " AS " + column();
      case 2:
        return "WITH RECURSIVE c(n) AS (SELECT 1 UNION ALL SELECT n + 1 FROM c" +
               std::string(input_.flag() ? " LIMIT 100" : "") + ") SELECT n AS id, " + value() + " AS " + column() +
               " FROM c";
      default:
        return "SELECT * FROM " + table() + " JOIN " + table();
    }
  }

  std::string pragma() {
    static const std::array<std::string, 8> kPragmas = {
        "user_version = ",        "application_id = ",       "writable_schema = ", "foreign_keys = ",
        "journal_mode = WAL; --", "encoding = 'UTF-16'; --", "auto_vacuum = ",     "schema_version = "};
    return input_.pick(kPragmas) + std::to_string(input_.integer(0, 2));
  }

  FuzzInput& input_;
};

/// Ends statements that would take long, or fill the disk: how long SQLite works for whoever writes is not what is
/// tested.
class WriterLimits {
 public:
  explicit WriterLimits(Poco::Data::Session* session) : database_(Poco::Data::SQLite::Utility::dbHandle(*session)) {
    const auto is_too_much = [](void* calls) { return --*static_cast<int*>(calls) < 0 ? 1 : 0; };
    sqlite3_progress_handler(database_, kOperationsACall, is_too_much, &calls_left_);
    *session << "PRAGMA max_page_count = 1024", Poco::Data::Keywords::now;
  }

  ~WriterLimits() { sqlite3_progress_handler(database_, 0, nullptr, nullptr); }
  WriterLimits(const WriterLimits&) = delete;
  WriterLimits& operator=(const WriterLimits&) = delete;

  void allowAStatement() { calls_left_ = kCallsAStatement; }

 private:
  static constexpr int kOperationsACall = 1000;
  static constexpr int kCallsAStatement = 20;
  sqlite3* database_;
  int calls_left_ = kCallsAStatement;
};

void execute(const std::string& path, FuzzInput* input) {
  static const bool registered = (Poco::Data::SQLite::Connector::registerConnector(), true);
  static_cast<void>(registered);
  constexpr int kMostStatements = 8;
  Poco::Data::Session session("SQLite", path);
  session << "PRAGMA journal_mode = OFF", Poco::Data::Keywords::now;
  session << "PRAGMA synchronous = OFF", Poco::Data::Keywords::now;
  WriterLimits limits(&session);
  for (int i = 0; i < kMostStatements && !input->empty(); ++i) {
    const std::string statement = StatementMaker(input).statement();
    limits.allowAStatement();
    try {
      session << statement, Poco::Data::Keywords::now;
    } catch (const Poco::Exception&) {
      // What SQLite itself refuses need not be read.
    }
  }
}

void readHostile(const std::uint8_t* data, std::size_t size) {
  static ScratchFile file(".sqlite");
  static const std::string sound = soundDataset();
  FuzzInput input(data, size);
  const int reader = input.byte();
  file.write(sound);
  execute(file.path(), &input);
  readDatasetFile(file.path(), reader);
}

const Registration registration("dataset_sql", &readHostile);

}  // namespace
}  // namespace lstm_planner::fuzz::dataset_sql_harness
