#pragma once

#include <map>
#include <string>
#include <vector>

namespace lstm_planner {

/// Reads the metadata of a model file and collects all errors, so that they are reported together.
class MetadataReader {
 public:
  /// `metadata` must outlive the reader.
  explicit MetadataReader(const std::map<std::string, std::string>& metadata) : metadata_(metadata) {}

  bool has(const std::string& key) const { return metadata_.count(key) > 0; }

  /// The text of a key. If the key is missing, an error is noted and the text is empty.
  std::string text(const std::string& key);

  /// A number from `least` to `most`, with a decimal point in every locale. Otherwise an error is noted and the result
  /// is `least`.
  double number(const std::string& key, double least, double most);

  /// As number(), for an integer.
  int whole(const std::string& key, int least, int most);

  /// Numbers separated by commas. Otherwise an error is noted and the result is empty.
  std::vector<double> numbers(const std::string& key);

  /// Notes an error, a sentence without a full stop.
  void note(const std::string& complaint) { complaints_.push_back(complaint); }

  /// Throws std::invalid_argument with all noted errors, if there are any.
  void finish() const;

 private:
  const std::map<std::string, std::string>& metadata_;
  std::vector<std::string> missing_;
  std::vector<std::string> complaints_;
};

/// A number as text for metadata. Reading it gives the same number, bit for bit.
std::string metadataText(double number);

}  // namespace lstm_planner
