#include "tools/options.hpp"

#include <iostream>

namespace lstm_planner {

namespace po = boost::program_options;

bool parseOptions(const std::string& command, const po::options_description& options,
                  const std::vector<std::string>& arguments, po::variables_map* values, const std::string& files) {
  constexpr int kAnyNumber = -1;
  po::options_description all("lstm_planner " + command);
  all.add(options).add_options()("help", "show this");
  po::positional_options_description positional;
  if (!files.empty()) positional.add(files.c_str(), kAnyNumber);
  po::store(po::command_line_parser(arguments).options(all).positional(positional).run(), *values);
  if (values->count("help") > 0) {
    std::cout << all << "\n";
    return false;
  }
  po::notify(*values);
  return true;
}

}  // namespace lstm_planner
