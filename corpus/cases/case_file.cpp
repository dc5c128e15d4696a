#include "corpus/cases/case_file.h"

#include <algorithm>
#include <boost/outcome/try.hpp>

#include "corpus/atomic_file.h"
#include "corpus/file_bytes.h"

namespace assay::corpus {

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
  if (error) return problem_in(folder, error.message());
  std::sort(paths.begin(), paths.end());
  return paths;
}

}  // namespace assay::corpus
