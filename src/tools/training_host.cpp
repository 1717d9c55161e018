#include "tools/training_host.hpp"

#include <iostream>

#include "lstm_planner/common/text_table.hpp"

namespace lstm_planner {

void ToolTrainingHost::started(bool resumed) {
  if (resumed) std::cout << "going on from " << options_.checkpoint << " after " << position() << std::endl;
  printHeader();
}

int ToolTrainingHost::end(const TrainingOutcome& outcome) const {
  if (outcome.best) {
    std::cout << "wrote " << options_.output << ": " << scoreText(*outcome.best) << std::endl;
  }
  if (!outcome.stopped) return 0;
  std::cout << "interrupted; "
            << (options_.checkpoint.empty() ? "without --checkpoint the training cannot be continued" : resumption())
            << std::endl;
  return interruption_.exitStatus();
}

std::string positionOf(const ImitationRounds& rounds) {
  return std::to_string(rounds.round() - 1) + " rounds and " + std::to_string(rounds.epochsOfRound()) + " epochs";
}

std::string namedScore(const std::string& name, double score) { return name + ' ' + fixedText(score, 3); }

}  // namespace lstm_planner
