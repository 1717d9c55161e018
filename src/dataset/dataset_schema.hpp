#pragma once

#include <array>

namespace lstm_planner {

/// PRAGMA application_id of every dataset file: "LSTM" in ASCII. `file` and sqlite3 show it.
constexpr int kDatasetApplicationId = 0x4c53544d;

/// PRAGMA user_version: the version of the schema. It grows when a reader of the last one would misunderstand the file.
constexpr int kDatasetSchemaVersion = 1;

/// The tables of a dataset file, with the unit and the frame of every column; SQLite keeps the comments, so that
/// `sqlite3 FILE .schema` explains the file. Angles are positive to the left. Columns that end in _0 .. _7 go from
/// right to left: sectors of [-90, +90) degrees around the heading, or, for visits, directions of heading + i * 45
/// degrees.
constexpr std::array<const char*, 6> kDatasetSchema = {
    R"sql(CREATE TABLE recordings (
  id INTEGER PRIMARY KEY,          -- in the order in which they were started or merged
  source TEXT NOT NULL,            -- 'live', or the path of the bag or log
  software_version TEXT NOT NULL,  -- of lstm_planner
  odometry_frame TEXT NOT NULL,    -- '' where there are no frames
  begun TEXT NOT NULL,             -- UTC, ISO 8601, by the computer's clock
  parameters TEXT NOT NULL,        -- JSON: the recorder's parameters, with the allowed angles of the labels
  finished INTEGER NOT NULL        -- 0: it is still going on, or was cut off
))sql",

    R"sql(CREATE TABLE episodes (
  id INTEGER PRIMARY KEY,          -- in the order of driving
  recording INTEGER NOT NULL REFERENCES recordings(id),
  goal_frame TEXT NOT NULL,        -- the goal as it was given
  goal_x REAL NOT NULL,            -- m, in goal_frame
  goal_y REAL NOT NULL,            -- m, in goal_frame
  goal_yaw REAL NOT NULL,          -- rad, in goal_frame
  goal_source TEXT NOT NULL,       -- a topic, 'waypoints', 'hindsight'
  begun REAL NOT NULL,             -- s, clock of the robot's stamps
  ended REAL NOT NULL,             -- s; 0 while it is running
  ending TEXT NOT NULL,            -- 'running' (or cut off), 'arrived', 'new goal', 'aborted', 'time jump',
                                   -- 'odometry jump', 'paused', 'finished'
  discarded INTEGER NOT NULL       -- 1: by the driver; not to be learned from
))sql",

    R"sql(CREATE TABLE geometries (
  id INTEGER PRIMARY KEY,          -- how a scan was taken; many steps share one
  frame TEXT NOT NULL,             -- the scanner's
  angle_min REAL NOT NULL,         -- rad, of the first beam
  angle_increment REAL NOT NULL,   -- rad
  beams INTEGER NOT NULL,
  range_min REAL NOT NULL,         -- m
  range_max REAL NOT NULL,         -- m
  mount_x REAL NOT NULL,           -- m, of the scanner in the base frame
  mount_y REAL NOT NULL,           -- m
  mount_yaw REAL NOT NULL,         -- rad
  upside_down INTEGER NOT NULL     -- 1: mounted so
))sql",

    R"sql(CREATE TABLE steps (
  id INTEGER PRIMARY KEY,          -- in the order of driving
  episode INTEGER NOT NULL REFERENCES episodes(id),
  geometry INTEGER NOT NULL REFERENCES geometries(id),
  number INTEGER NOT NULL,         -- in its episode, from 0; a gap is a step without a label
  stamp REAL NOT NULL,             -- s, of the scan
  next_stamp REAL NOT NULL,        -- s, of the next step's scan
  pose_x REAL NOT NULL,            -- m, of the base in the odometry frame at stamp
  pose_y REAL NOT NULL,            -- m
  pose_yaw REAL NOT NULL,          -- rad
  next_pose_x REAL NOT NULL,       -- m, the same at next_stamp
  next_pose_y REAL NOT NULL,       -- m
  next_pose_yaw REAL NOT NULL,     -- rad
  twist_linear REAL NOT NULL,      -- m/s, of the base at stamp
  twist_angular REAL NOT NULL,     -- rad/s
  goal_x REAL NOT NULL,            -- m, in the odometry frame at stamp
  goal_y REAL NOT NULL,            -- m
  -- m, mean range of each sector, what is farther than the range cap counted as the cap
  sector_range_0 REAL NOT NULL, sector_range_1 REAL NOT NULL, sector_range_2 REAL NOT NULL,
  sector_range_3 REAL NOT NULL, sector_range_4 REAL NOT NULL, sector_range_5 REAL NOT NULL,
  sector_range_6 REAL NOT NULL, sector_range_7 REAL NOT NULL,
  -- m, nearest return of each sector; NULL where nothing was measured
  minimum_range_0 REAL, minimum_range_1 REAL, minimum_range_2 REAL, minimum_range_3 REAL,
  minimum_range_4 REAL, minimum_range_5 REAL, minimum_range_6 REAL, minimum_range_7 REAL,
  -- beams of each sector
  beams_0 INTEGER NOT NULL, beams_1 INTEGER NOT NULL, beams_2 INTEGER NOT NULL, beams_3 INTEGER NOT NULL,
  beams_4 INTEGER NOT NULL, beams_5 INTEGER NOT NULL, beams_6 INTEGER NOT NULL, beams_7 INTEGER NOT NULL,
  -- of these, beams with a measured range
  measured_0 INTEGER NOT NULL, measured_1 INTEGER NOT NULL, measured_2 INTEGER NOT NULL, measured_3 INTEGER NOT NULL,
  measured_4 INTEGER NOT NULL, measured_5 INTEGER NOT NULL, measured_6 INTEGER NOT NULL, measured_7 INTEGER NOT NULL,
  goal_distance REAL NOT NULL,     -- m
  goal_bearing REAL NOT NULL,      -- rad in (-pi, pi], relative to the heading
  heading REAL NOT NULL,           -- rad in (-pi, pi], in the odometry frame
  previous_action REAL NOT NULL,   -- rad, angle of the label of the step before; 0 at the first
  route_bearing REAL NOT NULL,     -- rad in (-pi, pi], of the path through what is remembered, relative to the heading
  route_length REAL NOT NULL,      -- m, of that path to the goal
  -- times that the robot was at the place a step away in each direction
  visits_0 REAL NOT NULL, visits_1 REAL NOT NULL, visits_2 REAL NOT NULL, visits_3 REAL NOT NULL,
  visits_4 REAL NOT NULL, visits_5 REAL NOT NULL, visits_6 REAL NOT NULL, visits_7 REAL NOT NULL,
  driven_angle REAL NOT NULL,      -- rad in (-pi, pi], where the robot went, relative to the heading (thesis Eq. 4.1)
  label INTEGER NOT NULL           -- index of the allowed angle nearest to it (Eq. 4.2)
))sql",

    R"sql(CREATE TABLE scans (
  step INTEGER PRIMARY KEY REFERENCES steps(id),  -- only where whole scans are kept
  ranges BLOB NOT NULL             -- m, IEEE 754 of 32 bits, little-endian, as the driver published them
))sql",

    R"sql(CREATE TABLE rejections (
  recording INTEGER NOT NULL REFERENCES recordings(id),
  reason TEXT NOT NULL,            -- why what was seen has not become a step: 'standing', 'no goal', ...
  count INTEGER NOT NULL,
  PRIMARY KEY (recording, reason)
))sql",
};

}  // namespace lstm_planner
