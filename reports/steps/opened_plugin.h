// The code with which the programs exported for a plug-in's owner begin: it loads the plug-in.
#pragma once

#include <string>

namespace assay::reports {

inline constexpr const char* plugin_loading =
    R"(// Needs detector/plugin/assay_detector.h: c++ -I SOURCES-OF-ASSAY FOLDER/case_plugin.cpp -ldl
#define CASE_ARRAYS_ONLY
#include "case.cpp"

#include <dlfcn.h>

#include "detector/plugin/assay_detector.h"

int main(int argc, char** argv) {
  void* library = argc > 1 ? dlopen(argv[1], RTLD_NOW) : nullptr;
  void* entry = library ? dlsym(library, "assay_detector") : nullptr;
  if (!entry) {
    std::printf("usage: case_plugin LIB.so: %s\n", argc > 1 ? dlerror() : "no library");
    return 2;
  }
  const assay_detector_api* api = reinterpret_cast<const assay_detector_api* (*)()>(entry)();
)";

// `kind` is "case" or "query"; its arrays stand in the file beside it. The code that follows finds
// the table as `api`.
inline std::string opened_plugin(const std::string& kind) {
  return std::string("// The same ")
      .append(kind)
      .append(" through a plug-in: ./case_plugin ./libmine.so\n")
      .append(plugin_loading);
}

}  // namespace assay::reports
