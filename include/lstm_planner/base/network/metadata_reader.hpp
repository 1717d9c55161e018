#pragma once

#include <map>
#include <string>
#include <vector>

namespace lstm_planner {

/// Reads the metadata of a model file and notes what is wrong with it, so that all of it is said at once.
class MetadataReader {
 public:
  /// `metadata` must outlive the reader.
  explicit MetadataReader(const std::map<std::string, std::string>& metadata) : metadata_(metadata) {}

  bool has(const std::string& key) const { return metadata_.count(key) > 0; }

  /// What a key holds; empty where it is missing, which is noted.
  std::string text(const std::string& key);

  /// A number from `least` to `most`; `least` where there is none, which is noted. A decimal point is a point in every
  /// locale.
  double number(const std::string& key, double least, double most);

  /// Likewise a whole number.
  int whole(const std::string& key, int least, int most);

  /// Numbers separated by commas; none where something else is there, which is noted.
  std::vector<double> numbers(const std::string& key);

  /// Notes a sentence, without a full stop.
  void note(const std::string& complaint) { complaints_.push_back(complaint); }
  bool isSound() const { return missing_.empty() && complaints_.empty(); }

  /// Throws std::invalid_argument with all that was noted, if there is anything.
  void finish() const;

 private:
  const std::map<std::string, std::string>& metadata_;
  std::vector<std::string> missing_;
  std::vector<std::string> complaints_;
};

/// A number as metadata hold it: read back it is the same, bit for bit.
std::string metadataText(double number);

}  // namespace lstm_planner
