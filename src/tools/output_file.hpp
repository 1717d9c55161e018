#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace lstm_planner {

/// Of --output, behind which the endings are put. Throws std::invalid_argument where it has one of them already, and as
/// checkWritable().
void checkWithoutExtension(const std::string& path, const std::vector<std::string>& endings);

/// Makes the folder unless it is there. Throws std::invalid_argument unless files can be written into it.
void makeOutputFolder(const std::string& path);

/// Throws std::runtime_error when the file cannot be written.
void writeTextFile(const std::string& path, const std::string& text);

/// For people and programs; in names of files, what is no UTF-8 is replaced. Throws as writeTextFile().
void writeJsonFile(const std::string& path, const nlohmann::json& json);

}  // namespace lstm_planner
