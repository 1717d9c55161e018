#include "grid_world/world/movingai_text.hpp"

#include <algorithm>
#include <charconv>

#include "lstm_planner/common/input_file.hpp"
#include "lstm_planner/grid_world/world/movingai.hpp"

namespace lstm_planner {
namespace {

// Inlined, unlike find_first_of(), which calls memchr for every letter.
bool isBlank(char letter) { return letter == ' ' || letter == '\t'; }

std::string readWhole(const std::string& kind, const std::string& path, std::uintmax_t largest) {
  try {
    std::string content = readInputFile(path, largest);
    if (!content.empty()) return content;
  } catch (const InputFileError& error) {
    throw MovingAiFileError("the " + kind + " " + path + " cannot be read: " + error.what());
  }
  throw MovingAiFileError("the " + kind + " " + path + " is empty");
}

}  // namespace

TextLines::TextLines(const std::string& kind, const std::string& path, std::uintmax_t largest)
    : kind_(kind), path_(path), content_(readWhole(kind, path, largest)) {}

bool TextLines::next() {
  ++number_;
  line_ = {};
  if (next_ >= content_.size()) return false;
  const std::size_t end = std::min(content_.find('\n', next_), content_.size());
  line_ = std::string_view(content_).substr(next_, end - next_);
  if (!line_.empty() && line_.back() == '\r') line_.remove_suffix(1);
  next_ = end + 1;
  return true;
}

bool TextLines::onlyEmptyLinesFollow() const {
  return next_ >= content_.size() || content_.find_first_not_of("\r\n", next_) == std::string::npos;
}

void TextLines::refuse(const std::string& why) const {
  throw MovingAiFileError("the " + kind_ + " " + path_ + ", line " + std::to_string(number_) + ": " + why);
}

void TextLines::refuseLetter(std::size_t letter, const std::string& why) const {
  throw MovingAiFileError("the " + kind_ + " " + path_ + ", line " + std::to_string(number_) + ", column " +
                          std::to_string(letter) + ": " + why);
}

std::vector<std::string_view> wordsOf(std::string_view line) {
  constexpr std::size_t kUsual = 10;  // a scenario has 9 words
  std::vector<std::string_view> words;
  words.reserve(kUsual);
  const char* const end = line.data() + line.size();
  const char* first = std::find_if_not(line.data(), end, isBlank);
  while (first != end) {
    const char* const behind = std::find_if(first, end, isBlank);
    words.emplace_back(first, static_cast<std::size_t>(behind - first));
    first = std::find_if_not(behind, end, isBlank);
  }
  return words;
}

bool parseInteger(std::string_view word, int* value) {
  const char* const end = word.data() + word.size();
  const std::from_chars_result result = std::from_chars(word.data(), end, *value);
  return result.ec == std::errc() && result.ptr == end;
}

std::string printable(std::string_view word) {
  constexpr std::size_t kShown = 40;
  constexpr char kDigits[] = "0123456789abcdef";
  std::string text = "'";
  for (const char letter : word.substr(0, kShown)) {
    const auto code = static_cast<unsigned char>(letter);
    if (code >= 0x20 && code < 0x7f) {
      text += letter;
    } else {
      text += {'\\', 'x', kDigits[code / 16], kDigits[code % 16]};
    }
  }
  return text + (word.size() > kShown ? "...'" : "'");
}

}  // namespace lstm_planner
