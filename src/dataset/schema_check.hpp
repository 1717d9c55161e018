#pragma once

#include <Poco/Data/Session.h>

#include <string>
#include <vector>

namespace lstm_planner {

/// A column of a dataset's tables.
struct SchemaColumn {
  std::string table;
  std::string name;
  std::string definition;  ///< "TYPE", " PRIMARY KEY" and " NOT NULL" where it is so
};

/// The columns of kDatasetSchema, table by table.
const std::vector<SchemaColumn>& schemaColumns();

/// What is wrong with the schema of an open dataset, as a sentence's end: a view, trigger, virtual table or index of
/// somebody else's, a generated column, a column of the schema that is missing or defined otherwise. Empty when nothing
/// is. Throws Poco exceptions.
std::string flawOfSchema(Poco::Data::Session& session);

}  // namespace lstm_planner
