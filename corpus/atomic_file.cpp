#include "corpus/atomic_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>

namespace assay::corpus {
namespace {

Problem refused(const std::filesystem::path& path, int error) {
  return problem_in(FileProblem::cannot_write, path,
                    fmt::format("cannot be written: {}", std::strerror(error)));
}

// Unique among the threads and processes that may write to one folder at the same time.
std::filesystem::path beside(const std::filesystem::path& path) {
  static std::atomic<unsigned> count{0};
  std::filesystem::path name = path;
  name += fmt::format(".{}.{}.part", getpid(), count.fetch_add(1));
  return name;
}

// 0, or the error number of the first call that failed.
int write_whole(const std::filesystem::path& path, std::string_view bytes) {
  std::FILE* file = std::fopen(path.c_str(), "wb");
  if (file == nullptr) return errno;
  int error = 0;
  if (std::fwrite(bytes.data(), 1, bytes.size(), file) != bytes.size()) error = errno;
  // A full disk may show only here.
  if (std::fflush(file) != 0 && error == 0) error = errno;
  if (std::fclose(file) != 0 && error == 0) error = errno;
  return error;
}

}  // namespace

Expected<void> write_file_atomically(const std::filesystem::path& path, std::string_view bytes) {
  const std::filesystem::path part = beside(path);
  int error = write_whole(part, bytes);
  if (error == 0 && std::rename(part.c_str(), path.c_str()) != 0) error = errno;
  if (error != 0) {
    std::remove(part.c_str());
    return refused(path, error);
  }
  return boost::outcome_v2::success();
}

}  // namespace assay::corpus
