// Options of `bench` and `scene`.
#include <cstdlib>

#include "reports/verbs/option_words.h"
#include "reports/verbs/verb_options.h"

namespace assay::reports {

void add_scene(CLI::App& app, SceneRequest& request) {
  auto* verb = app.add_subcommand("scene", "Write the frames of a kinematic scene");
  verb->add_option("name", request.name, "One of `assay list scenes`")->required();
  verb->add_option("--mesh", request.mesh_file, "Deform this mesh instead of the scene's own");
  verb->add_option("--size", request.size, "Triangles wanted")->check(positive());
  verb->add_option("--frames", request.frames, "Frames")->check(positive());
  verb->add_option("--out", request.out, "Folder for frame_0000.ply, ...")->required();
}

void add_bench(CLI::App& app, BenchRequest& request) {
  const char* data = std::getenv("ASSAY_DATA");
  request.data = data && *data ? data : "../shared/data";
  auto* verb = app.add_subcommand("bench", "Speeds and memory beside what is wanted");
  verb->add_option("--suite", request.suite, "What to measure")
      ->check(one_of("elementary, view, growth, claims, stability, speed-error, harness",
                     is_bench_suite))
      ->required();
  verb->add_option("--data", request.data,
                   "Folder of the public data (default $ASSAY_DATA, else ../shared/data); rows of "
                   "what is not there say so");
  verb->add_option("--json", request.json_file, "Write all figures here (assay-bench/1)");
  verb->add_option("--csv", request.csv_file, "Write the raw samples here");
  verb->add_option(
      "--svg", request.svg_file,
      "Draw the suite's picture here (growth, claims, stability, speed-error; needs gnuplot)");
}

}  // namespace assay::reports
