#pragma once

#include <string>

namespace lstm_planner {

/// Throws MapFileError naming `path` unless the bytes start like a PNM, PNG, BMP or JPEG image of at most 2^26 pixels
/// that decodes to at most 2^28 bytes: decoders reserve what the header says, however short the file is.
void checkMapImage(const std::string& bytes, const std::string& path);

/// The largest value of a pixel in an image that starts so, where decoders do not stretch values up to it: in binary
/// PNM images. 0 otherwise.
int whiteOf(const std::string& bytes);

}  // namespace lstm_planner
