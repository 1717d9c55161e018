#pragma once

#include <Poco/Data/Session.h>

namespace lstm_planner {

/// SQLite keeps whatever it is given in a column, whichever type the schema names. Throws std::invalid_argument naming
/// the first row with a value of another type; with a number that is not finite or that no measurement has
/// (kLargestNumber); or with an integer that is negative or does not fit into 31 bits. Afterwards numbers are read
/// without loss. Throws Poco exceptions.
void checkValues(Poco::Data::Session& session);

}  // namespace lstm_planner
