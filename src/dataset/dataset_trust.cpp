#include "dataset/dataset_trust.hpp"

#include <Poco/Data/Statement.h>
#include <Poco/Nullable.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "dataset/dataset_schema.hpp"
#include "dataset/step_quantities.hpp"
#include "lstm_planner/common/text_table.hpp"
#include "lstm_planner/dataset/drive_step.hpp"
#include "lstm_planner/drive/perception/sectors.hpp"

namespace lstm_planner {
namespace {

using Poco::Data::Keywords::into;
using Poco::Data::Keywords::now;

/// A column of a dataset's tables.
struct SchemaColumn {
  std::string table;
  std::string name;
  std::string definition;  ///< "TYPE", " PRIMARY KEY" and " NOT NULL" where it is so
};

/// Tables have pages of their own, virtual ones have none; indexes without SQL are SQLite's own.
constexpr const char* kOtherObjects =
    "SELECT (CASE WHEN type = 'table' THEN 'virtual table' ELSE type END) || ' ' || name FROM sqlite_master "
    "WHERE NOT (type = 'table' AND rootpage > 0) AND NOT (type = 'index' AND sql IS NULL)";

/// Definitions of generated columns end in GENERATED.
constexpr const char* kColumns =
    "SELECT tables.name, columns.name, columns.type || "
    "CASE WHEN columns.pk > 0 THEN ' PRIMARY KEY' ELSE '' END || "
    "CASE WHEN columns.\"notnull\" THEN ' NOT NULL' ELSE '' END || "
    "CASE WHEN columns.hidden > 0 THEN ' GENERATED' ELSE '' END "
    "FROM sqlite_master AS tables, pragma_table_xinfo(tables.name) AS columns WHERE tables.type = 'table'";

std::vector<SchemaColumn> columnsOf(Poco::Data::Session& session) {
  std::vector<std::string> tables;
  std::vector<std::string> names;
  std::vector<std::string> definitions;
  session << kColumns, into(tables), into(names), into(definitions), now;
  std::vector<SchemaColumn> columns;
  for (std::size_t i = 0; i < tables.size(); ++i) columns.push_back({tables[i], names[i], definitions[i]});
  return columns;
}

bool contains(const std::string& text, const std::string& word) { return text.find(word) != std::string::npos; }

bool isGenerated(const SchemaColumn& column) { return contains(column.definition, " GENERATED"); }

std::string textOf(const SchemaColumn& column) { return column.table + "." + column.name + " " + column.definition; }

/// The columns of kDatasetSchema, table by table.
const std::vector<SchemaColumn>& schemaColumns() {
  static const std::vector<SchemaColumn> columns = [] {
    Poco::Data::Session session("SQLite", ":memory:");
    for (const char* table : kDatasetSchema) session << table, now;
    return columnsOf(session);
  }();
  return columns;
}

struct Expectation {
  std::string condition;  ///< SQL, never NULL
  std::string words;
};

Expectation expectationOf(const SchemaColumn& column) {
  const std::string& name = column.name;
  if (column.definition.rfind("INTEGER", 0) == 0) {
    return {"(typeof(" + name + ") = 'integer' AND " + name + " BETWEEN 0 AND 2147483647)",
            "a whole number from 0 to 2147483647"};
  }
  if (column.definition.rfind("TEXT", 0) == 0) return {"typeof(" + name + ") = 'text'", "a text"};
  if (column.definition.rfind("BLOB", 0) == 0) return {"typeof(" + name + ") = 'blob'", "a blob"};
  std::ostringstream largest;
  largest << kLargestNumber;
  std::string condition = "(typeof(" + name + ") = 'real' AND abs(" + name + ") <= " + largest.str() + ")";
  std::string words = "a number from -" + largest.str() + " to " + largest.str();
  // Some simulators have infinity there.
  if (name == "range_max") condition = "typeof(" + name + ") = 'real'";
  if (contains(column.definition, "NOT NULL")) return {condition, words};
  return {"(" + name + " IS NULL OR " + condition + ")", words + ", or NULL"};
}

[[noreturn]] void refuse(Poco::Data::Session& session, const std::vector<SchemaColumn>& columns, Poco::Int64 row) {
  const std::string& table = columns.front().table;
  const std::string from = " FROM " + table + " WHERE rowid = " + std::to_string(row);
  for (const SchemaColumn& column : columns) {
    const Expectation expected = expectationOf(column);
    std::string value;
    session << "SELECT CASE WHEN " + expected.condition + " THEN '' WHEN typeof(" + column.name +
                   ") IN ('text', 'blob', 'null') THEN typeof(" + column.name + ") ELSE CAST(" + column.name +
                   " AS TEXT) END" + from,
        into(value), now;
    if (value.empty()) continue;
    throw std::invalid_argument("row " + std::to_string(row) + " of table " + table + ": " + column.name + " is " +
                                value + ", expected " + expected.words);
  }
  throw std::invalid_argument("row " + std::to_string(row) + " of table " + table + " is wrong");
}

void checkTable(Poco::Data::Session& session, const std::vector<SchemaColumn>& columns) {
  std::string conditions;
  for (const SchemaColumn& column : columns) {
    conditions += (conditions.empty() ? "" : " AND ") + expectationOf(column).condition;
  }
  Poco::Nullable<Poco::Int64> wrong;
  session << "SELECT (SELECT rowid FROM " + columns.front().table + " WHERE NOT (" + conditions + ") LIMIT 1)",
      into(wrong), now;
  if (!wrong.isNull()) refuse(session, columns, wrong.value());
}

void checkNumbers(const DriveStep& step) {
  visitColumns(step, [&](const std::string& name, const char*, const auto& number) {
    const double value = static_cast<double>(number);
    const bool is_missing = name.rfind("minimum_range_", 0) == 0 && std::isinf(value) && value > 0.0;
    if (!is_missing) checkNumber(name, value);
  });
}

}  // namespace

std::string flawOfSchema(Poco::Data::Session& session) {
  std::vector<std::string> others;
  session << kOtherObjects, into(others), now;
  if (!others.empty()) return "it has the " + others.front() + ", expected nothing but tables";
  const std::vector<SchemaColumn> columns = columnsOf(session);
  const auto generated = std::find_if(columns.begin(), columns.end(), isGenerated);
  if (generated != columns.end()) {
    return "it has the column " + textOf(*generated) + ", expected nothing but plain columns";
  }
  std::set<std::string> found;
  for (const SchemaColumn& column : columns) found.insert(textOf(column));
  for (const SchemaColumn& expected : schemaColumns()) {
    if (found.count(textOf(expected)) == 0) return "it has no column " + textOf(expected);
  }
  return "";
}

void checkValues(Poco::Data::Session& session) {
  std::map<std::string, std::vector<SchemaColumn>> tables;
  for (const SchemaColumn& column : schemaColumns()) tables[column.table].push_back(column);
  for (const auto& [name, columns] : tables) checkTable(session, columns);
}

void checkRow(const ScanGeometry& geometry) {
  if (geometry.beams < 1 || geometry.beams > kMostBeams) {
    throw std::invalid_argument("it has " + std::to_string(geometry.beams) + " beams, expected 1 to " +
                                std::to_string(kMostBeams));
  }
  LaserScan scan = scanOf(geometry, std::vector<float>(static_cast<std::size_t>(geometry.beams)));
  checkScan(scan, geometry.mount);
  const double somewhere = std::clamp(1.0, geometry.range_min, geometry.range_max);
  std::fill(scan.ranges.begin(), scan.ranges.end(), static_cast<float>(somewhere));
  averageSectors(scan, geometry.mount, {}, 1.0);
}

void checkNumber(const std::string& name, double value) {
  if (std::abs(value) <= kLargestNumber) return;
  throw std::invalid_argument("its " + name + " is " + numberText(value) + ", expected a number from -" +
                              numberText(kLargestNumber) + " to " + numberText(kLargestNumber));
}

void checkRow(const Episode& episode) {
  checkNumber("goal_x", episode.goal.pose.x);
  checkNumber("goal_y", episode.goal.pose.y);
  checkNumber("goal_yaw", episode.goal.pose.yaw);
  checkNumber("begun", episode.begun);
  checkNumber("ended", episode.ended);
}

void checkStepWithScan(const DriveStep& step, std::size_t angles) {
  checkRow(step, angles);
  for (const auto* counts : {&step.beams, &step.measured}) {
    const int least = *std::min_element(counts->begin(), counts->end());
    if (least < 0) throw std::invalid_argument("a sector has " + std::to_string(least) + " beams, expected 0 or more");
  }
  if (!step.ranges.empty() && step.ranges.size() != static_cast<std::size_t>(step.geometry.beams)) {
    throw std::invalid_argument("its scan has " + std::to_string(step.ranges.size()) + " ranges, expected " +
                                std::to_string(step.geometry.beams) + " as in its geometry");
  }
  checkRow(step.geometry);
}

void checkRow(const DriveStep& step, std::size_t angles) {
  checkNumbers(step);
  if (step.label < 0 || static_cast<std::size_t>(step.label) >= angles) {
    throw std::invalid_argument("its label is " + std::to_string(step.label) + ", expected 0 to " +
                                std::to_string(angles - 1));
  }
}

}  // namespace lstm_planner
