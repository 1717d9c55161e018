#include "dataset/schema_check.hpp"

#include <Poco/Data/Statement.h>

#include <algorithm>
#include <vector>

#include "dataset/dataset_schema.hpp"

namespace lstm_planner {

namespace {

using Poco::Data::Keywords::into;
using Poco::Data::Keywords::now;

std::vector<std::string> textsOf(Poco::Data::Session& session, const std::string& query) {
  std::vector<std::string> texts;
  session << query, into(texts), now;
  return texts;
}

/// Tables have pages of their own, virtual ones have none; indexes without SQL are SQLite's own.
constexpr const char* kOtherObjects =
    "SELECT (CASE WHEN type = 'table' THEN 'virtual table' ELSE type END) || ' ' || name FROM sqlite_master "
    "WHERE NOT (type = 'table' AND rootpage > 0) AND NOT (type = 'index' AND sql IS NULL)";

/// One text a column; those of generated columns end in 2 or 3.
constexpr const char* kColumns =
    "SELECT tables.name || '.' || columns.name || ' ' || columns.type || "
    "CASE WHEN columns.pk > 0 THEN ' PRIMARY KEY' ELSE '' END || "
    "CASE WHEN columns.\"notnull\" THEN ' NOT NULL' ELSE '' END || "
    "CASE WHEN columns.hidden > 0 THEN ' GENERATED' ELSE '' END "
    "FROM sqlite_master AS tables, pragma_table_xinfo(tables.name) AS columns WHERE tables.type = 'table'";

const std::vector<std::string>& expectedColumns() {
  static const std::vector<std::string> columns = [] {
    Poco::Data::Session session("SQLite", ":memory:");
    for (const char* table : kDatasetSchema) session << table, now;
    return textsOf(session, kColumns);
  }();
  return columns;
}

bool isGenerated(const std::string& column) {
  const std::string end = " GENERATED";
  return column.size() >= end.size() && column.compare(column.size() - end.size(), end.size(), end) == 0;
}

}  // namespace

std::string flawOfSchema(Poco::Data::Session& session) {
  const std::vector<std::string> others = textsOf(session, kOtherObjects);
  if (!others.empty()) return "it has the " + others.front() + ", expected nothing but tables";
  const std::vector<std::string> columns = textsOf(session, kColumns);
  const auto generated = std::find_if(columns.begin(), columns.end(), isGenerated);
  if (generated != columns.end()) return "it has the column " + *generated + ", expected nothing but plain columns";
  for (const std::string& column : expectedColumns()) {
    if (std::find(columns.begin(), columns.end(), column) == columns.end()) return "it has no column " + column;
  }
  return "";
}

}  // namespace lstm_planner
