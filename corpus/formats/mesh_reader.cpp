#include "corpus/formats/mesh_reader.h"

#include <algorithm>
#include <boost/outcome/try.hpp>
#include <cctype>
#include <new>
#include <string>

#include "corpus/file_bytes.h"
#include "corpus/formats/ply_header.h"

namespace assay::corpus {
namespace {

// The extension without .gz, in lower case: ".obj" for SHELL.OBJ.gz.
std::string mesh_extension(std::filesystem::path path) {
  const auto lower = [](std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
  };
  if (lower(path.extension().string()) == ".gz") path.replace_extension();
  return lower(path.extension().string());
}

enum class Format { ply, off, obj };

// The format is told from this many bytes at the start, and the name.
constexpr std::size_t format_bytes = 4096;

Expected<Format> format_of(std::string_view bytes, const std::filesystem::path& path) {
  if (looks_like_ply(bytes)) return Format::ply;
  if (looks_like_off(bytes)) return Format::off;
  if (mesh_extension(path) == ".obj") return Format::obj;
  return problem_in(path, "neither PLY nor OFF by its first line, nor .obj by its name");
}

Expected<Mesh> parse_mesh(std::string_view bytes, const std::filesystem::path& path) {
  BOOST_OUTCOME_TRY(format, format_of(bytes.substr(0, format_bytes), path));
  switch (format) {
    case Format::ply:
      return read_ply(bytes, path);
    case Format::off:
      return read_off(bytes, path);
    case Format::obj:
      break;
  }
  return read_obj(bytes, path);
}

}  // namespace

Expected<Mesh> read_mesh(const std::filesystem::path& path) try {
  BOOST_OUTCOME_TRY(bytes, read_bytes(path));
  return parse_mesh(bytes, path);
} catch (const std::bad_alloc&) {
  return problem_in(path, "larger than the memory at hand");
}

Expected<void> look_at_mesh(const std::filesystem::path& path) {
  BOOST_OUTCOME_TRY(start, read_start(path, format_bytes));
  if (start.empty()) return boost::outcome_v2::success();
  BOOST_OUTCOME_TRYV(format_of(start, path));
  return boost::outcome_v2::success();
}

}  // namespace assay::corpus
