#include "lstm_planner/common/file_hash.hpp"

#include <Poco/DigestStream.h>
#include <Poco/SHA1Engine.h>
#include <Poco/StreamCopier.h>

#include <fstream>

namespace lstm_planner {

std::string sha1OfFile(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return "unreadable";
  Poco::SHA1Engine engine;
  Poco::DigestOutputStream digest(engine);
  Poco::StreamCopier::copyStream(file, digest);
  digest.close();
  return Poco::DigestEngine::digestToHex(engine.digest());
}

}  // namespace lstm_planner
