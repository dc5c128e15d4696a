// `assay scene` writes the frames of a kinematic scene.
#include <fmt/format.h>

#include <filesystem>

#include "corpus/formats/sequences.h"
#include "corpus/problem.h"
#include "corpus/scenes/scenes.h"
#include "reports/terminal/words.h"
#include "reports/terminal/work.h"
#include "reports/verbs/verbs.h"

namespace assay::reports {
namespace {

struct SceneRequest {
  std::string name;
  std::string mesh_file;  // empty: the shape of the scene itself
  int size = 0, frames = 0;
  std::string out;
};

// Finds a frame that an earlier run with more frames left in the folder, because it would be taken
// for a step of this scene.
std::optional<std::string> stale_frame(const std::string& folder, std::size_t frames) {
  const auto next = std::filesystem::path(folder) / fmt::format("frame_{:04}.ply", frames);
  std::error_code ignored;
  if (!std::filesystem::exists(next, ignored)) return std::nullopt;
  return fmt::format(
      "{} holds more frames of an earlier run ({}): remove them or choose another folder", folder,
      next.filename().string());
}

Expected<int> run_scene(const SceneRequest& request) {
  corpus::SceneOptions options;
  options.size = request.size;
  options.frames = request.frames;
  if (!request.mesh_file.empty()) {
    if (request.size > 0) return Problem{"--size has no meaning with --mesh"};
    BOOST_OUTCOME_TRY(mesh, corpus::read_mesh(request.mesh_file));
    for (const auto& line : mesh.remarks) fmt::print("{}\n", line);
    options.mesh = std::move(mesh);
  }
  BOOST_OUTCOME_TRY(sequence, corpus::make_scene(request.name, options));
  BOOST_OUTCOME_TRY(may_fill(request.out));
  if (auto stale = stale_frame(request.out, sequence.frames.size())) {
    return Problem{*stale};
  }
  BOOST_OUTCOME_TRY(corpus::write_sequence(request.out, sequence));
  fmt::print("{}: {} frame(s) of {} triangles, {} vertices, in {}\n", request.name,
             sequence.frames.size(), sequence.triangles.rows(), sequence.frames[0].rows(),
             request.out);
  if (sequence.frames.size() > 1) {
    fmt::print("next: {}\n", line_to_paste("check " + shell_word(request.out) + "/frame_*.ply",
                                           PastePlace::this_folder));
  }
  return exit_holds;
}

void add_options(CLI::App& verb, SceneRequest& request) {
  add(verb, "SCENE", request.name,
      "One of `assay list scenes`: " + join(corpus::names_among(corpus::scenes()), ", "))
      ->required();
  add(verb, "--mesh FILE", request.mesh_file, "Deform this mesh instead of the scene's own mesh");
  add(verb, "--size N", request.size, "Triangles wanted")->check(in_range(1, 1'000'000'000));
  add(verb, "--frames N", request.frames, "Number of frames")->check(in_range(1, 1'000'000'000));
  add(verb, "--out DIR", request.out, "Folder for frame_0000.ply, ...")
      ->required()
      ->group(OptionGroup::output);
}

}  // namespace

VerbAction add_scene(CLI::App& app) {
  return make_verb(app, "scene", "Write the frames of a kinematic scene", add_options, run_scene);
}

}  // namespace assay::reports
