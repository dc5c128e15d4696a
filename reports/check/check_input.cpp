#include "reports/check/check_input.h"

#include <filesystem>

#include "corpus/formats/mesh_reader.h"

namespace assay::reports {

corpus::Expected<CheckInput> read_check_input(const std::vector<std::string>& files) {
  CheckInput input;
  input.file = files[0];
  if (files.size() == 1 && std::filesystem::path(files[0]).extension() == ".json") {
    auto c = corpus::read_case(files[0]);
    if (!c) return c.error();
    if (const auto options = properties::read_options(c.value()); !options) {
      return corpus::problem_in(corpus::FileProblem::wrong_type, files[0], options.error().message);
    }
    input.c = std::move(c.value());
    input.is_case_file = true;
  } else {
    const std::vector<std::filesystem::path> paths(files.begin(), files.end());
    auto sequence = corpus::read_sequence(paths);
    if (!sequence) return sequence.error();
    input.c.triangles = std::move(sequence.value().triangles);
    input.c.frames = std::move(sequence.value().frames);
  }
  if (input.c.frames.size() < 2) {
    return corpus::problem_in(corpus::FileProblem::no_frames, {},
                              "one frame only: a step needs two frames or more");
  }
  return input;
}

}  // namespace assay::reports
