#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace lstm_planner {

/// A row of test/bags/NAME.decisions.csv.
struct GoldenDecision {
  double stamp = 0.0;  ///< s, of the scan that was decided about
  std::string source;
  int action = -1;
  double steering_angle = 0.0;  ///< rad
  std::vector<double> preferences;
};

/// Numbers separated by blanks or commas.
inline std::vector<double> numbersOf(std::string text) {
  for (char& character : text) {
    if (character == ',') character = ' ';
  }
  std::istringstream stream(text);
  std::vector<double> numbers;
  for (double number = 0.0; stream >> number;) numbers.push_back(number);
  return numbers;
}

/// Throws std::runtime_error when the file is missing or empty.
inline std::vector<GoldenDecision> goldenDecisions(const std::string& bag) {
  const std::string path = std::string(LSTM_PLANNER_SOURCE_DIR) + "/test/bags/" + bag + ".decisions.csv";
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  std::vector<GoldenDecision> decisions;
  while (std::getline(file, line)) {
    std::istringstream row(line);
    std::vector<std::string> fields;
    for (std::string field; std::getline(row, field, ',');) fields.push_back(field);
    decisions.push_back({std::stod(fields.at(1)), fields.at(2), std::stoi(fields.at(3)), std::stod(fields.at(4)),
                         numbersOf(fields.at(7))});
  }
  if (decisions.empty()) throw std::runtime_error("no decisions in " + path);
  return decisions;
}

/// Compares a decision as it was published (by key, "source" among them) with the golden one.
///
/// What was decided is the same everywhere: the network's best preference leads by 0.37 or more at each step of these
/// recordings. The preferences themselves come from some thousand float operations a step, which a compiler may order
/// and fuse (FMA) as it likes, and feed back through the hidden state. Built with -O0 and with -O3 -march=native
/// -ffast-math they agree in all four digits that the file has, so half a digit more than the file's rounding is
/// allowed for.
inline void expectSameDecision(const std::map<std::string, std::string>& published, const GoldenDecision& golden) {
  constexpr double kTolerance = 1e-4;
  SCOPED_TRACE("at " + std::to_string(golden.stamp) + " s");
  EXPECT_EQ(published.at("source"), golden.source);
  EXPECT_EQ(std::stoi(published.at("action")), golden.action);
  const double turn = std::stod(published.at("steering_angle")) - golden.steering_angle;
  EXPECT_NEAR(std::remainder(turn, 2.0 * M_PI), 0.0, kTolerance);
  const std::vector<double> preferences = numbersOf(published.at("preferences"));
  ASSERT_EQ(preferences.size(), golden.preferences.size());
  for (std::size_t i = 0; i < preferences.size(); ++i) {
    EXPECT_NEAR(preferences[i], golden.preferences[i], kTolerance);
  }
}

}  // namespace lstm_planner
