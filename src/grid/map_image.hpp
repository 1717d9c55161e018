#pragma once

#include <string>

namespace lstm_planner {

/// Throws MapFileError naming `path` unless the bytes start like a PNM, PNG or BMP image of at most 2^26 pixels that
/// decodes to at most 2^28 bytes: decoders reserve what the header says, however short the file is.
void checkMapImage(const std::string& bytes, const std::string& path);

}  // namespace lstm_planner
