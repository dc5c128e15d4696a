#include "reports/terminal/shipped.h"

#include <fmt/format.h>

#include <cstdlib>

#include "properties/worker/worker_process.h"

namespace assay::reports {

Expected<std::filesystem::path> shipped_corpus() {
  namespace fs = std::filesystem;
  std::error_code error;
  const auto is_corpus = [&](const fs::path& folder) {
    return fs::is_directory(folder / "curated", error);
  };
  if (const char* named = std::getenv("ASSAY_CORPUS"); named && *named) {
    if (is_corpus(named)) return fs::path(named);
    return Problem{fmt::format("ASSAY_CORPUS is {}: it holds no curated/", named)};
  }
  const auto programs = properties::program_folder();
  // Installed, then as it was built.
  for (const auto& place : {programs / ".." / "share", programs / "share"}) {
    const auto folder = (place / "assay" / "corpus").lexically_normal();
    if (is_corpus(folder)) return folder;
  }
  return Problem{fmt::format("the shipped corpus is not at {}; ASSAY_CORPUS names its folder",
                             (programs / "../share/assay/corpus").lexically_normal().string())};
}

}  // namespace assay::reports
