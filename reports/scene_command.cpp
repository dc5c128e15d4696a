// `assay scene` and `assay list scenes`.
#include <fmt/format.h>

#include "corpus/mesh_writer.h"
#include "corpus/scenes.h"
#include "reports/commands.h"
#include "reports/exit_code.h"

namespace assay::reports {
namespace {

int refuse(const corpus::Problem& problem) {
  fmt::print(stderr, "assay: {}\n", problem.message);
  return exit_usage;
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
    auto mesh = corpus::read_mesh(request.mesh_file);
    if (!mesh) return refuse(mesh.error());
    options.mesh = std::move(mesh.value());
  }
  auto sequence = corpus::make_scene(request.name, options);
  if (!sequence) return refuse(sequence.error());
  auto written = corpus::write_sequence(request.out, sequence.value());
  if (!written) return refuse(written.error());
  fmt::print("{}: {} frames of {} triangles, {} vertices, in {}\n", request.name,
             sequence.value().frames.size(), sequence.value().triangles.rows(),
             sequence.value().frames[0].rows(), request.out);
  fmt::print("next: assay check {}/frame_*.ply\n", request.out);
  return exit_holds;
}

}  // namespace assay::reports
