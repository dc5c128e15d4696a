// The scene of a case, to be shown: its steps, the contacts found by the oracle and the detector,
// the places where two triangles meet or are nearest to each other, and view sets. Places are
// computed in plain doubles, and no verdict rests on them.
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

// Returns the closest points, at time t in [0,1] of the step, of the two features of a contact
// (detector/contact_place.h). At a contact the two points coincide up to rounding; if an edge
// pierces a face, they are one point. If the contact names no features (those of a plug-in name
// none), returns the closest points of the two triangles over all pairs of features that share no
// vertex. Returns nothing if all features share a vertex, or if a coordinate overflows.
std::optional<NearestPoints> contact_places(detector::PairContact contact,
                                            const detector::TrianglesView& triangles,
                                            const detector::SteppedMesh& motion, double t);

struct CaseScene;

struct SceneStep {
  corpus::CaseStep span;
  properties::StepTruth truth;                 // under the detector's contract
  std::optional<detector::StepResult> answer;  // the detector's; nothing if its run broke off
  // How truth and answer differ; nothing if the detector did not run.
  std::optional<properties::StepDiff> diff;
  properties::CandidatePairs candidates = {};  // only of a plug-in that returns candidates

  // Returns whether `answer` has view sets to show.
  bool has_views() const { return answer && !answer->doubts.empty(); }
  // Returns in words how claims and contract judge a pair that is in contact or reported. These
  // break a claim: "missing", "late", "early", "spurious", "no candidate", "answered free". All
  // other words break no claim: "agrees", "left out by the contract", "not run", and words that end
  // in "not claimed", such as "later, not claimed".
  std::string difference(const detector::TrianglePair& pair, const CaseScene& scene) const;
};

struct CaseScene {
  corpus::Case c;  // as fitted to the detector's contract
  std::vector<SceneStep> steps;
  std::optional<detector::Surface> surface;    // the mesh and its ghosts; nothing if it was refused
  properties::Claims claims;                   // the claims that are judged under the contract
  properties::Contract contract;               // by which the case is judged
  bool reports_pairs = true;                   // false: the detector reports no pairs
  std::string ending;                          // how the detector's run broke off, if it did
  std::optional<properties::Failure> failure;  // the failure, if the case still fails

  // Return the step and the pair that the picture is about: the step and pair of the failure, or
  // else of the first contact.
  std::size_t shown_step() const;
  std::optional<detector::TrianglePair> shown_pair() const;

  // Returns the distances of the contract, "d 0.01, slack 0.002"; empty if it asks for contact.
  std::string asked_distance() const;
  // Returns where the two sides of a contact are nearest to each other at the time of the contact.
  // The sides of a query are its two features. The sides of a pair of triangles are the features
  // that touch or, if the contract asks for a distance, the two triangles.
  std::optional<NearestPoints> nearest_points(const SceneStep& step,
                                              detector::PairContact contact) const;
};

double middle(const detector::TimeEnclosure& time);

// Makes the scene. `worker` runs the detector; null: the detector is not available. Returns nothing
// if the contract cannot represent a coordinate. Judges exactly, which is slow: meant for shrunk
// cases.
std::optional<CaseScene> make_scene(const corpus::Case& c,
                                    const properties::DetectorUnderTest& detector,
                                    const properties::Configuration& configuration,
                                    properties::WorkerProcess* worker);

// Returns the contact of this pair, or null.
const detector::PairContact* contact_of(const std::vector<detector::PairContact>& contacts,
                                        const std::optional<detector::TrianglePair>& pair);

// The names and colours of view sets in pages and pictures.

// The view set of a triangle over a step. A triangle in doubt is `dirty` or `violated` whatever its
// sign is, as in the search for pairs.
enum class ViewSet : std::uint8_t { none, positive, negative, zero, dirty, violated };

// Names and colours in the order of ViewSet. The colours are mid-tones, for light and for dark
// backgrounds. People with any kind of colour vision can tell them apart (Okabe and Ito).
inline constexpr std::array<const char*, 6> view_set_names = {"none", "V+",    "V-",
                                                              "V0",   "dirty", "violated"};
inline constexpr std::array<const char*, 6> view_set_colours = {"#9aa0a6", "#56b4e9", "#e69f00",
                                                                "#f0e442", "#cc79a7", "#d55e00"};

// Returns the view set of a triangle; ViewSet::none if the step has no view sets. A triangle that
// is both touched by a ghost and dirty counts as violated.
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

// Runs a stored case through the detector that failed on it, to show the detector's answers.

class SceneMaker {
 public:
  // Opens the detector and its worker process. `detector` is nullopt for a plug-in whose library is
  // not known. If the library is not known or no longer exists, the scenes have everything except
  // the detector's answers.
  explicit SceneMaker(const std::optional<DetectorWords>& detector);

  // Returns the scene of a case. The built-in detector runs with the options that the case states;
  // `configuration` is the name of the configuration that failed. Returns nothing if a coordinate
  // is beyond the detector's contract.
  std::optional<CaseScene> scene_of(const corpus::Case& c, const std::string& configuration);

  // Writes the picture of a case beside its file, as .svg in place of .json. Writes no picture if
  // the mesh is too large for a picture, or if the case has no scene.
  Expected<void> write_picture(const std::string& case_file, const corpus::Case& c,
                               const std::string& configuration, const std::string& title);

 private:
  properties::DetectorUnderTest detector_;
  std::optional<properties::WorkerProcess> worker_;
  std::string absent_;  // why the plug-in is not run
};

// Returns "mesh.svg" for "mesh.json", "mesh.x.svg" for "mesh.x".
std::string picture_file(const std::string& case_file);

// A mesh with more triangles than this is not drawn, because a reader would see nothing in it.
inline constexpr Eigen::Index most_shown_triangles = 2000;

// Draws a failing mesh as a small picture, for readers who have only the log.

// Returns SVG 1.1 without script, style sheet or background: an isometric projection of the mesh at
// the time of its contact, seen from the side that shows most of the failing pair. Triangles have
// the colours of their view sets; if the detector shows no view sets, the two triangles of the pair
// have a colour each, and the other triangles are grey. The pair is outlined and numbered, and
// ghosts are dashed. A disc marks the exact contact, and a ring the detector's contact. If the
// nearest points are apart, each of them has its own mark, with a segment between them. `title` is
// written below the mesh, and so is the distance if the contract asks for a distance. O(n log n) in
// the triangles.
std::string mesh_svg(const CaseScene& scene, const std::string& title);

// Returns three pictures like that of mesh_svg in a row, all seen from the same side: at the start
// of the step, at the contact, and at the end of the step. Dashes show the paths of the vertices
// that move. `title` is read to people who do not see the picture. REQUIRES a step.
std::string strip_svg(const CaseScene& scene, const std::string& title);

}  // namespace assay::reports
