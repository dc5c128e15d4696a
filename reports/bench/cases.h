// Collects the meshes that suites run: scenes of corpus/, public data, and all families of cases.
#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "corpus/cases/case_file.h"
#include "corpus/formats/sequences.h"
#include "detector/options.h"

namespace assay::reports {

struct BenchSettings {
  std::string data;  // the folder of the public data; rows name missing files
  double scale = 1;  // factor of mesh sizes, query counts and rounds; tests take less
  // For comparisons: the folder of the plug-ins, the processor seconds that a sequence may take,
  // and the threads of the oracle.
  std::string peers = {};
  double case_seconds = 60;
  int jobs = 1;

  bool is_quick() const { return scale < 1; }
  // Returns the number scaled, at least 320.
  int triangles(int full) const { return std::max(320, static_cast<int>(full * scale)); }
  // Returns the number scaled, at least 2.
  int rounds(int full) const { return std::max(2, static_cast<int>(full * std::min(1.0, scale))); }
};

// A file of the public data exists but cannot be used. The text is one line.
struct UnusableData : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Returns the value. Throws UnusableData, with this name before the problem, if there is none.
template <class Expected>
auto take(Expected result, const std::string& name = "") {
  if (!result) throw UnusableData((name.empty() ? "" : name + ": ") + result.error().message);
  return std::move(result.value());
}

// Returns a scene of corpus/. It cannot fail, because names and sizes are those of the benches.
corpus::Sequence bench_scene(const std::string& name, int triangles, int frames);

// Returns two frames of a scene around its first contact: the fastest vertex moves by the mean
// length of an edge, and the first contact is in the middle. On a fine mesh a step between frames
// of the scene itself would be many edges long, and its pairs would grow faster than the mesh.
// Returns nothing if the scene has no contact.
std::optional<corpus::Sequence> step_at_first_contact(const std::string& scene, int triangles);

// Returns the steps of a sequence that are worth judging: up to three before the first contact and
// two from there on; without a contact the first five.
corpus::Sequence around_first_contact(const corpus::Sequence& sequence);

// A case, and the knowledge about its start.
struct BenchCase {
  corpus::Case c;
  detector::Start start = detector::Start::verified;
  // If stated, subjects in this process play the case with this culling in place of their own.
  std::optional<detector::Culling> culling = {};
};
BenchCase timed_case(const std::string& id, corpus::Sequence sequence, detector::Start start);

// Returns the deforming meshes of the public data: rod-twist, thick-cloth, kick, and bunny-bent,
// which is the bunny, bent into a ring in five steps as in scene `bend`. The start is clean if the
// mesh is closed and without contact at the first frame. Missing data is left out, and the first
// missing file of each is named. Throws UnusableData for a file that exists and cannot be used, as
// the functions below do.
std::vector<BenchCase> real_sequences(const BenchSettings& settings,
                                      std::vector<std::string>& missing);

struct CaseFamily {
  std::string name;
  std::string kind;                               // scene, generated, hard, real
  int rounds = 5;                                 // 0: judged, but not timed
  std::function<std::vector<BenchCase>()> cases;  // made when they are run

  bool is_large() const { return kind == "scene" || kind == "real"; }
};

// Returns scenes of corpus/, by the steps around their first contact if there is one.
std::vector<CaseFamily> scene_families(const BenchSettings& settings);
// Returns the public sequences whose files exist; `missing` gets the missing files.
std::vector<CaseFamily> real_families(const BenchSettings& settings,
                                      std::vector<std::string>& missing);
// Returns scenes, the random families of the campaigns, the hard families of corpus/hard, and
// public sequences. A start is vouched for if the oracle, or the scene, knows that it is clean. The
// time of a step then does not include the verification of a new start.
std::vector<CaseFamily> all_families(const BenchSettings& settings,
                                     std::vector<std::string>& missing);

}  // namespace assay::reports
