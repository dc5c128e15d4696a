// Runs a stored case through the detector that failed on it, to show what it does there.
#pragma once

#include <optional>
#include <string>

#include "reports/pictures/case_scene.h"
#include "reports/terminal/complaint.h"
#include "reports/terminal/option_words.h"

namespace assay::reports {

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

}  // namespace assay::reports
