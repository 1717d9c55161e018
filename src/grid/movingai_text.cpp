#include "grid/movingai_text.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "lstm_planner/grid/movingai.hpp"

namespace lstm_planner {
namespace {

// Inlined, unlike find_first_of(), which calls memchr for every letter.
bool isBlank(char letter) { return letter == ' ' || letter == '\t'; }

std::string readWhole(const std::string& kind, const std::string& path, std::uintmax_t largest) {
  namespace fs = std::filesystem;
  const auto refuse = [&](const std::string& why) -> void {
    throw MovingAiFileError("the " + kind + " " + path + why);
  };
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found) refuse(" does not exist");
  if (!error && !fs::is_regular_file(status)) refuse(" is no regular file");
  const std::uintmax_t size = error ? 0 : fs::file_size(path, error);
  if (error) refuse(" cannot be read: " + error.message());
  if (size == 0) refuse(" is empty");
  if (size > largest) {
    refuse(" has " + std::to_string(size) + " bytes, expected at most " + std::to_string(largest));
  }
  std::ifstream stream(path, std::ios::binary);
  if (!stream) refuse(std::string(" cannot be read: ") + std::strerror(errno));
  std::string content(static_cast<std::size_t>(size), '\0');
  stream.read(&content[0], static_cast<std::streamsize>(size));
  if (static_cast<std::uintmax_t>(stream.gcount()) != size) refuse(" ended while it was read");
  return content;
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
