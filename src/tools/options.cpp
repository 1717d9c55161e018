#include "tools/options.hpp"

#include <iostream>

namespace lstm_planner {

namespace po = boost::program_options;

bool parseOptions(const std::string& command, const po::options_description& options,
                  const std::vector<std::string>& arguments, po::variables_map* values) {
  po::options_description all("lstm_planner " + command);
  all.add(options).add_options()("help", "show this");
  po::store(po::command_line_parser(arguments).options(all).positional({}).run(), *values);
  if (values->count("help") > 0) {
    std::cout << all << "\n";
    return false;
  }
  po::notify(*values);
  return true;
}

}  // namespace lstm_planner
