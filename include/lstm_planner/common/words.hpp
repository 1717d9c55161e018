#pragma once

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

namespace lstm_planner {

/// The words of a text: separated by spaces, or a list as YAML writes it, "[a, b]".
inline std::vector<std::string> wordsOf(std::string text) {
  const auto separates = [](char c) { return c == '[' || c == ']' || c == ','; };
  std::replace_if(text.begin(), text.end(), separates, ' ');
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

}  // namespace lstm_planner
