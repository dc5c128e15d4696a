// The meshes that suites run: scenes of corpus/, the public data, and all families of cases.
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
  std::string data;  // the folder of the public data; rows say what is not there
  double scale = 1;  // factor of mesh sizes, query counts and rounds; tests take less
  // Of comparisons: the folder of the plug-ins, the processor seconds that a sequence may take, and
  // the threads of the oracle.
  std::string peers = {};
  double case_seconds = 60;
  int jobs = 1;

  bool is_quick() const { return scale < 1; }
  // Scaled, at least 320.
  int triangles(int full) const { return std::max(320, static_cast<int>(full * scale)); }
  // Scaled, at least 2.
  int rounds(int full) const { return std::max(2, static_cast<int>(full * std::min(1.0, scale))); }
};

// A file of the public data is there but cannot be used. The text is one line.
struct UnusableData : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// The value. Throws UnusableData, with this name before the problem, if there is none.
template <class Expected>
auto take(Expected result, const std::string& name = "") {
  if (!result) throw UnusableData((name.empty() ? "" : name + ": ") + result.error().message);
  return std::move(result.value());
}

// A scene of corpus/. It cannot fail, because names and sizes are those of the benches.
corpus::Sequence bench_scene(const std::string& name, int triangles, int frames);

// Two frames of a scene around its first contact: the fastest vertex moves by the mean length of
// an edge, and the first contact is in the middle. On a fine mesh a step between frames of the
// scene itself would be many edges long, and its pairs would grow faster than the mesh. Nothing if
// the scene has no contact.
std::optional<corpus::Sequence> step_at_first_contact(const std::string& scene, int triangles);

// The steps of a sequence that are worth judging: up to three before the first contact and two
// from there on. If there is no contact: the first five.
corpus::Sequence around_first_contact(const corpus::Sequence& sequence);

// A case, and what is known of its start.
struct BenchCase {
  corpus::Case c;
  detector::Start start = detector::Start::verified;
  // Subjects in this process play it with this culling, if it is stated, in place of their own.
  std::optional<detector::Culling> culling = {};
};
BenchCase timed_case(const std::string& id, corpus::Sequence sequence, detector::Start start);

// The deforming meshes of the public data: rod-twist, thick-cloth, kick, and bunny-bent, the bunny
// as scene `bend` bends it into a ring in five steps. The start is clean if the mesh is closed and
// without contact at the first frame. Data that is not there is left out, and its first file that
// is missing is named. Throws UnusableData for a file that is there and cannot be used, as the
// functions below do.
std::vector<BenchCase> real_sequences(const BenchSettings& settings,
                                      std::vector<std::string>& missing);

struct CaseFamily {
  std::string name;
  std::string kind;                               // scene, generated, hard, real
  int rounds = 5;                                 // 0: it is judged, and not timed
  std::function<std::vector<BenchCase>()> cases;  // made when they are run

  bool is_large() const { return kind == "scene" || kind == "real"; }
};

// Scenes of corpus/, by the steps around their first contact if there is one.
std::vector<CaseFamily> scene_families(const BenchSettings& settings);
// Those public sequences that are there; `missing` gets the files that are not.
std::vector<CaseFamily> real_families(const BenchSettings& settings,
                                      std::vector<std::string>& missing);
// Scenes, the random families of the campaigns, the hard families of corpus/hard, and public
// sequences. A start is vouched for if the oracle, or the scene, knows that it is clean. The time
// of a step is then without the verification that only a new start takes.
std::vector<CaseFamily> all_families(const BenchSettings& settings,
                                     std::vector<std::string>& missing);

}  // namespace assay::reports
