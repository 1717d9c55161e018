#include "lstm_planner/network/metadata_reader.hpp"

#include <cmath>
#include <iomanip>
#include <locale>
#include <optional>
#include <sstream>
#include <stdexcept>

namespace lstm_planner {
namespace {

/// All of the text is a number.
std::optional<double> numberIn(const std::string& text) {
  std::istringstream stream(text);
  stream.imbue(std::locale::classic());
  double value = 0.0;
  if (!(stream >> value) || !(stream >> std::ws).eof()) return std::nullopt;
  return value;
}

}  // namespace

std::string MetadataReader::text(const std::string& key) {
  const auto entry = metadata_.find(key);
  if (entry != metadata_.end()) return entry->second;
  missing_.push_back(key);
  return "";
}

double MetadataReader::number(const std::string& key, double least, double most) {
  if (!has(key)) {
    missing_.push_back(key);
    return least;
  }
  const std::optional<double> value = numberIn(text(key));
  if (value && *value >= least && *value <= most) return *value;
  std::ostringstream complaint;
  complaint.imbue(std::locale::classic());
  complaint << key << " is '" << text(key) << "', expected a number in [" << least << ", " << most << "]";
  note(complaint.str());
  return least;
}

int MetadataReader::whole(const std::string& key, int least, int most) {
  const double value = number(key, least, most);
  if (value != std::floor(value)) note(key + " is '" + text(key) + "', expected a whole number");
  return static_cast<int>(value);
}

std::vector<double> MetadataReader::numbers(const std::string& key) {
  if (!has(key)) {
    missing_.push_back(key);
    return {};
  }
  std::vector<double> values;
  std::istringstream list(text(key));
  for (std::string item; std::getline(list, item, ',');) {
    const std::optional<double> value = numberIn(item);
    if (!value) {
      note(key + " is '" + text(key) + "', expected numbers separated by commas");
      return {};
    }
    values.push_back(*value);
  }
  if (values.empty()) note(key + " is empty, expected numbers separated by commas");
  return values;
}

void MetadataReader::finish() const {
  if (missing_.empty() && complaints_.empty()) return;
  std::string sentence;
  for (const std::string& key : missing_) sentence += (sentence.empty() ? "the metadata lack " : ", ") + key;
  for (const std::string& complaint : complaints_)
    sentence += (sentence.empty() ? "in the metadata " : "; ") + complaint;
  throw std::invalid_argument(sentence);
}

std::string metadataText(double number) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << std::setprecision(17) << number;
  return text.str();
}

}  // namespace lstm_planner
