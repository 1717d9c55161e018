#pragma once

#include <string>

namespace lstm_planner {

/// What the header of an image says about the memory that decoding it takes.
struct ImageSize {
  double width = 0.0;        ///< pixels
  double height = 0.0;       ///< pixels
  double pixel_bytes = 0.0;  ///< of a decoded pixel
};

/// Throws MapFileError naming `path` unless the bytes begin like a PNM, PNG or BMP image that decodes to at most 2^28
/// bytes: decoders reserve what the header says, however short the file is.
void checkMapImage(const std::string& bytes, const std::string& path);

}  // namespace lstm_planner
