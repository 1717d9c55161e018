#pragma once

#include <optional>
#include <string>
#include <type_traits>

namespace lstm_planner {

/// When the beams of a scan are measured: the first and the last of its list, s after the stamp; those between at a
/// constant rate. Negative: before the stamp. A scanner that turns clockwise, and whose driver lists its beams
/// counterclockwise, measures the last one first.
struct BeamTimes {
  double first = 0.0;
  double last = 0.0;
};

/// What the readings of a scanner mean, when they are measured, and how much of a scan must have been measured.
///
/// REP-117 is the default: +inf means that nothing is within range, which is a measurement; NaN is no measurement; -inf
/// means that something is too near to be measured. Readings outside [range_min, range_max] are no measurements. The
/// other members say which readings a driver sends in place of +inf. What was not measured is not free.
struct ScanRules {
  bool nan_is_no_return = false;
  bool zero_is_no_return = false;
  bool below_is_no_return =
      false;  ///< readings above 0 and below range_min, as of a URG-04LX; a covered one sends them, too
  bool beyond_is_no_return = false;  ///< finite readings above range_max; filters send them for what they took out, too
  double no_return_code = 0.0;       ///< m; readings within 0.02 m of it, such as 65.53 m, the end of a 16 bit counter;
                                     ///< 0 = there is no such code
  std::optional<BeamTimes> beam_times;  ///< none: nobody knows; they count as measured at the stamp
  double least_measured = 0.5;
};

/// What Hokuyo scanners send behind urg_node, old ones included: NaN, 0, 65.53 m or readings beyond range_max.
ScanRules urgNodeRules();

/// The readings in place of +inf as text: the words "nan", "zero", "below" and "beyond" and one number (m), separated
/// by spaces; empty for REP-117 alone.
std::string noReturnText(const ScanRules& rules);
/// Reads that text, or a list of the words ("[nan, 65.53]"), into `rules`. Throws std::invalid_argument with the word
/// and what was expected.
void setNoReturn(const std::string& text, ScanRules* rules);

/// "0.18 0", first and last; empty where there are none.
std::string beamTimesText(const ScanRules& rules);
/// Reads that text, or a list of the two numbers. Throws std::invalid_argument with the text and what was expected.
void setBeamTimes(const std::string& text, ScanRules* rules);

/// Visits every parameter; see parameter_visitors.hpp.
template <typename Rules, typename Visitor>
void visitScanRules(Rules& rules, const Visitor& visit) {
  std::string no_return = noReturnText(rules);
  visit("no_return", no_return, {}, "",
        "readings that the driver sends in place of +inf: nan, zero, below (range_min), beyond (range_max) and one "
        "number (m); what is listed counts as free for the network, but only a number, as +inf, clears what is "
        "remembered");
  if constexpr (!std::is_const_v<Rules>) setNoReturn(no_return, &rules);
  std::string beam_times = beamTimesText(rules);
  visit("beam_times", beam_times, {}, "s",
        "when the first and the last beam of a scan are measured, after its stamp; empty: the plugins find it out by "
        "comparing scans, until then and elsewhere all beams count as measured at the stamp");
  if constexpr (!std::is_const_v<Rules>) setBeamTimes(beam_times, &rules);
  visit("least_measured", rules.least_measured, {0.01, 1.0}, "",
        "share of the beams in each sector that must be measured: other scans are not used; less only if a part of the "
        "robot hides the view");
}

/// Throws std::invalid_argument naming the parameter, its value and what was expected.
void validate(const ScanRules& rules);

}  // namespace lstm_planner
