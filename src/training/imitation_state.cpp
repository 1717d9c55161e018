#include <climits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "lstm_planner/training/imitation_rounds.hpp"
#include "training/checkpoint_json.hpp"

namespace lstm_planner {
namespace {

using Json = nlohmann::json;

/// It was the grid world's first.
constexpr const char* kFormat = "lstm_planner grid imitation 1";

Json toJson(const LossSum& sum) {
  const std::int64_t* counts = sum.confusion.data();
  return {{"loss", sum.loss},
          {"weight", sum.weight},
          {"classes", sum.confusion.rows()},
          {"confusion", std::vector<std::int64_t>(counts, counts + sum.confusion.size())}};
}

LossSum lossFrom(const Json& json) {
  LossSum sum;
  sum.loss = json.at("loss").get<double>();
  sum.weight = json.at("weight").get<double>();
  constexpr std::int64_t kMostClasses = 1000;
  const Eigen::Index classes = wholeNumber(json.at("classes"), 0, kMostClasses);
  std::vector<std::int64_t> counts;
  for (const Json& count : json.at("confusion")) counts.push_back(wholeNumber(count, 0, INT64_MAX));
  if (static_cast<Eigen::Index>(counts.size()) != classes * classes)
    throw std::invalid_argument("bad confusion matrix");
  sum.confusion = Eigen::Map<const ConfusionMatrix>(counts.data(), classes, classes);
  return sum;
}

Json toJson(const EpochReport& report) {
  return {{"epoch", report.epoch},
          {"learning_rate", report.learning_rate},
          {"training", toJson(report.training)},
          {"validation", toJson(report.validation)},
          {"best", report.best},
          {"averaged", toJson(report.averaged)},
          {"mean_batch_accuracy", report.mean_batch_accuracy}};
}

EpochReport reportFrom(const Json& json) {
  EpochReport report;
  report.epoch = static_cast<int>(wholeNumber(json.at("epoch"), 0, INT_MAX));
  report.learning_rate = json.at("learning_rate").get<double>();
  report.training = lossFrom(json.at("training"));
  report.validation = lossFrom(json.at("validation"));
  report.best = json.at("best").get<bool>();
  report.averaged = lossFrom(json.at("averaged"));
  report.mean_batch_accuracy = json.at("mean_batch_accuracy").get<double>();
  return report;
}

Json toJson(const std::vector<EpochReport>& curve) {
  Json json = Json::array();
  for (const EpochReport& report : curve) json.push_back(toJson(report));
  return json;
}

/// Of the epochs from 1 on, of which the first is better than none before: a training's result is looked up by them.
std::vector<EpochReport> curveFrom(const Json& json) {
  std::vector<EpochReport> curve;
  for (const Json& report : json) {
    curve.push_back(reportFrom(report));
    if (curve.back().epoch != static_cast<int>(curve.size()) || !curve.front().best) {
      throw std::invalid_argument("a curve whose epochs do not count from 1, or whose first is not the best so far");
    }
  }
  return curve;
}

}  // namespace

std::vector<std::uint8_t> toBytes(const ImitationState& state) {
  Json json = {{"format", kFormat},
               {"learners", Json::array()},
               {"curve", toJson(state.curve)},
               {"weights", vectorToJson(state.training.weights)},
               {"averaged_weights", vectorToJson(state.training.averaged_weights)},
               {"best_weights", vectorToJson(state.training.best_weights)},
               {"round_curve", toJson(state.training.curve)}};
  json.update(optimiserToJson(state.training.optimiser));
  for (const Eigen::VectorXf& learner : state.learners) json["learners"].push_back(vectorToJson(learner));
  return Json::to_cbor(json);
}

ImitationState imitationStateFrom(const std::vector<std::uint8_t>& bytes) try {
  const Json json = checkpointJson(bytes, kFormat);
  ImitationState state;
  for (const Json& learner : json.at("learners")) state.learners.push_back(vectorFromJson(learner));
  state.training.weights = vectorFromJson(json.at("weights"));
  state.training.best_weights = vectorFromJson(json.at("best_weights"));
  state.training.averaged_weights = vectorFromJson(json.at("averaged_weights"));
  state.training.optimiser = optimiserFromJson(json);
  state.curve = curveFrom(json.at("curve"));
  state.training.curve = curveFrom(json.at("round_curve"));
  return state;
} catch (const std::exception& error) {
  throw std::invalid_argument(std::string("this is not the state of an imitation: ") + error.what());
}

}  // namespace lstm_planner
