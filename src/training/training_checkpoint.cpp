#include "training/training_checkpoint.hpp"

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <system_error>

#include "lstm_planner/common/input_file.hpp"
#include "lstm_planner/common/output_file.hpp"
#include "training/checkpoint_json.hpp"

namespace lstm_planner {
namespace {

using Json = nlohmann::json;

constexpr const char* kFirstLine = "lstm_planner training checkpoint 1";
constexpr std::uintmax_t kLargestCheckpoint = std::uintmax_t{1} << 30;
constexpr std::size_t kLongestHeader = std::size_t{1} << 20;

/// Like "cells = [8,8] instead of [16]"; empty when all settings are the same.
std::string firstDifference(const Json& made_with, const Json& wanted) {
  for (const auto& item : wanted.items()) {
    const auto found = made_with.find(item.key());
    if (found == made_with.end()) return "without " + item.key();
    if (*found != item.value())
      return "with " + item.key() + " = " + found->dump() + " instead of " + item.value().dump();
  }
  for (const auto& item : made_with.items()) {
    if (wanted.find(item.key()) == wanted.end()) return "with " + item.key() + " = " + item.value().dump();
  }
  return "";
}

/// Names of files need be no UTF-8, which JSON demands.
std::string textOf(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

std::string readCheckpointFile(const std::string& path) {
  try {
    return readInputFile(path, kLargestCheckpoint);
  } catch (const InputFileError& error) {
    throw std::invalid_argument("cannot read checkpoint '" + path + "': " + error.what());
  }
}

/// The first two lines, behind which `end` is set. Throws std::invalid_argument when they are not a checkpoint's.
Json readHeader(const std::string& path, const std::string& content, std::size_t* end) {
  const std::size_t first_end = std::min(content.find('\n'), content.size());
  const std::string first_line = content.substr(0, first_end);
  const std::size_t begin = std::min(first_end + 1, content.size());
  const std::size_t header_end = std::min(content.find('\n', begin), content.size());
  const std::string header_line = content.substr(begin, std::min(header_end - begin, kLongestHeader));
  *end = std::min(header_end + 1, content.size());
  std::string why;
  try {
    Json header = checkpointJson(header_line);
    if (first_line == kFirstLine && header.is_object() && header.count("settings") == 1 &&
        header["settings"].is_object() && header.count("progress") == 1 && header.count("learner_bytes") == 1) {
      return header;
    }
  } catch (const std::invalid_argument& error) {
    if (first_line == kFirstLine) why = std::string(" (") + error.what() + ")";
  }
  throw std::invalid_argument("'" + path + "' is not a checkpoint of a training" + why + ", expected one or no file");
}

}  // namespace

Json asInCheckpoint(const Json& json) { return Json::parse(textOf(json)); }

void writeTrainingCheckpoint(const std::string& path, const TrainingCheckpoint& checkpoint) {
  const Json header = {{"settings", checkpoint.settings},
                       {"progress", checkpoint.progress},
                       {"learner_bytes", checkpoint.learner.size()}};
  try {
    OutputFile file(path);
    file.stream() << kFirstLine << '\n' << textOf(header) << '\n';
    file.stream().write(reinterpret_cast<const char*>(checkpoint.learner.data()),
                        static_cast<std::streamsize>(checkpoint.learner.size()));
    file.commit();
  } catch (const OutputFileError& error) {
    throw std::runtime_error("cannot write checkpoint '" + path + "': " + error.what());
  }
}

std::optional<TrainingCheckpoint> readTrainingCheckpoint(const std::string& path, const Json& settings) {
  std::error_code unknown;
  if (!std::filesystem::exists(path, unknown) && !unknown) return std::nullopt;
  const std::string content = readCheckpointFile(path);
  std::size_t header_end = 0;
  const Json header = readHeader(path, content, &header_end);
  TrainingCheckpoint checkpoint;
  checkpoint.settings = header["settings"];
  checkpoint.progress = header["progress"];
  const std::string difference = firstDifference(checkpoint.settings, asInCheckpoint(settings));
  if (!difference.empty()) {
    throw std::invalid_argument("checkpoint '" + path + "' is of a training " + difference +
                                ": give the same options again, or another file");
  }
  checkpoint.learner.assign(content.begin() + static_cast<std::ptrdiff_t>(header_end), content.end());
  if (header["learner_bytes"] != checkpoint.learner.size()) {
    throw std::invalid_argument("checkpoint '" + path + "' has " + std::to_string(checkpoint.learner.size()) +
                                " bytes of the learner, expected " + header["learner_bytes"].dump());
  }
  return checkpoint;
}

}  // namespace lstm_planner
