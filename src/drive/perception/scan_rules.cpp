#include "lstm_planner/drive/perception/scan_rules.hpp"

#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "lstm_planner/common/parameter_visitors.hpp"
#include "lstm_planner/common/words.hpp"

namespace lstm_planner {
namespace {

constexpr double kGreatestCode = 1e4;  // m
constexpr double kLongestTurn = 1.0;   // s; a slower scanner is of no use to a robot that drives

/// NaN where the word is no number.
double numberIn(const std::string& word) {
  std::istringstream stream(word);
  double number = 0.0;
  return stream >> number && stream.eof() ? number : std::numeric_limits<double>::quiet_NaN();
}

double codeOf(const std::string& word) {
  const double code = numberIn(word);
  if (!(code > 0.0 && code <= kGreatestCode)) {
    throw std::invalid_argument("no_return has the word '" + word +
                                "', expected nan, zero, below, beyond or a reading from above 0 to 10000 m; +inf needs "
                                "no word");
  }
  return code;
}

}  // namespace

ScanRules urgNodeRules() {
  ScanRules rules;
  rules.nan_is_no_return = true;
  rules.zero_is_no_return = true;
  rules.beyond_is_no_return = true;
  rules.no_return_code = 65.53;
  return rules;
}

std::string noReturnText(const ScanRules& rules) {
  std::ostringstream text;
  const auto add = [&](const auto& word) { text << (text.tellp() > 0 ? " " : "") << word; };
  if (rules.nan_is_no_return) add("nan");
  if (rules.zero_is_no_return) add("zero");
  if (rules.below_is_no_return) add("below");
  if (rules.beyond_is_no_return) add("beyond");
  if (rules.no_return_code > 0.0) add(rules.no_return_code);
  return text.str();
}

void setNoReturn(const std::string& text, ScanRules* rules) {
  ScanRules read;
  for (const std::string& word : wordsOf(text)) {
    if (word == "nan") {
      read.nan_is_no_return = true;
    } else if (word == "zero") {
      read.zero_is_no_return = true;
    } else if (word == "below") {
      read.below_is_no_return = true;
    } else if (word == "beyond") {
      read.beyond_is_no_return = true;
    } else if (read.no_return_code == 0.0) {
      read.no_return_code = codeOf(word);
    } else {
      throw std::invalid_argument("no_return is '" + text + "', expected one number at most");
    }
  }
  read.beam_times = rules->beam_times;
  read.least_measured = rules->least_measured;
  *rules = read;
}

std::string beamTimesText(const ScanRules& rules) {
  if (!rules.beam_times) return "";
  std::ostringstream text;
  text << rules.beam_times->first << ' ' << rules.beam_times->last;
  return text.str();
}

void setBeamTimes(const std::string& text, ScanRules* rules) {
  rules->beam_times.reset();
  const std::vector<std::string> words = wordsOf(text);
  if (words.empty()) return;
  const BeamTimes times{numberIn(words.front()), numberIn(words.back())};
  if (words.size() != 2 || !(std::abs(times.first) <= kLongestTurn && std::abs(times.last) <= kLongestTurn)) {
    throw std::invalid_argument("beam_times is '" + text + "', expected two numbers from -1 to 1 s, such as 0.18 0");
  }
  rules->beam_times = times;
}

void validate(const ScanRules& rules) {
  checkParameter(rules.no_return_code >= 0.0 && rules.no_return_code <= kGreatestCode, "no_return",
                 rules.no_return_code, "a reading from 0 to 10000 m");
  visitScanRules(rules, RangeCheck());
}

}  // namespace lstm_planner
