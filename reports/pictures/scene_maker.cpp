#include "reports/pictures/scene_maker.h"

#include "properties/judging/case_check.h"
#include "reports/check/detector_choice.h"
#include "reports/pictures/mesh_svg.h"
#include "reports/terminal/text_file.h"

namespace assay::reports {
namespace {

constexpr double case_seconds = 10;

}  // namespace

SceneMaker::SceneMaker(const std::optional<DetectorWords>& detector)
    : detector_(properties::built_in_detector()) {
  if (!detector) {
    absent_ = "the store does not name the plug-in's library";
    return;
  }
  properties::CampaignRequest request;
  request.worker = properties::worker_program();
  if (auto chosen = choose_detector(*detector, request); !chosen) {
    absent_ = chosen.error().message;
    return;
  }
  detector_ = request.detector;
  worker_.emplace(
      properties::worker_program(), request.plugin,
      properties::WorkerLimits{case_seconds, 0, request.isolation, {}, request.threads});
}

std::optional<CaseScene> SceneMaker::scene_of(const corpus::Case& c,
                                              const std::string& configuration) {
  properties::Configuration chosen{configuration, {}};
  if (const auto options = properties::read_options(c); detector_.built_in && options)
    chosen.options = options.value();
  auto scene = make_scene(c, detector_, chosen, worker_ ? &*worker_ : nullptr);
  if (scene && !absent_.empty()) scene->ended = absent_;
  return scene;
}

Expected<void> SceneMaker::write_picture(const std::string& case_file, const corpus::Case& c,
                                         const std::string& configuration,
                                         const std::string& title) {
  if (c.triangles.rows() > most_shown_triangles) return outcome::success();
  const auto scene = scene_of(c, configuration);
  if (!scene) return outcome::success();
  return write_text_file(picture_file(case_file), mesh_svg(*scene, title));
}

std::string picture_file(const std::string& case_file) {
  constexpr std::string_view json = ".json";
  const bool is_json = case_file.ends_with(json);
  return case_file.substr(0, case_file.size() - (is_json ? json.size() : 0)) + ".svg";
}

}  // namespace assay::reports
