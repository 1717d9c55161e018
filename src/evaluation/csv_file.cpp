#include "evaluation/csv_file.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace lstm_planner {
namespace {

constexpr const char* kBlank = " \t\r";

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

double toNumber(const std::string& text, const std::string& where, const std::string& column) {
  std::istringstream stream(text);
  double value = 0.0;
  if (!(stream >> value) || !stream.eof() || !std::isfinite(value)) {
    throw std::invalid_argument(where + ": column " + column + " is '" + text + "', expected a number");
  }
  return value;
}

}  // namespace

CsvFile::CsvFile(const std::string& path, const std::vector<std::string>& columns) {
  std::ifstream file(path);
  std::string line;
  if (!file || !std::getline(file, line)) throw std::invalid_argument("'" + path + "' cannot be read");
  const std::vector<std::string> names = split(line);
  std::vector<std::size_t> places;
  for (const std::string& column : columns) {
    const auto found = std::find(names.begin(), names.end(), column);
    if (found == names.end()) {
      throw std::invalid_argument("'" + path + "', line 1: '" + line.substr(0, 80) + "' names no column '" + column +
                                  "'");
    }
    places.push_back(static_cast<std::size_t>(found - names.begin()));
  }
  for (int number = 2; std::getline(file, line); ++number) {
    if (line.find_first_not_of(kBlank) == std::string::npos) continue;
    const std::string where = "'" + path + "', line " + std::to_string(number);
    const std::vector<std::string> fields = split(line);
    std::vector<double> numbers;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      numbers.push_back(toNumber(places[i] < fields.size() ? fields[places[i]] : "", where, columns[i]));
    }
    numbers_.push_back(std::move(numbers));
  }
}

}  // namespace lstm_planner
