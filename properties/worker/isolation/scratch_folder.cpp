#include "properties/worker/isolation/scratch_folder.h"

#include <fmt/format.h>
#include <stdlib.h>

#include <cerrno>
#include <cstring>
#include <system_error>

namespace assay::properties {

Expected<ScratchFolder> ScratchFolder::make() {
  std::error_code error;
  const auto parent = std::filesystem::temp_directory_path(error);
  std::string name = (parent / "assay-scratch-XXXXXX").string();
  if (error || !::mkdtemp(name.data())) {
    const std::string reason = error ? error.message() : std::strerror(errno);
    return Problem{
        ProblemKind::cannot_write,
        fmt::format("{}: no folder can be made for temporary files: {}", parent.string(), reason)};
  }
  return ScratchFolder(name);
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
}

}  // namespace assay::properties
