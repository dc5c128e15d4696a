#include "corpus/problem.h"

#include <utility>

namespace assay::corpus {

std::string_view name_of(FileProblem kind) {
  switch (kind) {
    case FileProblem::cannot_open:
      return "cannot_open";
    case FileProblem::is_directory:
      return "is_directory";
    case FileProblem::permission_denied:
      return "permission_denied";
    case FileProblem::empty_file:
      return "empty_file";
    case FileProblem::unknown_format:
      return "unknown_format";
    case FileProblem::malformed:
      return "malformed";
    case FileProblem::truncated:
      return "truncated";
    case FileProblem::corrupt_gzip:
      return "corrupt_gzip";
    case FileProblem::vertex_counts_differ:
      return "vertex_counts_differ";
    case FileProblem::triangles_differ:
      return "triangles_differ";
    case FileProblem::index_out_of_range:
      return "index_out_of_range";
    case FileProblem::repeated_index:
      return "repeated_index";
    case FileProblem::non_finite_coordinate:
      return "non_finite_coordinate";
    case FileProblem::no_triangles:
      return "no_triangles";
    case FileProblem::wrong_schema:
      return "wrong_schema";
    case FileProblem::missing_field:
      return "missing_field";
    case FileProblem::wrong_type:
      return "wrong_type";
    case FileProblem::cannot_write:
      return "cannot_write";
    case FileProblem::too_large:
      return "too_large";
    case FileProblem::wrong_row_count:
      return "wrong_row_count";
    case FileProblem::wrong_column_count:
      return "wrong_column_count";
    case FileProblem::not_a_double:
      return "not_a_double";
    case FileProblem::zero_denominator:
      return "zero_denominator";
    case FileProblem::labels_differ:
      return "labels_differ";
    case FileProblem::truth_count_differs:
      return "truth_count_differs";
    case FileProblem::unknown_query_kind:
      return "unknown_query_kind";
    case FileProblem::unknown_scene:
      return "unknown_scene";
    case FileProblem::wrong_scene_option:
      return "wrong_scene_option";
    case FileProblem::no_frames:
      return "no_frames";
  }
  return "unnamed";
}

Problem problem_in(FileProblem kind, const std::filesystem::path& file, std::string_view detail) {
  std::string message = file.string();
  if (!message.empty()) message += ": ";
  message += detail;
  for (char& c : message) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  }
  return {kind, std::move(message)};
}

}  // namespace assay::corpus
