#include "grid/map_image.hpp"

#include <cmath>
#include <cstdint>
#include <iomanip>
#include <sstream>

#include "lstm_planner/grid/map_server_map.hpp"

namespace lstm_planner {
namespace {

constexpr double kMostPixels = 67108864.0;  // 2^26: 400 m by 400 m at 5 cm
constexpr double kMostBytes = 268435456.0;  // 2^28, of a decoded image

/// What a header says about the memory that decoding takes.
struct ImageSize {
  double width = 0.0;        ///< pixels
  double height = 0.0;       ///< pixels
  double pixel_bytes = 0.0;  ///< of a decoded pixel
};

bool startsWith(const std::string& bytes, const char* with) { return bytes.rfind(with, 0) == 0; }

/// `count` bytes from `first`; 0 where the file ends before.
std::uint32_t number(const std::string& bytes, std::size_t first, std::size_t count, bool big_endian) {
  if (bytes.size() < first + count) return 0;
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t place = first + (big_endian ? i : count - 1 - i);
    value = value << 8U | static_cast<unsigned char>(bytes[place]);
  }
  return value;
}

/// Next number of a PNM header, which may be preceded by comments; -1 when there is none.
double pnmNumber(std::istream& stream) {
  while (stream) {
    stream >> std::ws;
    if (stream.peek() != '#') break;
    stream.ignore(4096, '\n');
  }
  double value = -1.0;
  return stream >> value ? value : -1.0;
}

bool isPnm(const std::string& bytes) {
  return bytes.size() > 2 && bytes[0] == 'P' && bytes[1] >= '1' && bytes[1] <= '6';
}

struct PnmHeader {
  double width = 0.0;
  double height = 0.0;
  double white = 1.0;  ///< largest value of a pixel; bitmaps do not name it
};

PnmHeader readPnmHeader(const std::string& bytes) {
  constexpr std::size_t kLongestHeader = 65536;
  std::istringstream text(bytes.substr(2, kLongestHeader));
  PnmHeader header;
  header.width = pnmNumber(text);
  header.height = pnmNumber(text);
  if (bytes[1] != '1' && bytes[1] != '4') header.white = pnmNumber(text);
  return header;
}

ImageSize pnmSize(const std::string& bytes) {
  const PnmHeader header = readPnmHeader(bytes);
  const double channels = bytes[1] == '3' || bytes[1] == '6' ? 3.0 : 1.0;
  return {header.width, header.height, channels * (header.white > 255.0 ? 2.0 : 1.0)};
}

ImageSize pngSize(const std::string& bytes) {
  const bool is_grey = number(bytes, 25, 1, true) == 0;
  const double depth_bytes = number(bytes, 24, 1, true) == 16 ? 2.0 : 1.0;
  return {static_cast<double>(number(bytes, 16, 4, true)), static_cast<double>(number(bytes, 20, 4, true)),
          (is_grey ? 1.0 : 4.0) * depth_bytes};
}

ImageSize bmpSize(const std::string& bytes) {
  constexpr std::uint32_t kOldHeader = 12;  // bytes
  const auto signedSize = [&](std::size_t first) {
    return std::abs(static_cast<double>(static_cast<std::int32_t>(number(bytes, first, 4, false))));
  };
  if (number(bytes, 14, 4, false) == kOldHeader) {
    return {static_cast<double>(number(bytes, 18, 2, false)), static_cast<double>(number(bytes, 20, 2, false)), 4.0};
  }
  return {signedSize(18), signedSize(22), 4.0};
}

/// The size stands in the frame header, which follows other segments: each has a marker of two bytes and its length.
ImageSize jpegSize(const std::string& bytes) {
  const auto isFrame = [](std::uint32_t marker) {
    return marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
  };
  std::size_t place = 2;
  while (number(bytes, place, 1, true) == 0xff) {
    while (number(bytes, place + 1, 1, true) == 0xff) ++place;  // any number of these may stand before a marker
    if (isFrame(number(bytes, place + 1, 1, true))) {
      return {static_cast<double>(number(bytes, place + 7, 2, true)),
              static_cast<double>(number(bytes, place + 5, 2, true)), 3.0};
    }
    place += 2 + number(bytes, place + 2, 2, true);
  }
  return {};
}

}  // namespace

int whiteOf(const std::string& bytes) {
  if (!isPnm(bytes)) return 0;
  const double white = readPnmHeader(bytes).white;
  const bool is_left = bytes[1] > '4' || white > 255.0;
  return is_left && white >= 1.0 && white <= 65535.0 ? static_cast<int>(white) : 0;
}

void checkMapImage(const std::string& bytes, const std::string& path) {
  ImageSize size;
  if (startsWith(bytes, "\x89PNG")) {
    size = pngSize(bytes);
  } else if (startsWith(bytes, "BM")) {
    size = bmpSize(bytes);
  } else if (startsWith(bytes, "\xff\xd8\xff")) {
    size = jpegSize(bytes);
  } else if (isPnm(bytes)) {
    size = pnmSize(bytes);
  } else {
    throw MapFileError("the map image " + path + " is of no kind that is known here; expected pgm, png, bmp or jpg");
  }
  if (!(size.width > 0.0) || !(size.height > 0.0) || size.width * size.height > kMostPixels ||
      size.width * size.height * size.pixel_bytes > kMostBytes) {
    std::ostringstream sentence;
    sentence << std::fixed << std::setprecision(0) << "the map image " << path << " has " << size.width << " x "
             << size.height << " pixels of " << size.pixel_bytes
             << " bytes, expected positive sizes and at most 2^26 pixels or 2^28 bytes";
    throw MapFileError(sentence.str());
  }
}

}  // namespace lstm_planner
