#pragma once

#include <boost/program_options.hpp>
#include <string>
#include <vector>

namespace lstm_planner {

/// Parses the arguments of a command. What stands alone belongs to the option `files`; nothing may where there is none.
/// Prints the help and returns false when it was asked for. Throws boost::program_options::error with a sentence for
/// unknown, missing or malformed options.
bool parseOptions(const std::string& command, const boost::program_options::options_description& options,
                  const std::vector<std::string>& arguments, boost::program_options::variables_map* values,
                  const std::string& files = {});

}  // namespace lstm_planner
