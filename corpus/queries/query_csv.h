// Reads query sets: vertex-face or edge-edge queries, eight rows a query, plain or gzip.
//
// A row is x, y and z. Each is either a fraction, written as numerator,denominator, which must
// equal a double; or one decimal, which becomes the double nearest to it. Columns are separated by
// commas, or by blanks if the row has no comma. The next column, which may be missing, is the
// query's truth (1: contact, 0: no contact). The column after the truth, which may be missing too,
// is the query's separation, a decimal: then the truth says whether the features come within the
// separation, and the column of the truth may be empty. Blank lines and comments (#) are ignored.
// Rows of an edge-edge query: ea0 ea1 eb0 eb1 at t0, the same at t1; of a vertex-face query: v f0
// f1 f2 at t0, the same at t1.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "corpus/problem.h"
#include "detector/mesh/step_types.h"

namespace assay::corpus {

struct LabelledQuery {
  detector::FourPoints query;
  // Whether there is a contact in [0,1] or, if there is a separation, whether the features come
  // within the separation; absent if the file does not say so.
  std::optional<bool> truth;
  // A length in the units of the points, finite and >= 0; absent if the query asks for contact.
  std::optional<double> separation;
};

// Reads the queries of a file. The path tells whether the queries are vertex-face or edge-edge: a
// folder of the path is named `vertex-face` or `edge-edge`, or the file's name begins with one of
// these words or ends in vf or ee (3036vf.csv, 3036ee.csv.gz). An underscore may replace the
// hyphen. Any other path is refused. `truth_json` is a file with an array of booleans, one for each
// query; they replace the truths in the rows.
Expected<std::vector<LabelledQuery>> read_queries(
    const std::filesystem::path& csv,
    const std::optional<std::filesystem::path>& truth_json = std::nullopt);

// Reads the truths of a query set, a JSON array of booleans. Refuses what read_bytes and parse_json
// refuse, and any other JSON.
Expected<std::vector<bool>> read_truths(const std::filesystem::path& path);

// Turns exact rationals into doubles.

enum class RationalState { exact, not_a_number, zero_denominator, not_a_double };

struct RationalValue {
  RationalState state;
  double value;  // set if the state is `exact`
};

// Returns the double that equals numerator/denominator, two decimal integers of any sign and
// length. `not_a_number`: the numerator or the denominator has letters, blanks inside, or more than
// 20,000 digits (no double needs so many). `not_a_double`: no double equals the fraction, or the
// fraction overflows.
RationalValue exact_double(std::string_view numerator, std::string_view denominator);

}  // namespace assay::corpus
