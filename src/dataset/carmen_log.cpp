#include "lstm_planner/dataset/carmen_log.hpp"

#include <Poco/InflatingStream.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <utility>

#include "dataset/carmen_log_line.hpp"
#include "lstm_planner/common/input_file.hpp"
#include "lstm_planner/dataset/drive_recorder.hpp"

namespace lstm_planner {

namespace {

constexpr std::uintmax_t kMostBytes = std::uintmax_t{1} << 28;
constexpr std::size_t kMostLines = 1'000'000;
constexpr const char* kOdometryFrame = "odom";
constexpr const char* kScanFrame = "laser";

bool isSamePose(const Pose2& a, const Pose2& b) { return a.x == b.x && a.y == b.y && a.yaw == b.yaw; }

/// Reads the lines of a log, and counts what is not used.
class LogReader {
 public:
  LogReader(const std::string& path, CarmenLog* log) : path_(path), log_(log) {}

  std::vector<CarmenLine> read() {
    try {
      checkInputFile(path_, kMostBytes);
    } catch (const InputFileError& error) {
      throw std::invalid_argument("the log " + path_ + " cannot be read: " + error.what());
    }
    std::ifstream file(path_, std::ios::binary);
    if (!file) throw std::invalid_argument("the log " + path_ + " cannot be read: " + std::strerror(errno));
    const bool is_compressed = file.get() == 0x1f && file.get() == 0x8b;
    file.clear();
    file.seekg(0);
    if (is_compressed) {
      Poco::InflatingInputStream inflated(file, Poco::InflatingStreamBuf::STREAM_GZIP);
      do {
        read(&inflated);
        inflated.reset();  // compressed files that were put one behind the other are one file, as for gzip
      } while (inflated.peek() != std::istream::traits_type::eof());
    } else {
      read(&file);
    }
    if (log_->scans == 0) {
      throw std::invalid_argument("the log " + path_ + " holds no scans: expected lines FLASER or ROBOTLASER1 " +
                                  insteadOfScans());
    }
    return std::move(lines_);
  }

  double frontLaserOffset() const { return front_laser_offset_; }

 private:
  void read(std::istream* stream) {
    constexpr std::streamsize kLongestLine = 1 << 20;
    const std::unique_ptr<char[]> buffer(new char[kLongestLine]);  // zeros would take longer than a short log
    for (;;) {
      stream->getline(buffer.get(), kLongestLine);
      if (stream->bad() || (stream->fail() && stream->gcount() + 1 >= kLongestLine)) {
        throw std::invalid_argument("the log " + path_ + " cannot be read on behind line " + std::to_string(number_) +
                                    ": it is damaged, or no log");
      }
      if (stream->gcount() == 0 && stream->fail()) return;
      ++number_;
      bytes_ += static_cast<std::uintmax_t>(stream->gcount());
      if (bytes_ > kMostBytes || lines_.size() >= kMostLines) {
        throw std::invalid_argument("the log " + path_ + " is too long: expected at most " +
                                    std::to_string(kMostBytes) + " bytes, decompressed, and " +
                                    std::to_string(kMostLines) + " scans and lines ODOM");
      }
      take(buffer.get());
    }
  }

  std::string insteadOfScans() const {
    // Such a file's lines ODOM are malformed for CARMEN, but that is not what is wrong with it.
    const auto of_gmapping = log_->ignored.find("LASER_READING");
    if (of_gmapping != log_->ignored.end()) {
      return "as CARMEN writes them, but it has " + std::to_string(of_gmapping->second) +
             " lines LASER_READING: it is a file of GMapping, whose program gfs2log converts it to a CARMEN log";
    }
    if (log_->malformed > 0) return "as CARMEN writes them, but " + log_->first_malformed;
    return "among its " + std::to_string(number_) + (number_ == 1 ? " line" : " lines");
  }

  void take(const std::string& text) {
    const std::size_t begin = text.find_first_not_of(" \t\r");
    if (begin == std::string::npos) return;
    const std::size_t end = std::min(text.find_first_of(" \t\r", begin), text.size());
    const std::string kind = text[begin] == '#' ? "#" : text.substr(begin, end - begin);
    try {
      take(kind, text.substr(end));
    } catch (const std::invalid_argument& error) {
      if (++log_->malformed == 1) {
        log_->first_malformed = "line " + std::to_string(number_) + ": " + kind + " " + error.what();
      }
    }
  }

  void take(const std::string& kind, const std::string& text) {
    if (kind == "ODOM") {
      keep(parseCarmenOdometry(text));
    } else if (isWantedScan(kind)) {
      keep(kind == "FLASER" ? parseCarmenFrontLaser(text) : parseCarmenRobotLaser(text));
      log_->scan_kind = kind;
    } else if (kind == "PARAM") {
      takeParameter(text);
    } else {
      // What is no keyword is not worth a count of its own; nor is what comes after all that CARMEN has.
      constexpr std::size_t kLongestKeyword = 32;
      constexpr std::size_t kMostKeywords = 100;
      const bool is_keyword = kind.size() <= kLongestKeyword &&
                              std::all_of(kind.begin(), kind.end(), [](char c) { return c > ' ' && c <= '~'; });
      const bool is_new = log_->ignored.count(kind) == 0;
      ++log_->ignored[is_keyword && !(is_new && log_->ignored.size() >= kMostKeywords) ? kind : "?"];
    }
  }

  bool isWantedScan(const std::string& kind) const {
    return log_->scan_kind.empty() ? kind == "FLASER" || kind == "ROBOTLASER1" : kind == log_->scan_kind;
  }

  void takeParameter(const std::string& text) {
    constexpr const char* kOffset = " robot_frontlaser_offset ";
    if (text.rfind(kOffset, 0) != 0) return;
    const char* const begin = text.c_str() + std::string(kOffset).size();
    char* end = nullptr;
    const double offset = std::strtod(begin, &end);
    if (end == begin || !std::isfinite(offset)) throw std::invalid_argument("robot_frontlaser_offset is no number");
    front_laser_offset_ = offset;
    log_->mount_known = true;
  }

  void keep(CarmenLine line) {
    if (!lines_.empty() && lines_.back().has_scan && !line.has_scan && isSamePose(lines_.back().robot, line.robot)) {
      ++log_->repeated;
      return;
    }
    ++(line.has_scan ? log_->scans : log_->odometry);
    lines_.push_back(std::move(line));
  }

  std::string path_;
  CarmenLog* log_;
  std::vector<CarmenLine> lines_;
  double front_laser_offset_ = 0.0;  ///< m
  long number_ = 0;                  ///< of the line
  std::uintmax_t bytes_ = 0;         ///< decompressed
};

long countStandingScans(const std::vector<CarmenLine>& lines) {
  long standing = 0;
  const CarmenLine* before = nullptr;
  for (const CarmenLine& line : lines) {
    if (!line.has_scan) continue;
    if (before != nullptr && line.stamp <= before->stamp) ++standing;
    before = &line;
  }
  return standing;
}

constexpr double kClockSet = 5.0;     // s
constexpr double kLinesApart = 2e-4;  // s

/// Gives lines that were stamped late the stamps in between their neighbours'. Returns how many.
long mendLateStamps(std::vector<CarmenLine>* lines) {
  long late = 0;
  std::size_t next = lines->size() - 1;  // the next line whose stamp is right
  for (std::size_t i = next; i-- > 0;) {
    const double limit = (*lines)[next].stamp;
    if ((*lines)[i].stamp > limit && (*lines)[i].stamp <= limit + kClockSet) {
      ++late;
      if (i > 0) continue;
      (*lines)[i].stamp = limit;
    }
    const double begin = std::min((*lines)[i].stamp, limit);
    for (std::size_t k = i + 1; k < next; ++k) {
      (*lines)[k].stamp = begin + (limit - begin) * static_cast<double>(k - i) / static_cast<double>(next - i);
    }
    next = i;
  }
  return late;
}

/// Sets lines of the same stamp apart, so that their order remains.
void spreadStamps(std::vector<CarmenLine>* lines) {
  for (std::size_t i = 1; i < lines->size(); ++i) {
    const double before = (*lines)[i - 1].stamp;
    double& stamp = (*lines)[i].stamp;
    if (stamp < before + kLinesApart && stamp > before - kClockSet) stamp = before + kLinesApart;
  }
}

/// Where the laser is on the robot; empty when the line says that it is farther away than it can be: then only one of
/// the poses was corrected.
std::optional<SensorMount> mountIn(const CarmenLine& line) {
  constexpr double kFarthest = 1.0;  // m
  const Point2 place = toLocalFrame(line.robot, {line.laser.x, line.laser.y});
  if (std::hypot(place.x, place.y) > kFarthest) return std::nullopt;
  return SensorMount{{place.x, place.y, normalizeAngle(line.laser.yaw - line.robot.yaw)}, false};
}

/// Turns lines into what a recorder hears.
class EventMaker {
 public:
  EventMaker(const std::optional<SensorMount>& given, double front_laser_offset, CarmenLog* log)
      : given_(given), offset_{{front_laser_offset, 0.0, 0.0}, false}, log_(log) {
    if (given_) log_->mount_known = true;
  }

  void add(CarmenLine line) {
    hear(line.stamp, line.robot);
    if (!line.has_scan) return;
    ScanHeard heard{line.stamp, std::move(line.scan), mountOf(line), kScanFrame};
    heard.scan.stamp = line.stamp;
    log_->events.emplace_back(std::move(heard));
  }

 private:
  void hear(double stamp, const Pose2& pose) {
    constexpr double kShortest = 0.01;  // s; differences over less are mostly noise
    OdometryHeard heard{stamp, pose, {}};
    const double elapsed = last_ ? stamp - last_->stamp : -1.0;
    if (last_) heard.twist = last_->twist;
    if (elapsed >= kShortest) {
      const double ahead = toLocalFrame(last_->pose, {pose.x, pose.y}).x;
      heard.twist = {ahead / elapsed, normalizeAngle(pose.yaw - last_->pose.yaw) / elapsed};
    }
    if (elapsed >= kShortest || elapsed < 0.0) last_ = heard;
    log_->events.emplace_back(heard);
  }

  SensorMount mountOf(const CarmenLine& line) {
    if (given_) return *given_;
    const std::optional<SensorMount> told = log_->scan_kind == "ROBOTLASER1" ? mountIn(line) : std::nullopt;
    if (told) log_->mount_known = true;
    return told ? *told : offset_;
  }

  std::optional<SensorMount> given_;
  SensorMount offset_;
  CarmenLog* log_;
  std::optional<OdometryHeard> last_;
};

}  // namespace

CarmenLog readCarmenLog(const std::string& path, const std::optional<SensorMount>& mount) {
  CarmenLog log;
  LogReader reader(path, &log);
  std::vector<CarmenLine> lines = reader.read();
  log.standing = countStandingScans(lines);
  log.late = mendLateStamps(&lines);
  spreadStamps(&lines);
  log.duration = lines.back().stamp - lines.front().stamp;
  EventMaker maker(mount, reader.frontLaserOffset(), &log);
  for (CarmenLine& line : lines) maker.add(std::move(line));
  return log;
}

ScanRules carmenLogRules() {
  ScanRules rules;
  rules.beyond_is_no_return = true;
  return rules;
}

void recordCarmenLog(const CarmenLog& log, const HindsightParameters& hindsight, const RecorderParameters& parameters,
                     StepSink* sink) {
  DriveRecorder recorder(parameters, sink, [](const std::string& frame, double) {
    return frame == kOdometryFrame ? std::optional<Pose2>(Pose2()) : std::nullopt;
  });
  std::vector<OdometryHeard> path;
  for (const DriveEvent& event : log.events) {
    if (const auto* odometry = std::get_if<OdometryHeard>(&event)) path.push_back(*odometry);
  }
  GoalSchedule goals(hindsightGoals(path, hindsight, parameters, kOdometryFrame), parameters.max_gap);
  for (const DriveEvent& event : log.events) {
    recorder.add(event);
    if (const auto* odometry = std::get_if<OdometryHeard>(&event)) goals.tell(odometry->stamp, &recorder);
  }
  recorder.finish();
}

}  // namespace lstm_planner
