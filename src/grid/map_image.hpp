#pragma once

#include <string>

namespace lstm_planner {

/// Throws MapFileError naming `path` unless the bytes start like a PNM, PNG, BMP or JPEG image of at most 2^26 pixels
/// that decodes to at most 2^28 bytes: decoders reserve what the header says, however short the file is.
void checkMapImage(const std::string& bytes, const std::string& path);

/// The largest value that a pixel can have, if the decoder leaves values as they are in the file (PNM, but for text
/// with one byte a value); otherwise 0.
int whiteOf(const std::string& bytes);

}  // namespace lstm_planner
