// A test configures a plug-in by words in an environment variable, such as "start=free late=1e-9".
// The words that describe a detector are the same for all plug-ins:
//
//   start=free, start=apart:D, range=LO:HI, features=vertex-face, features=edge-edge, tolerance=T,
//   margin=D, separation=D, no-pairs, adjacency=NUMBER, float32,
//   displacement, claims=NUMBER, capacity-triangles=N, capacity-contacts=N, capacity-candidates=N
#pragma once

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <ctime>

#include "detector/plugin/assay_detector.hpp"
#include "tests/words.h"

namespace assay::tests {

class Told {
 public:
  explicit Told(const char* variable) {
    if (const char* given = std::getenv(variable)) words_ = words(given);
  }

  // Returns the value of a word; "" if the word has no value, null if the variable lacks the word.
  const char* value_of(const std::string& name) const {
    for (const auto& word : words_) {
      if (word == name) return "";
      if (word.starts_with(name + "=")) return word.c_str() + name.size() + 1;
    }
    return nullptr;
  }
  bool has(const std::string& name) const { return value_of(name) != nullptr; }
  bool is(const std::string& name, const char* value) const {
    const char* found = value_of(name);
    return found && std::strcmp(found, value) == 0;
  }
  double number_of(const std::string& name) const {
    const char* text = value_of(name);
    return text ? std::strtod(text, nullptr) : 0;
  }

  plugin::Description description(const char* name, std::uint32_t claims) const {
    plugin::Description d;
    d.name = name;
    d.version = "1";
    d.claims = has("claims") ? static_cast<std::uint32_t>(number_of("claims")) : claims;
    d.margin = number_of("margin");
    d.separation = number_of("separation");
    d.time_tolerance = number_of("tolerance");
    d.adjacency = static_cast<std::int32_t>(number_of("adjacency"));
    const auto count_of = [this](const char* word) {
      return static_cast<std::uint64_t>(number_of(word));
    };
    d.capacity_triangles = count_of("capacity-triangles");
    d.capacity_contacts = count_of("capacity-contacts");
    d.capacity_candidates = count_of("capacity-candidates");
    if (has("no-pairs")) d.reports = ASSAY_REPORTS_NO_PAIRS;
    if (has("float32")) d.coordinates = ASSAY_COORDINATES_FLOAT32;
    if (has("displacement")) d.motion = ASSAY_MOTION_DISPLACEMENT;
    if (is("features", "vertex-face")) d.features = ASSAY_FEATURES_VERTEX_FACE;
    if (is("features", "edge-edge")) d.features = ASSAY_FEATURES_EDGE_EDGE;
    if (is("start", "free")) d.start = ASSAY_START_FREE;
    if (const char* start = value_of("start"); start && std::strncmp(start, "apart:", 6) == 0) {
      d.start = ASSAY_START_APART;
      d.start_distance = std::strtod(start + 6, nullptr);
    }
    if (const char* range = value_of("range")) {
      d.least_nonzero = std::strtod(range, nullptr);
      d.largest = std::strtod(std::strchr(range, ':') + 1, nullptr);
    }
    return d;
  }

 private:
  std::vector<std::string> words_;
};

// Uses this many seconds of processor time, but at most a minute, in case nobody ends the process.
inline void burn(double seconds) {
  const double until = std::clock() + std::min(seconds, 60.) * CLOCKS_PER_SEC;
  while (std::clock() < until) {
  }
}

}  // namespace assay::tests
