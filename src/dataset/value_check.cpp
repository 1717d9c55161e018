#include "dataset/value_check.hpp"

#include <Poco/Data/Statement.h>
#include <Poco/Nullable.h>

#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "dataset/schema_check.hpp"
#include "lstm_planner/dataset/drive_step.hpp"

namespace lstm_planner {

namespace {

using Poco::Data::Keywords::into;
using Poco::Data::Keywords::now;

bool startsWith(const std::string& text, const std::string& with) { return text.compare(0, with.size(), with) == 0; }

bool contains(const std::string& text, const std::string& word) { return text.find(word) != std::string::npos; }

struct Expectation {
  std::string condition;  ///< SQL, never NULL
  std::string words;
};

Expectation expectationOf(const SchemaColumn& column) {
  const std::string& name = column.name;
  if (startsWith(column.definition, "INTEGER")) {
    return {"(typeof(" + name + ") = 'integer' AND " + name + " BETWEEN 0 AND 2147483647)",
            "a whole number from 0 to 2147483647"};
  }
  if (startsWith(column.definition, "TEXT")) return {"typeof(" + name + ") = 'text'", "a text"};
  if (startsWith(column.definition, "BLOB")) return {"typeof(" + name + ") = 'blob'", "a blob"};
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

}  // namespace

void checkValues(Poco::Data::Session& session) {
  std::map<std::string, std::vector<SchemaColumn>> tables;
  for (const SchemaColumn& column : schemaColumns()) tables[column.table].push_back(column);
  for (const auto& [name, columns] : tables) checkTable(session, columns);
}

}  // namespace lstm_planner
