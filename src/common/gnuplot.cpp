#include "lstm_planner/common/gnuplot.hpp"

#include <sys/wait.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include "lstm_planner/common/output_file.hpp"

namespace lstm_planner {
namespace {

std::string replaceAll(std::string text, char what, const std::string& by) {
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size())) {
    text.replace(at, 1, by);
  }
  return text;
}

std::string quotedForShell(const std::string& text) { return "'" + replaceAll(text, '\'', "'\\''") + "'"; }

/// Runs a command and returns its exit status; what it prints goes to `output`.
int runCommand(const std::string& command, std::string& output) {
  // The script is an argument and the pipe is read: writing into the pipe of a program that is missing would raise
  // SIGPIPE.
  std::FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error(std::string("cannot start a shell: ") + std::strerror(errno));
  std::array<char, 512> buffer{};
  while (std::fgets(buffer.data(), static_cast<int>(buffer.size()), pipe) != nullptr) output += buffer.data();
  const int status = ::pclose(pipe);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace

std::string quotedForGnuplot(const std::string& text) { return "'" + replaceAll(text, '\'', "''") + "'"; }

std::string csvPathBeside(const std::string& png_path) {
  std::filesystem::path path(png_path);
  if (path.extension() == ".csv") return png_path + ".csv";  // the picture's own name, which somebody chose
  return path.replace_extension(".csv").string();
}

void runGnuplot(const std::string& what, const std::string& png_path, const std::string& csv_path,
                const std::string& size, const std::string& script) {
  const std::string name = what + " '" + png_path + "'";
  try {
    OutputFile picture(png_path);
    const std::string terminal =
        "set terminal pngcairo size " + size + "; set output " + quotedForGnuplot(picture.partPath()) + "; ";
    std::string output;
    const int status = runCommand("gnuplot -e " + quotedForShell(terminal + script), output);
    constexpr int kCommandNotFound = 127;
    if (status == kCommandNotFound) {
      throw std::runtime_error(name + " needs gnuplot, which is not installed; the numbers are in '" + csv_path + "'");
    }
    if (status != 0) throw std::runtime_error("gnuplot cannot draw " + name + ": " + output);
    picture.commit();
  } catch (const OutputFileError& error) {
    throw std::runtime_error(name + " cannot be written: " + error.what());
  }
}

}  // namespace lstm_planner
