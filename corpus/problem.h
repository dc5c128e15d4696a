// What may be wrong with a file or a request, as a value. No exception leaves this room.
#pragma once

#include <boost/outcome/basic_result.hpp>
#include <boost/outcome/policy/terminate.hpp>
#include <filesystem>
#include <string>
#include <string_view>

namespace assay::corpus {

// Numbers are stable: they appear in stored reports. Add at the end.
enum class FileProblem {
  cannot_open = 1,
  is_directory = 2,
  permission_denied = 3,
  empty_file = 4,
  unknown_format = 5,
  malformed = 6,             // the text or header is not of its format
  truncated = 7,             // ends before what its header or grammar promises
  corrupt_gzip = 8,          // damaged or cut compressed stream
  vertex_counts_differ = 9,  // two frames of one sequence
  triangles_differ = 10,     // two frames of one sequence
  index_out_of_range = 11,
  repeated_index = 12,         // a triangle that names one vertex twice
  non_finite_coordinate = 13,  // NaN, infinity, or a decimal number beyond the doubles
  no_triangles = 14,
  wrong_schema = 15,
  missing_field = 16,
  wrong_type = 17,  // a JSON field of another type, length or value set
  cannot_write = 18,
  too_large = 19,        // beyond the limits of this room or the memory of this machine
  wrong_row_count = 20,  // query rows are not a multiple of eight
  wrong_column_count = 21,
  not_a_double = 22,  // a rational that no double equals
  zero_denominator = 23,
  labels_differ = 24,        // within the eight rows of one query
  truth_count_differs = 25,  // truths are not as many as queries
  unknown_query_kind = 26,   // vertex-face or edge-edge: the path does not say
  unknown_scene = 27,
  wrong_scene_option = 28,
  no_frames = 29,  // an empty list of files
};

// The enumerator's name, for reports.
std::string_view name_of(FileProblem kind);

// `message` is one line without a line break; it names the file, and the line or byte where that
// helps.
struct Problem {
  FileProblem kind;
  std::string message;
};

// A problem whose message is `file: detail` (only `detail` when the file is empty), with control
// characters, which a path or a quoted word may hold, replaced.
Problem problem_in(FileProblem kind, const std::filesystem::path& file, std::string_view detail);

// A value or a Problem. Asking for the side that is not there ends the program.
template <class T>
using Expected = boost::outcome_v2::basic_result<T, Problem, boost::outcome_v2::policy::terminate>;

}  // namespace assay::corpus
