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
  std::string data;  // the folder of the public data; each missing file gets a row
  double scale = 1;  // factor of mesh sizes, numbers of cases, and rounds; below 1 in tests
  // For comparisons: the folder of the peers' plug-ins, the limit of processor seconds for one run
  // of a sequence, and the number of threads of the oracle.
  std::string peers = {};
  double case_seconds = 60;
  int jobs = 1;

  bool is_quick() const { return scale < 1; }
  // Returns `full` times the scale, at least 320.
  int triangles(int full) const { return std::max(320, static_cast<int>(full * scale)); }
  // Returns `full` times the scale, at least 2 and at most `full`.
  int rounds(int full) const { return std::max(2, static_cast<int>(full * std::min(1.0, scale))); }
};

// Thrown if a file of the public data exists but cannot be used. Its message is one line.
struct UnusableData : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Returns the value of `result`. If there is no value, throws UnusableData, whose message is the
// name and then the problem.
template <class Expected>
auto take(Expected result, const std::string& name = "") {
  if (!result) throw UnusableData((name.empty() ? "" : name + ": ") + result.error().message);
  return std::move(result.value());
}

// Returns a scene of corpus/. REQUIRES a name and sizes that the scenes of corpus/ accept.
corpus::Sequence bench_scene(const std::string& name, int triangles, int frames);

// Returns two frames of a scene around its first contact: the fastest vertex moves by the mean
// length of an edge, and the first contact is in the middle of the step. Returns nothing if the
// scene has no contact. The frames of the scene itself would not do: on a fine mesh a step between
// them is many edges long, so that the number of pairs grows faster than the number of triangles.
std::optional<corpus::Sequence> step_at_first_contact(const std::string& scene, int triangles);

// Returns the steps of a sequence that are worth judging, at most five: three steps before the
// first step with a contact, that step, and the next step. If there is no contact, or if fewer than
// four steps come before it, returns the first five steps.
corpus::Sequence around_first_contact(const corpus::Sequence& sequence);

// A case, with the options that its subjects get for it.
struct BenchCase {
  corpus::Case c;
  detector::Start start = detector::Start::verified;
  // If stated, subjects in this process play the case with this culling in place of their own.
  std::optional<detector::Culling> culling = {};
};
BenchCase timed_case(const std::string& id, corpus::Sequence sequence, detector::Start start);

// Returns the deforming meshes of the public data: rod-twist, thick-cloth, kick, and bunny-bent,
// which is the bunny, bent into a ring in five steps as in scene `bend`. The start is clean if the
// mesh is closed and without contact at the first frame. A mesh with missing files is left out, and
// `missing` gets the first of these files. This function and the functions below throw UnusableData
// if a file exists and cannot be used.
std::vector<BenchCase> real_sequences(const BenchSettings& settings,
                                      std::vector<std::string>& missing);

struct CaseFamily {
  std::string name;
  std::string kind;                               // scene, generated, hard, real
  int rounds = 5;                                 // 0: judged, but not timed
  std::function<std::vector<BenchCase>()> cases;  // makes the cases when they are run

  bool is_large() const { return kind == "scene" || kind == "real"; }
};

// Returns the scenes of corpus/, each cut down to the steps that around_first_contact returns.
std::vector<CaseFamily> scene_families(const BenchSettings& settings);
// Returns the public sequences whose files exist; `missing` gets the missing files.
std::vector<CaseFamily> real_families(const BenchSettings& settings,
                                      std::vector<std::string>& missing);
// Returns scenes, the random families of the campaigns, the hard families of corpus/hard, and
// public sequences. A case has Start::clean if the oracle shows that its start is clean, or if its
// scene is closed. The time of its steps then does not include the verification of a new start.
std::vector<CaseFamily> all_families(const BenchSettings& settings,
                                     std::vector<std::string>& missing);

}  // namespace assay::reports
