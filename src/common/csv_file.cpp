#include "lstm_planner/common/csv_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include "lstm_planner/common/input_file.hpp"

namespace lstm_planner {
namespace {

constexpr const char* kBlank = " \t\r";
constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";        // of UTF-8, as spreadsheets write it
constexpr std::uintmax_t kLargestTable = std::uintmax_t{1} << 26;  // bytes
constexpr std::size_t kLongestLine = std::size_t{1} << 16;         // letters

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream stream(line);
  for (std::string field; std::getline(stream, field, ',');) {
    const auto first = field.find_first_not_of(kBlank);
    const auto last = field.find_last_not_of(kBlank);
    fields.push_back(first == std::string::npos ? "" : field.substr(first, last - first + 1));
  }
  return fields;
}

std::string readTableFile(const std::string& path) {
  try {
    return readInputFile(path, kLargestTable);
  } catch (const InputFileError& error) {
    throw std::invalid_argument("'" + path + "' cannot be read: " + error.what());
  }
}

[[noreturn]] void refuseLength(const std::string& path, int number) {
  throw std::invalid_argument("'" + path + "', line " + std::to_string(number) + ": it is longer than " +
                              std::to_string(kLongestLine) + " letters");
}

double toNumber(const std::string& text, const std::string& where, const std::string& column) {
  std::istringstream stream(text);
  double value = 0.0;
  if (!(stream >> value) || !stream.eof() || !std::isfinite(value)) {
    throw std::invalid_argument(where + ": column " + column + " is '" + text + "', expected a number");
  }
  return value;
}

}  // namespace

CsvFile::CsvFile(const std::string& path, const std::vector<std::string>& columns,
                 const std::vector<std::string>& optional_columns) {
  std::istringstream file(readTableFile(path));
  std::string line;
  if (!std::getline(file, line)) throw std::invalid_argument("'" + path + "' cannot be read: it is empty");
  if (line.compare(0, kByteOrderMark.size(), kByteOrderMark) == 0) line.erase(0, kByteOrderMark.size());
  if (line.size() > kLongestLine) refuseLength(path, 1);
  const std::vector<std::string> names = split(line);
  std::vector<std::string> wanted = columns;
  wanted.insert(wanted.end(), optional_columns.begin(), optional_columns.end());
  std::vector<std::size_t> places;
  for (const std::string& column : wanted) {
    const auto found = std::find(names.begin(), names.end(), column);
    has_.push_back(found != names.end());
    if (!has_.back() && has_.size() <= columns.size()) {
      throw std::invalid_argument("'" + path + "', line 1: '" + line.substr(0, 80) + "' names no column '" + column +
                                  "'");
    }
    places.push_back(static_cast<std::size_t>(found - names.begin()));
  }
  for (int number = 2; std::getline(file, line); ++number) {
    if (line.find_first_not_of(kBlank) == std::string::npos) continue;
    if (line.size() > kLongestLine) refuseLength(path, number);
    const std::string where = "'" + path + "', line " + std::to_string(number);
    const std::vector<std::string> fields = split(line);
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      const std::string field = places[i] < fields.size() ? fields[places[i]] : "";
      numbers_.push_back(has_[i] ? toNumber(field, where, wanted[i]) : std::numeric_limits<double>::quiet_NaN());
    }
  }
}

}  // namespace lstm_planner
