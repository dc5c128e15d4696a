// `assay scene` and `assay list scenes`.
#include <fmt/format.h>

#include <filesystem>

#include "corpus/formats/mesh_writer.h"
#include "corpus/scenes/scenes.h"
#include "reports/terminal/complaint.h"
#include "reports/verbs/commands.h"

namespace assay::reports {
namespace {

int refuse(const corpus::Problem& problem) { return reports::refuse(problem.message); }

// Frames of an earlier run with more of them would be taken for steps of this one.
std::optional<std::string> stale_frame(const std::string& folder, std::size_t frames) {
  const auto next = std::filesystem::path(folder) / fmt::format("frame_{:04}.ply", frames);
  std::error_code ignored;
  if (!std::filesystem::exists(next, ignored)) return std::nullopt;
  return fmt::format(
      "{} holds more frames of an earlier run ({}): remove them or choose another folder", folder,
      next.filename().string());
}

}  // namespace

int run_list_scenes() {
  fmt::print("{:<20} {:>9} {:>7}  {:<6} {:<6} {}\n", "scene", "triangles", "frames", "closed",
             "--mesh", "what it is");
  for (const auto& scene : corpus::scenes()) {
    fmt::print("{:<20} {:>9} {:>7}  {:<6} {:<6} {}\n", scene.name, scene.default_size,
               scene.default_frames, scene.closed ? "yes" : "no", scene.takes_mesh ? "yes" : "no",
               scene.about);
  }
  return exit_holds;
}

int run_scene(const SceneRequest& request) {
  corpus::SceneOptions options;
  options.size = request.size;
  options.frames = request.frames;
  if (!request.mesh_file.empty()) {
    if (request.size > 0) return reports::refuse("--size has no meaning with --mesh");
    auto mesh = corpus::read_mesh(request.mesh_file);
    if (!mesh) return refuse(mesh.error());
    options.mesh = std::move(mesh.value());
  }
  auto sequence = corpus::make_scene(request.name, options);
  if (!sequence) return refuse(sequence.error());
  if (auto stale = stale_frame(request.out, sequence.value().frames.size())) {
    return reports::refuse(*stale);
  }
  auto written = corpus::write_sequence(request.out, sequence.value());
  if (!written) return refuse(written.error());
  fmt::print("{}: {} frame(s) of {} triangles, {} vertices, in {}\n", request.name,
             sequence.value().frames.size(), sequence.value().triangles.rows(),
             sequence.value().frames[0].rows(), request.out);
  if (sequence.value().frames.size() > 1) {
    fmt::print("next: assay check {}/frame_*.ply\n", request.out);
  }
  return exit_holds;
}

}  // namespace assay::reports
