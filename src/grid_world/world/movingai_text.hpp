#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace lstm_planner {

/// The lines of a text file, without their ends, read one after the other. Knows where it is, so that whoever reads can
/// refuse what it finds there.
class TextLines {
 public:
  /// Reads the whole file. `kind` names it in messages ("map"). Throws MovingAiFileError when it is no file, cannot be
  /// read, is empty or larger than `largest` bytes.
  TextLines(const std::string& kind, const std::string& path, std::uintmax_t largest);
  TextLines(const TextLines&) = delete;  // lines point into the content
  TextLines& operator=(const TextLines&) = delete;

  /// Goes to the next line; false at the end of the file.
  bool next();
  std::string_view line() const { return line_; }
  /// Whether nothing but empty lines follows the current one.
  bool onlyEmptyLinesFollow() const;

  /// Throws MovingAiFileError "the KIND PATH, line N: WHY", of the current line, or of the one that is missing behind
  /// the last one.
  [[noreturn]] void refuse(const std::string& why) const;
  /// The same with the place of a letter, counted from 1 as editors do.
  [[noreturn]] void refuseLetter(std::size_t letter, const std::string& why) const;

 private:
  std::string kind_;
  std::string path_;
  std::string content_;
  std::string_view line_;
  std::size_t number_ = 0;
  std::size_t next_ = 0;
};

/// The parts of a line between blanks and tabs.
std::vector<std::string_view> wordsOf(std::string_view line);

/// A whole number of decimal digits with an optional minus; false when the word is anything else or does not fit.
bool parseInteger(std::string_view word, int* value);

/// The word between quotation marks, cut when long, with letters that do not print as \xNN.
std::string printable(std::string_view word);

}  // namespace lstm_planner
