#pragma once

#include <Poco/Data/Session.h>

#include <string>

namespace lstm_planner {

/// What is wrong with the schema of an open dataset, as a sentence's end: a view, trigger, virtual table or index of
/// somebody else's, a generated column, a column of the schema that is missing or defined otherwise. Empty when nothing
/// is. Throws Poco exceptions.
std::string flawOfSchema(Poco::Data::Session& session);

}  // namespace lstm_planner
