#include "corpus/case_file.h"

#include <algorithm>
#include <boost/outcome/try.hpp>

#include "corpus/atomic_file.h"
#include "corpus/file_bytes.h"

namespace assay::corpus {

std::optional<detector::ViewPrimitive> view_of_step(const Case& c, std::size_t step) {
  if (!c.view || step + 1 >= c.view->q0.size()) return std::nullopt;
  const detector::MovingPoint q0 = {c.view->q0[step], c.view->q0[step + 1]};
  if (c.view->q1.empty()) return detector::ViewPrimitive{q0, q0};
  return detector::ViewPrimitive{q0, {c.view->q1[step], c.view->q1[step + 1]}};
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
