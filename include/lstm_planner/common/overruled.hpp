#pragma once

#include <cstddef>

namespace lstm_planner {

/// What prevented a leader's first preference, on the robot and in the grid world.
enum class Overruled {
  kNo,        ///< nothing, or the leader has no preference
  kByShield,  ///< something is in the way: another of the choices was taken, or none was free
  kByBound    ///< the detour would be too long (DetourBound): the path through what is remembered was taken
};

constexpr std::size_t kOverruledKinds = 3;

/// "no", "by the shield", "by the bound".
inline const char* toString(Overruled overruled) {
  switch (overruled) {
    case Overruled::kNo:
      return "no";
    case Overruled::kByShield:
      return "by the shield";
    case Overruled::kByBound:
      return "by the bound";
  }
  return "unknown";
}

}  // namespace lstm_planner
