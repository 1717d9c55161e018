#pragma once

#include <Poco/Data/Session.h>

#include <cstddef>
#include <string>

#include "lstm_planner/dataset/dataset.hpp"

namespace lstm_planner {

/// What is wrong with the schema of an open dataset, as a sentence's end: a view, trigger, virtual table or index of
/// somebody else's, a generated column, a column of the schema that is missing or defined otherwise. Empty when nothing
/// is. Throws Poco exceptions.
std::string flawOfSchema(Poco::Data::Session& session);

/// SQLite keeps whatever it is given in a column, whichever type the schema names. Throws std::invalid_argument naming
/// the first row with a value of another type; with a number that is not finite or that no measurement has
/// (kLargestNumber); or with an integer that is negative or does not fit into 31 bits. Afterwards numbers are read
/// without loss. Throws Poco exceptions.
void checkValues(Poco::Data::Session& session);

// What holds for each row that is written to a dataset file or read from it, whoever made the file: readers index
// arrays and reserve memory by these values. Each throws std::invalid_argument saying what is wrong.

void checkRow(const ScanGeometry& geometry);

void checkRow(const Episode& episode);

/// `angles`: the number of allowed angles of its recording.
void checkRow(const DriveStep& step, std::size_t angles);

/// The same for a step that is to be written, and for its scan. In a file checkValues() and the geometry's row hold for
/// the scan.
void checkStepWithScan(const DriveStep& step, std::size_t angles);

/// A number that checkRow() would accept; `name`: of its column.
void checkNumber(const std::string& name, double value);

}  // namespace lstm_planner
