#include "corpus/file_bytes.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <boost/outcome/try.hpp>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <new>

namespace assay::corpus {
namespace {

constexpr std::size_t chunk = std::size_t{1} << 18;

struct EndInflate {
  void operator()(z_stream* stream) const { inflateEnd(stream); }
};

Problem too_large(const std::filesystem::path& path, std::size_t limit) {
  return problem_in(FileProblem::too_large, path,
                    fmt::format("larger than the {} bytes that are read", limit));
}

Problem open_problem(const std::filesystem::path& path, int error) {
  const FileProblem kind = error == EACCES || error == EPERM ? FileProblem::permission_denied
                           : error == EISDIR                 ? FileProblem::is_directory
                                                             : FileProblem::cannot_open;
  return problem_in(kind, path, fmt::format("cannot be read: {}", std::strerror(error)));
}

Expected<std::string> read_raw(const std::filesystem::path& path, std::size_t limit) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) return open_problem(path, EISDIR);
  // A pipe or a device may never end.
  if (std::filesystem::exists(path, ignored) && !std::filesystem::is_regular_file(path, ignored)) {
    return problem_in(FileProblem::cannot_open, path, "is not a regular file");
  }
  const OpenFile file(std::fopen(path.c_str(), "rb"));
  if (!file) return open_problem(path, errno);
  std::string bytes;
  const auto buffer = std::make_unique<std::array<char, chunk>>();
  while (const std::size_t count = std::fread(buffer->data(), 1, chunk, file.get())) {
    if (count > limit - bytes.size()) return too_large(path, limit);
    bytes.append(buffer->data(), count);
  }
  if (std::ferror(file.get())) return open_problem(path, errno);
  return bytes;
}

bool is_gzip(const std::string& bytes) {
  return bytes.size() >= 2 && bytes[0] == '\x1f' && bytes[1] == '\x8b';
}

Problem corrupt(const std::filesystem::path& path, const char* how, std::size_t offset) {
  return problem_in(FileProblem::corrupt_gzip, path,
                    fmt::format("the gzip stream {} (compressed byte {})", how, offset));
}

// A gzip file is one or more members one after another; all are decompressed.
Expected<std::string> inflate_all(const std::filesystem::path& path, std::string& packed,
                                  std::size_t limit) {
  z_stream stream{};
  constexpr int gzip_window = 15 + 16;
  if (inflateInit2(&stream, gzip_window) != Z_OK) return too_large(path, limit);
  const std::unique_ptr<z_stream, EndInflate> guard(&stream);
  std::string plain;
  const auto buffer = std::make_unique<std::array<char, chunk>>();
  std::size_t offset = 0;
  bool member_ended = false;
  while (true) {
    if (stream.avail_in == 0 && offset < packed.size()) {
      const std::size_t next = std::min(chunk, packed.size() - offset);
      stream.next_in = reinterpret_cast<Bytef*>(packed.data() + offset);
      stream.avail_in = static_cast<uInt>(next);
      offset += next;
    }
    if (member_ended && stream.avail_in == 0) return plain;
    if (member_ended && inflateReset(&stream) != Z_OK) return corrupt(path, "is damaged", offset);
    stream.next_out = reinterpret_cast<Bytef*>(buffer->data());
    stream.avail_out = static_cast<uInt>(chunk);
    const int state = inflate(&stream, Z_NO_FLUSH);
    const std::size_t produced = chunk - stream.avail_out;
    if (produced > limit - plain.size()) return too_large(path, limit);
    plain.append(buffer->data(), produced);
    member_ended = state == Z_STREAM_END;
    const std::size_t place = offset - stream.avail_in;
    if (state == Z_BUF_ERROR) return corrupt(path, "is cut off", place);
    if (state != Z_OK && !member_ended) return corrupt(path, "is damaged", place);
  }
}

}  // namespace

Expected<std::string> read_bytes(const std::filesystem::path& path, std::size_t limit) try {
  BOOST_OUTCOME_TRY(bytes, read_raw(path, limit));
  if (is_gzip(bytes)) {
    BOOST_OUTCOME_TRY(plain, inflate_all(path, bytes, limit));
    bytes = std::move(plain);
  } else if (path.extension() == ".gz" && !bytes.empty()) {
    return corrupt(path, "has no gzip signature", 0);
  }
  if (bytes.empty()) {
    return problem_in(FileProblem::empty_file, path, "the file is empty");
  }
  return std::move(bytes);
} catch (const std::bad_alloc&) {
  return problem_in(FileProblem::too_large, path, "larger than the memory at hand");
}

}  // namespace assay::corpus
