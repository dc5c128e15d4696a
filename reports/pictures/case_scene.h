// A case as it is shown: its steps, what the oracle and the detector found in them, where two
// triangles meet or are nearest to each other, and view sets. Places are computed in plain doubles,
// and no verdict rests on them.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "detector/mesh/step_types.h"
#include "detector/mesh/surface.h"
#include "detector/options.h"
#include "detector/step_result.h"
#include "oracle/mesh/step.h"
#include "properties/judging/verdict.h"
#include "properties/worker/worker_process.h"
#include "reports/terminal/option_words.h"
#include "reports/terminal/work.h"

namespace assay::reports {

struct NearestPoints {
  Eigen::Vector3d a, b;  // one on each triangle of the pair
  double distance() const { return (a - b).stableNorm(); }
  Eigen::Vector3d middle() const { return 0.5 * (a + b); }
};

// The closest points, at time t in [0,1] of the step, of the two features of a contact
// (detector/contact_place.h). In a contact they coincide up to rounding, and are one point if an
// edge pierces a face. If no feature is named, as by a plug-in: the closest points of the two
// triangles, by what they do not share. Nothing if there is no such place, because all features
// share a vertex, or because it overflows.
std::optional<NearestPoints> contact_places(detector::PairContact contact,
                                            const detector::TrianglesView& triangles,
                                            const detector::SteppedMesh& motion, double t);

struct CaseScene;

struct SceneStep {
  corpus::CaseStep span;
  properties::StepTruth truth;                 // under the detector's contract
  std::optional<detector::StepResult> answer;  // by the detector; nothing if its run broke off
  // How the two differ; nothing if the detector did not run.
  std::optional<properties::StepDiff> diff;
  properties::CandidatePairs candidates = {};  // only of a plug-in that gives some

  // Whether `answer` has view sets to be shown.
  bool has_views() const { return answer && !answer->doubts.empty(); }
  // What the claims and the contract make of a pair that is in contact or reported, in words:
  // "missing", "late", "early", "spurious", "no candidate" and "answered free" break a claim; "not
  // claimed", alone or behind what differs, "left out by the contract", "agrees" and "not run" do
  // not.
  std::string difference(const detector::TrianglePair& pair, const CaseScene& scene) const;
};

struct CaseScene {
  corpus::Case c;  // as the detector's contract has it
  std::vector<SceneStep> steps;
  std::optional<detector::Surface> surface;    // the mesh and its ghosts; nothing if it was refused
  properties::Claims claims;                   // that are judged under the contract
  properties::Contract contract;               // that it is judged under
  bool reports_pairs = true;                   // false: the detector says nothing of pairs
  std::string ending;                          // how the detector's run broke off; else empty
  std::optional<properties::Failure> failure;  // what is wrong, if the case still fails

  // The step and the pair that the picture is about: those of the failure, else of the first
  // contact.
  std::size_t shown_step() const;
  std::optional<detector::TrianglePair> shown_pair() const;

  // What the contract wants of distances, "d 0.01, slack 0.002"; empty if it asks what touches.
  std::string asked_distance() const;
  // Where the two of a contact are nearest to each other at its time: the two features of a query,
  // else the two triangles, if the contract asks for a distance, else the features that touch.
  std::optional<NearestPoints> nearest_points(const SceneStep& step,
                                              detector::PairContact contact) const;
};

double middle(const detector::TimeEnclosure& time);

// `worker` runs the detector; null: it is not at hand. Nothing if the contract cannot represent a
// coordinate. The case is judged exactly, which is dear: meant for shrunk cases.
std::optional<CaseScene> make_scene(const corpus::Case& c,
                                    const properties::DetectorUnderTest& detector,
                                    const properties::Configuration& configuration,
                                    properties::WorkerProcess* worker);

// The contact of this pair, or null.
const detector::PairContact* contact_of(const std::vector<detector::PairContact>& contacts,
                                        const std::optional<detector::TrianglePair>& pair);

// View sets under the names that pages and pictures show, and their colours.

// The view set of a triangle over a step. A triangle in doubt (dirty, violated) is in that set
// whatever its sign is, as in the search for pairs.
enum class ViewSet : std::uint8_t { none, positive, negative, zero, dirty, violated };

// Names and colours in the order of ViewSet. The colours are mid-tones for light and dark grounds
// alike, which people who see colours differently can tell apart (Okabe and Ito).
inline constexpr std::array<const char*, 6> view_set_names = {"none", "V+",    "V-",
                                                              "V0",   "dirty", "violated"};
inline constexpr std::array<const char*, 6> view_set_colours = {"#9aa0a6", "#56b4e9", "#e69f00",
                                                                "#f0e442", "#cc79a7", "#d55e00"};

// The set of a triangle; `none` if the step has no view sets. A triangle that is both touched by a
// ghost and dirty counts as violated.
inline ViewSet view_set(const detector::StepResult& result, std::size_t triangle) {
  if (triangle >= result.signs.size()) return ViewSet::none;
  const std::uint8_t doubt = triangle < result.doubts.size() ? result.doubts[triangle] : 0;
  if (doubt & detector::doubt::violated) return ViewSet::violated;
  if (doubt & detector::doubt::dirty) return ViewSet::dirty;
  const auto sign = result.signs[triangle];
  return sign == detector::ViewSign::positive   ? ViewSet::positive
         : sign == detector::ViewSign::negative ? ViewSet::negative
                                                : ViewSet::zero;
}

// Runs a stored case through the detector that failed on it, to show what it does there.

class SceneMaker {
 public:
  // `detector` is nothing for a plug-in whose library is not known. If a library is no longer
  // there, the scenes only lack the detector's part.
  explicit SceneMaker(const std::optional<DetectorWords>& detector);

  // The scene of a case, in the configuration that the case's options state (a plug-in has one).
  // Nothing if a coordinate is beyond the detector's contract.
  std::optional<CaseScene> scene_of(const corpus::Case& c, const std::string& configuration);

  // Writes the picture of a case beside its file, as .svg in place of .json. Writes none for a
  // mesh that is too large for a picture, or that has no scene.
  Expected<void> write_picture(const std::string& case_file, const corpus::Case& c,
                               const std::string& configuration, const std::string& title);

 private:
  properties::DetectorUnderTest detector_;
  std::optional<properties::WorkerProcess> worker_;
  std::string absent_;  // why the plug-in is not run
};

// "mesh.svg" for "mesh.json", "mesh.x.svg" for "mesh.x".
std::string picture_file(const std::string& case_file);

// A mesh of more triangles than this is too much for a picture and its reader.
inline constexpr Eigen::Index most_shown_triangles = 2000;

// Draws a failing mesh as a small picture, for those who see only the log.

// SVG 1.1 without script, style sheet or background: an isometric projection of the mesh at the
// time of its contact, seen from the side that shows most of the failing pair. Triangles have the
// colours of their view sets; if the detector shows none, the two of the pair have a colour each,
// and the others are grey. The pair is outlined and numbered, ghosts are dashed, and the contact is
// a disc (exact) and a ring (the detector's): two of these and the segment between them where the
// nearest points are apart. `title` stands below, and the distance where one is asked for.
// O(n log n) in the triangles.
std::string mesh_svg(const CaseScene& scene, const std::string& title);

// The same contact as a strip of three such pictures from one side: where the step begins, where
// the two meet, where it ends. Dashes show the ways of the vertices that move. `title` is told to
// readers who do not see the picture. REQUIRES a step.
std::string strip_svg(const CaseScene& scene, const std::string& title);

}  // namespace assay::reports
