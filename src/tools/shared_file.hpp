#pragma once

#include <string>

namespace lstm_planner {

/// Path of a file that comes with the package, such as `models/grid_lstm.onnx`, from whatever folder the tool is run:
/// in the current folder, in the share folder of the install space, in the sources of the tool's own devel space, or in
/// a package on ROS_PACKAGE_PATH, whichever comes first. The name itself where there is none, so that the reader's
/// message names it.
std::string findSharedFile(const std::string& name);

}  // namespace lstm_planner
