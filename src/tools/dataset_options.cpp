#include "tools/dataset_options.hpp"

#include <iostream>

namespace lstm_planner {

namespace po = boost::program_options;

bool parseDatasetOptions(const std::string& action, const po::options_description& options, const std::string& files,
                         const std::vector<std::string>& arguments, po::variables_map* values) {
  constexpr int kAnyNumber = -1;
  po::options_description all("lstm_planner dataset " + action);
  all.add(options).add_options()("help", "show this");
  po::positional_options_description positional;
  positional.add(files.c_str(), kAnyNumber);
  po::store(po::command_line_parser(arguments).options(all).positional(positional).run(), *values);
  if (values->count("help") > 0) {
    std::cout << all << "\n";
    return false;
  }
  po::notify(*values);
  return true;
}

}  // namespace lstm_planner
