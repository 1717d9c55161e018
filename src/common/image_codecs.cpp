#include "common/image_codecs.hpp"

#ifndef LSTM_PLANNER_STATIC
#include <dlfcn.h>
#endif

#include <filesystem>
#include <stdexcept>

namespace lstm_planner {

#ifdef LSTM_PLANNER_STATIC

const ImageCodecs& imageCodecs() { return *lstmPlannerImageCodecs(); }

#else

namespace {

[[noreturn]] void refuse(const std::string& path) {
  const char* const reason = ::dlerror();
  throw std::runtime_error("the library of image formats '" + path +
                           "' cannot be loaded: " + (reason == nullptr ? "it has other contents" : reason));
}

/// It stands where the library stands that this function is in.
std::string pathOfLibrary() {
  Dl_info here;
  if (::dladdr(reinterpret_cast<const void*>(&imageCodecs), &here) == 0) refuse(LSTM_PLANNER_IMAGE_CODECS);
  return (std::filesystem::path(here.dli_fname).parent_path() / LSTM_PLANNER_IMAGE_CODECS).string();
}

const ImageCodecs* load() {
  const std::string path = pathOfLibrary();
  // Never unloaded: not all of the libraries that it brings can be.
  void* const library = ::dlopen(path.c_str(), RTLD_LAZY | RTLD_LOCAL | RTLD_NODELETE);
  if (library == nullptr) refuse(path);
  void* const found = ::dlsym(library, "lstmPlannerImageCodecs");
  if (found == nullptr) refuse(path);
  return reinterpret_cast<const ImageCodecs* (*)()>(found)();
}

}  // namespace

const ImageCodecs& imageCodecs() {
  static const ImageCodecs* const codecs = load();
  return *codecs;
}

#endif

}  // namespace lstm_planner
