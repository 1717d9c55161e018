#pragma once

#include <string>
#include <vector>

#include "lstm_planner/drive/perception/observation.hpp"

namespace lstm_planner {

struct EncoderParameters;
struct ViewBearings;

/// How an input changes from view to view (Encoder::turn()).
enum class InputTurns {
  kNot,          ///< the same in every view
  kWithScanner,  ///< of eight sectors, right to left: a view sees those of the scanner that lie in it, and 0 elsewhere
  kAround,       ///< of eight directions, from ahead to the left
  kBearing       ///< a value for each view: NetworkInput::from
};

/// How an input changes when right and left are exchanged. A test compares it with mirrored(Observation).
enum class InputMirrors {
  kNot,      ///< the same
  kSign,     ///< its sign
  kSectors,  ///< of eight sectors, the first with the last
  kAround    ///< of eight directions, the first to the left with the first to the right; ahead and behind stay
};

/// What a network may be told: one row for each input, or eight that show the same of several directions.
struct NetworkInput {
  const char* name;   ///< in input_layout; of eight: with _0 to _7
  int count;          ///< 1 or 8
  const char* group;  ///< of `lstm_planner train --inputs`; "thesis" is the default, "views" is added to eight views
  /// The value, seen ahead. `index`: of the sector or direction.
  double (*value)(const Observation& observation, const EncoderParameters& parameters, int index);
  InputTurns turns;
  /// The value in the view that is turned to the left by so many eighths of a turn, for kBearing.
  double (*from)(const ViewBearings& bearings, const EncoderParameters& parameters, int view);
  InputMirrors mirrors;
  const char* meaning;  ///< for the table of models/onnx.md
};

/// All of them. An input that is added needs its row here, that of models/onnx.md, and a test.
const std::vector<NetworkInput>& networkInputs();

/// An input of a layout.
struct InputName {
  const NetworkInput* input;
  int index;  ///< of the sector or direction; 0 for a single one
};

/// Throws std::invalid_argument with what was expected when there is no such input.
InputName inputNamed(const std::string& name);

/// The names of the inputs of a group, in the order of the rows.
std::vector<std::string> inputsOfGroup(const std::string& group);

}  // namespace lstm_planner
