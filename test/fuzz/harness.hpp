#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>

namespace lstm_planner::fuzz {

/// One input, of any size and content. Returns when the code under test took it or refused it as its header promises;
/// any exception that leaves it is a fault.
using Harness = void (*)(const std::uint8_t* data, std::size_t size);

/// The harnesses of this program by name: all of them in the unit tests, one in a fuzzer.
std::map<std::string, Harness>& harnesses();

/// `const Registration registration("csv", &readCsv);` in a harness's file.
struct Registration {
  Registration(const std::string& name, Harness harness) { harnesses()[name] = harness; }
};

/// Throws std::logic_error when what must hold for every input does not.
inline void require(bool holds, const std::string& what) {
  if (!holds) throw std::logic_error("this does not hold: " + what);
}

/// Runs `read`. A refusal by an exception `Refusal` must be a sentence; other exceptions get out.
template <typename Refusal, typename Work>
void expectRefusal(Work&& read) {
  try {
    read();
  } catch (const Refusal& refusal) {
    require(std::string(refusal.what()).find(' ') != std::string::npos, "a refusal is a sentence");
  }
}

}  // namespace lstm_planner::fuzz
