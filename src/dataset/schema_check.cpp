#include "dataset/schema_check.hpp"

#include <Poco/Data/Statement.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "dataset/dataset_schema.hpp"

namespace lstm_planner {

namespace {

using Poco::Data::Keywords::into;
using Poco::Data::Keywords::now;

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

bool isGenerated(const SchemaColumn& column) {
  const std::string end = " GENERATED";
  const std::string& text = column.definition;
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

std::string textOf(const SchemaColumn& column) { return column.table + "." + column.name + " " + column.definition; }

}  // namespace

const std::vector<SchemaColumn>& schemaColumns() {
  static const std::vector<SchemaColumn> columns = [] {
    Poco::Data::Session session("SQLite", ":memory:");
    for (const char* table : kDatasetSchema) session << table, now;
    return columnsOf(session);
  }();
  return columns;
}

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

}  // namespace lstm_planner
