// The failures of a stored run, each signature with one mesh that is run again to be shown.
#pragma once

#include <optional>
#include <string>

#include "reports/page_data/run_folder.h"
#include "reports/picture/case_scene.h"

namespace assay::reports {

// Runs stored cases through the detector of a run: the built-in one, or the plug-in where its
// library still is.
class SceneMaker {
 public:
  // detector.name empty: the built-in.
  explicit SceneMaker(const DetectorNote& detector);

  // In the configuration that the case's options state (a plug-in has one).
  std::optional<CaseScene> scene_of(const corpus::Case& c, const std::string& configuration);

  // Why the plug-in is not run, or empty.
  const std::string& absent() const { return absent_; }

 private:
  properties::DetectorUnderTest detector_;
  properties::WorkerProcess reference_;
  std::optional<properties::WorkerProcess> worker_;
  std::string absent_;
};

// `failures` of assay-report/1: one entry a signature, its smallest mesh with scene and picture.
nlohmann::ordered_json failures_json(const StoredRun& run);

}  // namespace assay::reports
