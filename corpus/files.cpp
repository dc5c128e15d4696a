#include "corpus/files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <boost/outcome/try.hpp>
#include <cerrno>
#include <cstring>
#include <new>
#include <utility>

namespace assay::corpus {

namespace {

constexpr std::size_t chunk = std::size_t{1} << 18;

struct EndInflate {
  void operator()(z_stream* stream) const { inflateEnd(stream); }
};

Problem too_large(const std::filesystem::path& path, std::size_t limit) {
  return problem_in(path, fmt::format("larger than {} bytes, the limit for a file", limit));
}

Problem no_memory(const std::filesystem::path& path) {
  return problem_in(path, "larger than the memory at hand");
}

Problem open_problem(const std::filesystem::path& path, int error) {
  return problem_in(path, fmt::format("cannot be read: {}", std::strerror(error)));
}

Expected<OpenFile> open_to_read(const std::filesystem::path& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) return open_problem(path, EISDIR);
  // A pipe or a device may never end.
  if (std::filesystem::exists(path, ignored) && !std::filesystem::is_regular_file(path, ignored)) {
    return problem_in(path, "is not a regular file");
  }
  OpenFile file(std::fopen(path.c_str(), "rb"));
  if (!file) return open_problem(path, errno);
  return file;
}

Expected<std::string> read_raw(const std::filesystem::path& path, std::size_t limit) {
  BOOST_OUTCOME_TRY(file, open_to_read(path));
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
  return problem_in(path, fmt::format("the gzip stream {} (at its byte {})", how, offset));
}

Problem empty(const std::filesystem::path& path) { return problem_in(path, "the file is empty"); }

// Returns the problem of a file that is named like a gzip stream but is none.
Problem no_gzip(const std::filesystem::path& path) {
  return corrupt(path, "has no gzip signature", 0);
}

// Decompresses the members of a gzip file, one after another: all, or as many as it takes to have
// `enough` bytes.
Expected<std::string> inflate_all(const std::filesystem::path& path, std::string& packed,
                                  std::size_t limit, std::size_t enough = std::string::npos) {
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
    if (plain.size() >= enough) return plain;
    member_ended = state == Z_STREAM_END;
    const std::size_t place = offset - stream.avail_in;
    if (state == Z_BUF_ERROR) return corrupt(path, "is cut off", place);
    if (state != Z_OK && !member_ended) return corrupt(path, "is damaged", place);
  }
}

// Reads at most `count` bytes more.
Expected<void> append(const std::filesystem::path& path, const OpenFile& file, std::size_t count,
                      std::string& bytes) {
  const std::size_t before = bytes.size();
  bytes.resize(before + count);
  bytes.resize(before + std::fread(bytes.data() + before, 1, count, file.get()));
  if (std::ferror(file.get())) return open_problem(path, errno);
  return boost::outcome_v2::success();
}

}  // namespace

Expected<std::string> read_bytes(const std::filesystem::path& path, std::size_t limit) try {
  BOOST_OUTCOME_TRY(bytes, read_raw(path, limit));
  if (is_gzip(bytes)) {
    BOOST_OUTCOME_TRY(plain, inflate_all(path, bytes, limit));
    bytes = std::move(plain);
  } else if (path.extension() == ".gz" && !bytes.empty()) {
    return no_gzip(path);
  }
  if (bytes.empty()) return empty(path);
  return std::move(bytes);
} catch (const std::bad_alloc&) {
  return no_memory(path);
}

Expected<std::string> read_start(const std::filesystem::path& path, std::size_t count) try {
  BOOST_OUTCOME_TRY(file, open_to_read(path));
  std::string bytes;
  BOOST_OUTCOME_TRYV(append(path, file, count, bytes));
  if (bytes.empty()) return empty(path);
  if (!is_gzip(bytes)) {
    if (path.extension() == ".gz") return no_gzip(path);
    return bytes;
  }
  BOOST_OUTCOME_TRYV(append(path, file, chunk, bytes));
  const bool is_whole = std::feof(file.get()) != 0;
  auto plain = inflate_all(path, bytes, largest_file, count);
  if (!is_whole && (!plain || plain.value().size() < count)) return std::string();
  if (!plain) return plain.error();
  if (plain.value().empty()) return empty(path);
  plain.value().resize(std::min(plain.value().size(), count));
  return plain;
} catch (const std::bad_alloc&) {
  return no_memory(path);
}

Expected<void> write_file_atomically(const std::filesystem::path& path, std::string_view bytes) {
  const std::string name = path.string() + ".part";
  const auto failed = [&] {
    return problem_in(path, fmt::format("cannot be written: {}", std::strerror(errno)));
  };
  OpenFile part;
  int file = -1;
  struct stat opened = {}, there = {};
  do {
    file = ::open(name.c_str(), O_WRONLY | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0666);
    part.reset(file < 0 ? nullptr : ::fdopen(file, "w"));
    if (!part) return failed();
    // Waits for another writer. The lock ends with its process, so the part that a killed writer
    // left is taken.
    while (::flock(file, LOCK_EX) != 0) {
      if (errno != EINTR) return failed();
    }
    if (::fstat(file, &opened) != 0) return failed();
    // The other writer may have renamed or removed the part that was opened here.
  } while (::stat(name.c_str(), &there) != 0 || opened.st_ino != there.st_ino ||
           opened.st_dev != there.st_dev);
  // A full disk may show only when a file is closed. This one stays open for its lock, so a
  // duplicate is closed.
  const bool is_whole = ::ftruncate(file, 0) == 0 &&
                        std::fwrite(bytes.data(), 1, bytes.size(), part.get()) == bytes.size() &&
                        std::fflush(part.get()) == 0 &&
                        ::close(::fcntl(file, F_DUPFD_CLOEXEC, 0)) == 0;
  if (is_whole && std::rename(name.c_str(), path.c_str()) == 0) return boost::outcome_v2::success();
  const auto problem = failed();
  ::unlink(name.c_str());
  return problem;
}

}  // namespace assay::corpus
