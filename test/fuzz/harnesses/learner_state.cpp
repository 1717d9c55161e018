#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "fuzz/harness.hpp"
#include "lstm_planner/grid_world/agent/grid_encoder.hpp"
#include "lstm_planner/grid_world/learning/grid_q_learning.hpp"
#include "lstm_planner/training/actor_critic.hpp"
#include "lstm_planner/training/imitation_rounds.hpp"
#include "lstm_planner/training/initialisation.hpp"

namespace lstm_planner::fuzz::learner_state_harness {
namespace {

std::unique_ptr<GridQLearning> smallLearning() {
  GridQLearningParameters parameters;
  parameters.threads = 1;
  parameters.agents = 1;
  return makeGridQLearning(parameters, {}, makeLstmStack(kGridInputs, {1}, kGridMoveCount));
}

ActorCritic smallActorCritic() {
  const LayerStack layers = makeLstmStack(1, {1}, 1);
  return ActorCritic({}, 1, layers, layers, 1);
}

/// What a checkpoint holds of a learner: '0', '1' or '2' says which; then JSON, which is stored as CBOR, or CBOR
/// itself.
void readState(const std::uint8_t* data, std::size_t size) {
  static ActorCritic actor_critic = smallActorCritic();
  static const auto q_learning = smallLearning();
  if (size == 0) return;
  std::vector<std::uint8_t> state(data + 1, data + size);
  const nlohmann::json json = nlohmann::json::parse(state, nullptr, false);
  if (!json.is_discarded()) state = nlohmann::json::to_cbor(json);
  expectRefusal<std::invalid_argument>([&] {
    switch ((data[0] - '0') % 3) {
      case 0:
        imitationStateFrom(state);
        break;
      case 1:
        actor_critic.restore(state);
        break;
      default:
        q_learning->restore(state);
    }
  });
}

const Registration registration("learner_state", &readState);

}  // namespace
}  // namespace lstm_planner::fuzz::learner_state_harness
