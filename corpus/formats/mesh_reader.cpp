#include "corpus/formats/mesh_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/outcome/try.hpp>
#include <cctype>
#include <new>
#include <string>
#include <utility>

#include "corpus/file_bytes.h"
#include "corpus/formats/obj_reader.h"
#include "corpus/formats/off_reader.h"
#include "corpus/formats/ply_header.h"
#include "corpus/formats/ply_reader.h"

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

Expected<Mesh> parse_mesh(std::string_view bytes, const std::filesystem::path& path) {
  if (looks_like_ply(bytes)) return read_ply(bytes, path);
  if (looks_like_off(bytes)) return read_off(bytes, path);
  if (mesh_extension(path) == ".obj") return read_obj(bytes, path);
  return problem_in(FileProblem::unknown_format, path,
                    "neither PLY nor OFF by its first line, nor .obj by its name");
}

bool same(const detector::Triangles& a, const detector::Triangles& b) {
  return a.rows() == b.rows() && a == b;
}

}  // namespace

Expected<Mesh> read_mesh(const std::filesystem::path& path) try {
  BOOST_OUTCOME_TRY(bytes, read_bytes(path));
  return parse_mesh(bytes, path);
} catch (const std::bad_alloc&) {
  return problem_in(FileProblem::too_large, path, "larger than the memory at hand");
}

Expected<Sequence> read_sequence(std::span<const std::filesystem::path> paths) {
  if (paths.empty()) return problem_in(FileProblem::no_frames, {}, "no mesh file is given");
  BOOST_OUTCOME_TRY(first, read_mesh(paths[0]));
  Sequence sequence{std::move(first.triangles), {}};
  sequence.frames.push_back(std::move(first.positions));
  for (const std::filesystem::path& path : paths.subspan(1)) {
    BOOST_OUTCOME_TRY(mesh, read_mesh(path));
    const auto vertices = sequence.frames[0].rows();
    if (mesh.positions.rows() != vertices) {
      return problem_in(FileProblem::vertex_counts_differ, path,
                        fmt::format("{} vertices, but {} has {}", mesh.positions.rows(),
                                    paths[0].string(), vertices));
    }
    if (!same(mesh.triangles, sequence.triangles)) {
      return problem_in(FileProblem::triangles_differ, path,
                        fmt::format("its {} triangles are not the {} of {}", mesh.triangles.rows(),
                                    sequence.triangles.rows(), paths[0].string()));
    }
    sequence.frames.push_back(std::move(mesh.positions));
  }
  return sequence;
}

}  // namespace assay::corpus
