#pragma once

#include <boost/program_options.hpp>
#include <string>
#include <vector>

namespace lstm_planner {

/// Parses the arguments of an action whose files are named without an option: `files` is among `options`, and takes
/// what stands alone. Prints the help and returns false when it was asked for. Throws boost::program_options::error.
bool parseDatasetOptions(const std::string& action, const boost::program_options::options_description& options,
                         const std::string& files, const std::vector<std::string>& arguments,
                         boost::program_options::variables_map* values);

}  // namespace lstm_planner
