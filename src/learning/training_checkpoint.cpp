#include "lstm_planner/learning/training_checkpoint.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace lstm_planner {
namespace {

using Json = nlohmann::json;

constexpr const char* kFirstLine = "lstm_planner training checkpoint 1";

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

}  // namespace

void writeTrainingCheckpoint(const std::string& path, const TrainingCheckpoint& checkpoint) {
  const Json header = {{"settings", checkpoint.settings},
                       {"progress", checkpoint.progress},
                       {"learner_bytes", checkpoint.learner.size()}};
  const std::string temporary = path + ".tmp" + std::to_string(::getpid());
  std::ofstream file(temporary, std::ios::binary);
  file << kFirstLine << '\n' << header.dump() << '\n';
  file.write(reinterpret_cast<const char*>(checkpoint.learner.data()),
             static_cast<std::streamsize>(checkpoint.learner.size()));
  file.close();
  if (file && std::rename(temporary.c_str(), path.c_str()) == 0) return;
  const std::string reason = std::strerror(errno);
  std::remove(temporary.c_str());
  throw std::runtime_error("cannot write checkpoint '" + path + "': " + reason);
}

std::optional<TrainingCheckpoint> readTrainingCheckpoint(const std::string& path, const Json& settings) {
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    if (errno == ENOENT) return std::nullopt;
    throw std::invalid_argument("cannot read checkpoint '" + path + "': " + std::strerror(errno));
  }
  std::string first_line;
  std::string header_line;
  std::getline(file, first_line);
  std::getline(file, header_line);
  const Json header = Json::parse(header_line, nullptr, false);
  if (first_line != kFirstLine || !header.is_object() || header.count("settings") == 0 ||
      header.count("progress") == 0 || header.count("learner_bytes") == 0) {
    throw std::invalid_argument("'" + path + "' is not a checkpoint of a training, expected one or no file");
  }
  TrainingCheckpoint checkpoint;
  checkpoint.settings = header["settings"];
  checkpoint.progress = header["progress"];
  const std::string difference = firstDifference(checkpoint.settings, settings);
  if (!difference.empty()) {
    throw std::invalid_argument("checkpoint '" + path + "' is of a training " + difference +
                                ": give the same options again, or another file");
  }
  checkpoint.learner.assign(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  if (checkpoint.learner.size() != header["learner_bytes"].get<std::size_t>()) {
    throw std::invalid_argument("checkpoint '" + path + "' has " + std::to_string(checkpoint.learner.size()) +
                                " bytes of the learner, expected " + header["learner_bytes"].dump());
  }
  return checkpoint;
}

}  // namespace lstm_planner
