// The meshes that suites run: scenes of corpus/, the public data, and all families of cases.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "corpus/cases/case_file.h"
#include "corpus/formats/sequence_reader.h"
#include "detector/options.h"
#include "reports/bench/suites.h"

namespace assay::reports {

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

// The deforming meshes of the public data. All functions below throw UnusableData for a file that
// is there and cannot be used.
struct RealSequence {
  std::string name;
  corpus::Sequence frames;
  bool starts_clean = false;  // closed, and without contact at the first frame

  detector::Start start() const {
    return starts_clean ? detector::Start::clean : detector::Start::verified;
  }
};

// rod-twist, thick-cloth, kick, and the bunny as scene `bend` bends it. Data that is not there is
// left out and named in `missing`.
std::vector<RealSequence> real_sequences(const BenchSettings& settings,
                                         std::vector<std::string>& missing);
// One of the first three. If it is not there, its first file that is missing is named.
std::optional<RealSequence> real_sequence(const BenchSettings& settings, const std::string& name,
                                          std::vector<std::string>& missing);

// The bunny as it is bent into a ring in five steps; nothing if it is not there.
std::optional<corpus::Sequence> bent_bunny(const BenchSettings& settings);

// A case, and what is known of its start.
struct TimedCase {
  corpus::Case c;
  detector::Start start = detector::Start::verified;
};
TimedCase timed_case(const std::string& id, corpus::Sequence sequence, detector::Start start);

struct CaseFamily {
  std::string name;
  std::string kind;  // scene, generated, hard, real
  int rounds = 5;
  std::function<std::vector<TimedCase>()> cases;  // made when they are run

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
