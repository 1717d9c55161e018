#include <nlohmann/json.hpp>
#include <stdexcept>

#include "fuzz/harness.hpp"
#include "lstm_planner/dataset/recorder_parameters.hpp"

namespace lstm_planner::fuzz::recorder_json_harness {
namespace {

/// The parameters that a dataset stores with each recording.
void readParameters(const std::uint8_t* data, std::size_t size) {
  using Json = nlohmann::json;
  const auto read = [data, size] {
    const RecorderParameters parameters = recorderParametersFromJson(Json::parse(data, data + size));
    validate(parameters);
    require(toJson(recorderParametersFromJson(toJson(parameters))) == toJson(parameters), "nothing is lost in a file");
  };
  expectRefusal<std::invalid_argument>([&] { expectRefusal<Json::exception>(read); });
}

const Registration registration("recorder_json", &readParameters);

}  // namespace
}  // namespace lstm_planner::fuzz::recorder_json_harness
