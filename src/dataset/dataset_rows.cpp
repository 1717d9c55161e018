#include "dataset/dataset_rows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <utility>

#include "dataset/dataset_trust.hpp"
#include "dataset/step_quantities.hpp"
#include "lstm_planner/common/words.hpp"

namespace lstm_planner {

namespace {

using Poco::Int64;
using Poco::Data::BLOB;
using Poco::Data::Statement;
using Poco::Data::Keywords::bind;
using Poco::Data::Keywords::into;
using Poco::Data::Keywords::limit;
using Poco::Data::Keywords::now;
using Poco::Data::Keywords::range;
using Poco::Data::Keywords::use;

constexpr double kNoReturn = std::numeric_limits<double>::infinity();  // m

/// Names of the columns of table steps, in the order in which a StepRow is bound and read.
std::vector<std::string> stepColumns() {
  std::vector<std::string> names = {"episode", "geometry", "number"};
  DriveStep step;
  visitColumns(step, [&](const std::string& name, const char*, auto&) { names.push_back(name); });
  return names;
}

/// Calls work(column) for each column's member of the row, in the order of stepColumns().
template <typename Work>
void visitMembers(StepRow& row, Work&& work) {
  work(row.episode);
  work(row.geometry);
  work(row.number);
  std::size_t sector = 0;
  visitColumns(row.step, [&](const std::string& name, const char*, auto& number) {
    if (name.rfind("minimum_range_", 0) == 0) {
      work(row.minimum_ranges[sector++]);
    } else {
      work(number);
    }
  });
}

std::string questionMarks(std::size_t count) { return joined(std::vector<std::string>(count, "?")); }

BLOB toBlob(const std::vector<float>& ranges) {
  return BLOB(reinterpret_cast<const unsigned char*>(ranges.data()), ranges.size() * sizeof(float));
}

std::vector<float> toRanges(const BLOB& blob, int beams) {
  const std::size_t expected = static_cast<std::size_t>(beams) * sizeof(float);
  if (blob.size() != expected) {
    throw std::invalid_argument("its scan has " + std::to_string(blob.size()) + " bytes, expected " +
                                std::to_string(expected) + " of " + std::to_string(beams) + " beams");
  }
  std::vector<float> ranges(static_cast<std::size_t>(beams));
  std::copy(blob.rawContent(), blob.rawContent() + blob.size(), reinterpret_cast<unsigned char*>(ranges.data()));
  return ranges;
}

}  // namespace

void DatasetRows::addRecording(long id, const RecordingDescription& description) {
  file_->session()
      << "INSERT INTO recordings (id, source, software_version, odometry_frame, begun, parameters, finished) "
         "VALUES (?, ?, ?, ?, ?, ?, 0)",
      bind(Int64{id}), bind(description.source), bind(description.software_version), bind(description.odometry_frame),
      bind(description.begun), bind(toJson(description.parameters).dump()), now;
}

void DatasetRows::finishRecording(long id) {
  file_->session() << "UPDATE recordings SET finished = 1 WHERE id = ?", bind(Int64{id}), now;
}

void DatasetRows::setRejections(long recording, const RejectionCounts& counts) {
  for (int i = 0; i < kRejectionCount; ++i) {
    if (counts[static_cast<std::size_t>(i)] == 0) continue;
    file_->session() << "INSERT OR REPLACE INTO rejections (recording, reason, count) VALUES (?, ?, ?)",
        bind(Int64{recording}), bind(std::string(toString(static_cast<Rejection>(i)))),
        bind(Int64{counts[static_cast<std::size_t>(i)]}), now;
  }
}

void DatasetRows::addEpisode(long id, long recording, const Episode& episode) {
  const GoalInFrame& goal = episode.goal;
  file_->session() << "INSERT INTO episodes (id, recording, goal_frame, goal_x, goal_y, goal_yaw, goal_source, begun, "
                      "ended, ending, discarded) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
      bind(Int64{id}), bind(Int64{recording}), bind(goal.frame), bind(goal.pose.x), bind(goal.pose.y),
      bind(goal.pose.yaw), bind(episode.goal_source), bind(episode.begun), bind(episode.ended),
      bind(std::string(toString(episode.end))), bind(int{episode.discarded}), now;
}

void DatasetRows::endEpisode(long id, double stamp, EpisodeEnd end) {
  file_->session() << "UPDATE episodes SET ended = ?, ending = ? WHERE id = ?", bind(stamp),
      bind(std::string(toString(end))), bind(Int64{id}), now;
}

void DatasetRows::discardEpisode(long id) {
  file_->session() << "UPDATE episodes SET discarded = 1 WHERE id = ?", bind(Int64{id}), now;
}

Int64 DatasetRows::geometryOf(const DriveStep& step) {
  const ScanGeometry& geometry = step.geometry;
  if (last_geometry_ && *last_geometry_ == geometry) return last_geometry_id_;
  const Pose2& mount = geometry.mount.pose;
  Poco::Nullable<Int64> id;
  file_->session()
      << "SELECT id FROM geometries WHERE frame = ? AND angle_min = ? AND angle_increment = ? AND beams = ? "
         "AND range_min = ? AND range_max = ? AND mount_x = ? AND mount_y = ? AND mount_yaw = ? AND "
         "upside_down = ?",
      into(id), bind(geometry.frame), bind(geometry.angle_min), bind(geometry.angle_increment), bind(geometry.beams),
      bind(geometry.range_min), bind(geometry.range_max), bind(mount.x), bind(mount.y), bind(mount.yaw),
      bind(int{geometry.mount.upside_down}), limit(1), now;
  if (id.isNull()) {
    file_->session()
        << "INSERT INTO geometries (frame, angle_min, angle_increment, beams, range_min, range_max, mount_x, "
           "mount_y, mount_yaw, upside_down) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
        bind(geometry.frame), bind(geometry.angle_min), bind(geometry.angle_increment), bind(geometry.beams),
        bind(geometry.range_min), bind(geometry.range_max), bind(mount.x), bind(mount.y), bind(mount.yaw),
        bind(int{geometry.mount.upside_down}), now;
    id = Int64{file_->numberOf("SELECT last_insert_rowid()").value_or(0)};
  }
  last_geometry_ = geometry;
  last_geometry_id_ = id.value();
  return last_geometry_id_;
}

void DatasetRows::addStep(long episode, const DriveStep& step) {
  row_.geometry = geometryOf(step);
  row_.episode = episode;
  row_.number = step.number;
  std::vector<float> ranges;
  std::swap(ranges, row_.step.ranges);
  row_.step = step;
  for (std::size_t i = 0; i < row_.minimum_ranges.size(); ++i) {
    row_.minimum_ranges[i].clear();
    if (std::isfinite(step.minimum_ranges[i])) row_.minimum_ranges[i] = step.minimum_ranges[i];
  }
  if (!insert_step_) {
    const std::vector<std::string> columns = stepColumns();
    insert_step_.emplace(file_->session());
    *insert_step_ << "INSERT INTO steps (" + joined(columns) + ") VALUES (" + questionMarks(columns.size()) + ")";
    visitMembers(row_, [this](auto& member) { *insert_step_, use(member); });
  }
  insert_step_->execute();
  if (step.ranges.empty()) return;
  BLOB blob = toBlob(step.ranges);
  file_->session() << "INSERT INTO scans (step, ranges) VALUES (last_insert_rowid(), ?)", use(blob), now;
}

long nextRecording(DatasetFile* file) { return file->numberOf("SELECT max(id) FROM recordings").value_or(0) + 1; }

long nextEpisode(DatasetFile* file) { return file->numberOf("SELECT max(id) FROM episodes").value_or(0) + 1; }

namespace {

/// Runs `work` for a row; what it throws starts with the row's name.
template <typename Work>
void atRow(const char* name, Int64 id, Work&& work) {
  try {
    work();
  } catch (const std::exception& error) {
    throw std::invalid_argument(std::string(name) + " " + std::to_string(id) + ": " + error.what());
  }
}

/// Row `id` of another table.
template <typename Rows>
auto& rowOf(Rows& rows, const char* name, Int64 id) {
  const auto found = rows.find(id);
  if (found == rows.end()) throw std::invalid_argument(std::string("there is no ") + name + " " + std::to_string(id));
  return found->second;
}

/// Executes a query row by row.
template <typename Work>
void forEachRow(Statement* query, Work&& work) {
  *query, range(0, 1);
  while (!query->done() && query->execute() > 0) work();
}

std::map<Int64, Recording> readRecordings(Poco::Data::Session& session) {
  std::map<Int64, Recording> recordings;
  Int64 id = 0;
  RecordingDescription description;
  std::string parameters;
  int finished = 0;
  Statement query(session);
  query
      << "SELECT id, source, software_version, odometry_frame, begun, parameters, finished FROM recordings ORDER BY id",
      into(id), into(description.source), into(description.software_version), into(description.odometry_frame),
      into(description.begun), into(parameters), into(finished);
  forEachRow(&query, [&] {
    atRow("recording", id, [&] {
      description.parameters = recorderParametersFromJson(nlohmann::json::parse(parameters));
      validate(description.parameters);
    });
    recordings[id].description = description;
    recordings[id].finished = finished != 0;
  });
  return recordings;
}

void readRejections(Poco::Data::Session& session, std::map<Int64, Recording>* recordings) {
  Int64 recording = 0;
  std::string reason;
  Int64 count = 0;
  Statement query(session);
  query << "SELECT recording, reason, count FROM rejections", into(recording), into(reason), into(count);
  forEachRow(&query, [&] {
    Recording& counted = rowOf(*recordings, "recording", recording);
    counted.rejections[static_cast<std::size_t>(rejectionNamed(reason))] = static_cast<long>(count);
  });
}

std::map<Int64, ScanGeometry> readGeometries(Poco::Data::Session& session) {
  std::map<Int64, ScanGeometry> geometries;
  Int64 id = 0;
  ScanGeometry geometry;
  Pose2& mount = geometry.mount.pose;
  int upside_down = 0;
  Statement query(session);
  query << "SELECT id, frame, angle_min, angle_increment, beams, range_min, range_max, mount_x, mount_y, mount_yaw, "
           "upside_down FROM geometries",
      into(id), into(geometry.frame), into(geometry.angle_min), into(geometry.angle_increment), into(geometry.beams),
      into(geometry.range_min), into(geometry.range_max), into(mount.x), into(mount.y), into(mount.yaw),
      into(upside_down);
  forEachRow(&query, [&] {
    geometry.mount.upside_down = upside_down != 0;
    atRow("geometry", id, [&] { checkRow(geometry); });
    geometries[id] = geometry;
  });
  return geometries;
}

/// Where an episode is in the dataset.
struct EpisodePlace {
  Int64 recording = 0;
  std::size_t index = 0;
};

std::map<Int64, EpisodePlace> readEpisodes(Poco::Data::Session& session, std::map<Int64, Recording>* recordings) {
  std::map<Int64, EpisodePlace> places;
  Int64 id = 0;
  Int64 recording = 0;
  Episode episode;
  std::string ending;
  int discarded = 0;
  Statement query(session);
  query << "SELECT id, recording, goal_frame, goal_x, goal_y, goal_yaw, goal_source, begun, ended, ending, discarded "
           "FROM episodes ORDER BY id",
      into(id), into(recording), into(episode.goal.frame), into(episode.goal.pose.x), into(episode.goal.pose.y),
      into(episode.goal.pose.yaw), into(episode.goal_source), into(episode.begun), into(episode.ended), into(ending),
      into(discarded);
  forEachRow(&query, [&] {
    atRow("episode", id, [&] {
      episode.end = episodeEndNamed(ending);
      episode.discarded = discarded != 0;
      std::vector<RecordedEpisode>& episodes = rowOf(*recordings, "recording", recording).episodes;
      places[id] = {recording, episodes.size()};
      episodes.push_back({episode, {}});
    });
  });
  return places;
}

/// Calls work(row, blob) for each step; the blob is null where there is no scan.
template <typename Work>
void readSteps(Poco::Data::Session& session, bool with_scans, Work&& work) {
  StepRow row;
  Poco::Nullable<BLOB> blob;
  Statement query(session);
  query << "SELECT steps.id, " + joined(stepColumns()) + (with_scans ? ", scans.ranges" : "") + " FROM steps" +
               (with_scans ? " LEFT JOIN scans ON scans.step = steps.id" : "") + " ORDER BY steps.id";
  query, into(row.id);
  visitMembers(row, [&](auto& member) { query, into(member); });
  if (with_scans) query, into(blob);
  forEachRow(&query, [&] { work(row, blob); });
}

DriveStep toStep(const StepRow& row) {
  DriveStep step = row.step;
  step.number = static_cast<long>(row.number);
  for (std::size_t i = 0; i < row.minimum_ranges.size(); ++i) {
    step.minimum_ranges[i] = row.minimum_ranges[i].value(kNoReturn);
  }
  return step;
}

/// Pages that are used several times would make a short file into many long rows.
void checkPages(Poco::Data::Session& session) {
  std::string flaw;
  session << "PRAGMA quick_check(1)", into(flaw), limit(1), now;
  std::replace(flaw.begin(), flaw.end(), '\n', ' ');
  if (flaw != "ok") throw std::invalid_argument("SQLite finds it damaged: " + flaw);
}

}  // namespace

Dataset readRows(DatasetFile* file, bool with_scans) {
  Poco::Data::Session& session = file->session();
  checkPages(session);
  checkValues(session);
  std::map<Int64, Recording> recordings = readRecordings(session);
  readRejections(session, &recordings);
  const std::map<Int64, ScanGeometry> geometries = readGeometries(session);
  const std::map<Int64, EpisodePlace> places = readEpisodes(session, &recordings);
  readSteps(session, with_scans, [&](const StepRow& row, const Poco::Nullable<BLOB>& blob) {
    atRow("step", row.id, [&] {
      const EpisodePlace& place = rowOf(places, "episode", row.episode);
      Recording& recording = recordings.at(place.recording);
      DriveStep step = toStep(row);
      step.geometry = rowOf(geometries, "geometry", row.geometry);
      if (!blob.isNull()) step.ranges = toRanges(blob.value(), step.geometry.beams);
      checkRow(step, recording.description.parameters.action_angles.size());
      recording.episodes[place.index].steps.push_back(std::move(step));
    });
  });
  Dataset dataset;
  for (auto& [id, recording] : recordings) dataset.recordings.push_back(std::move(recording));
  return dataset;
}

}  // namespace lstm_planner
