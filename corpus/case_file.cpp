#include "corpus/case_file.h"

#include <algorithm>
#include <boost/outcome/try.hpp>

#include "corpus/atomic_file.h"
#include "corpus/file_bytes.h"

namespace assay::corpus {

std::vector<CaseStep> consecutive_steps(std::size_t frames) {
  std::vector<CaseStep> steps;
  for (std::size_t f = 1; f < frames; ++f) {
    const auto to = static_cast<std::int32_t>(f);
    steps.push_back({to - 1, to, true});
  }
  return steps;
}

std::vector<CaseStep> steps_of(const Case& c) {
  return c.script.empty() ? consecutive_steps(c.frames.size()) : c.script;
}

std::optional<detector::ViewPrimitive> view_of_step(const Case& c, std::size_t step) {
  const auto steps = steps_of(c);
  if (!c.view || step >= steps.size()) return std::nullopt;
  const auto moving = [&](const std::vector<detector::Point>& places) {
    return detector::MovingPoint{places[static_cast<std::size_t>(steps[step].from)],
                                 places[static_cast<std::size_t>(steps[step].to)]};
  };
  const detector::MovingPoint q0 = moving(c.view->q0);
  return detector::ViewPrimitive{q0, c.view->q1.empty() ? q0 : moving(c.view->q1)};
}

Expected<Case> read_case(const std::filesystem::path& path) {
  BOOST_OUTCOME_TRY(bytes, read_bytes(path));
  return parse_case(bytes, path.string());
}

Expected<void> write_case(const std::filesystem::path& path, const Case& c) {
  const std::string text = case_text(c);
  // A case that cannot be replayed must be noticed now.
  BOOST_OUTCOME_TRY(parse_case(text, path.string()));
  return write_file_atomically(path, text);
}

Expected<std::vector<std::filesystem::path>> case_files(const std::filesystem::path& folder) {
  std::error_code error;
  std::vector<std::filesystem::path> paths;
  std::filesystem::directory_iterator file(folder, error);
  for (const std::filesystem::directory_iterator end; !error && file != end;
       file.increment(error)) {
    if (file->path().extension() == ".json") paths.push_back(file->path());
  }
  if (error) return problem_in(FileProblem::cannot_open, folder, error.message());
  std::sort(paths.begin(), paths.end());
  return paths;
}

}  // namespace assay::corpus
