#include "corpus/queries/query_csv.h"

#include <fmt/format.h>

#include <array>
#include <boost/outcome/try.hpp>
#include <new>
#include <string_view>
#include <utility>

#include "corpus/file_bytes.h"
#include "corpus/queries/truth_json.h"
#include "corpus/rational.h"

namespace assay::corpus {
namespace {

constexpr std::size_t rows_a_query = 8;

enum class Kind { vertex_face, edge_edge };

std::optional<Kind> kind_of(const std::filesystem::path& path) {
  std::filesystem::path name = path.filename();
  if (name.extension() == ".gz") name.replace_extension();
  const std::string stem = name.stem().string();
  if (stem.ends_with("vf")) return Kind::vertex_face;
  if (stem.ends_with("ee")) return Kind::edge_edge;
  // If both names are in the path, the nearest folder rules.
  for (auto folder = path.parent_path(); folder.has_filename(); folder = folder.parent_path()) {
    if (folder.filename() == "vertex-face") return Kind::vertex_face;
    if (folder.filename() == "edge-edge") return Kind::edge_edge;
  }
  return std::nullopt;
}

struct Row {
  detector::Point x{};
  std::optional<bool> label;
};

class CsvReader {
 public:
  CsvReader(std::string_view text, const std::filesystem::path& file, Kind kind)
      : text_(text), file_(file), kind_(kind) {}

  Expected<std::vector<LabelledQuery>> read() {
    std::vector<LabelledQuery> queries;
    std::array<Row, rows_a_query> rows;
    std::size_t filled = 0;
    while (!text_.empty()) {
      ++line_;
      const std::string_view line = next_line();
      // Only the end of the file may be blank.
      if (line.empty() && text_.find_first_not_of(" \t\r\n") == std::string_view::npos) break;
      BOOST_OUTCOME_TRY(row, read_row(line));
      if (filled > 0 && row.label != rows[0].label) {
        return wrong(fmt::format("this row's label is not that of its query's first row, {} before",
                                 filled));
      }
      rows[filled++] = row;
      if (filled == rows_a_query) {
        queries.push_back(query_of(rows));
        filled = 0;
      }
    }
    if (filled != 0 || queries.empty()) {
      return wrong(fmt::format("{} rows are not a multiple of 8", 8 * queries.size() + filled));
    }
    return queries;
  }

 private:
  Problem wrong(std::string_view detail) const {
    return problem_in(file_, fmt::format("line {}: {}", line_, detail));
  }

  std::string_view next_line() {
    const std::size_t end = std::min(text_.find('\n'), text_.size());
    std::string_view line = text_.substr(0, end);
    text_.remove_prefix(std::min(end + 1, text_.size()));
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
  }

  Expected<Row> read_row(std::string_view line) const {
    std::array<std::string_view, 7> columns;
    std::size_t count = 0;
    for (bool more = true; more; ++count) {
      const std::size_t comma = std::min(line.find(','), line.size());
      if (count < columns.size()) columns[count] = trimmed(line.substr(0, comma));
      more = comma < line.size();
      line.remove_prefix(more ? comma + 1 : comma);
    }
    if (count != 6 && count != 7) {
      return wrong(fmt::format("{} columns, where 6 or 7 are expected", count));
    }
    Row row;
    for (std::size_t k = 0; k < 3; ++k) {
      BOOST_OUTCOME_TRY(value, coordinate(columns[2 * k], columns[2 * k + 1], "xyz"[k]));
      row.x[k] = value;
    }
    if (count == 7) {
      if (columns[6] != "0" && columns[6] != "1") {
        return wrong("the label is neither 0 nor 1");
      }
      row.label = columns[6] == "1";
    }
    return row;
  }

  Expected<double> coordinate(std::string_view numerator, std::string_view denominator,
                              char axis) const {
    const RationalValue value = exact_double(numerator, denominator);
    switch (value.state) {
      case RationalState::exact:
        return value.value;
      case RationalState::not_a_number:
        return wrong(fmt::format("{}: numerator or denominator is not a whole number", axis));
      case RationalState::zero_denominator:
        return wrong(fmt::format("{}: denominator 0", axis));
      case RationalState::not_a_double:
        break;
    }
    return wrong(fmt::format("{}: no double has this value", axis));
  }

  static std::string_view trimmed(std::string_view text) {
    const std::size_t first = text.find_first_not_of(" \t");
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(" \t") - first + 1);
  }

  LabelledQuery query_of(const std::array<Row, rows_a_query>& rows) const {
    const auto point = [&](std::size_t i) {
      return detector::MovingPoint{rows[i].x, rows[i + 4].x};
    };
    if (kind_ == Kind::vertex_face) {
      return {detector::VertexFace{point(0), {point(1), point(2), point(3)}}, rows[0].label};
    }
    return {detector::EdgeEdge{{point(0), point(1)}, {point(2), point(3)}}, rows[0].label};
  }

  std::string_view text_;
  const std::filesystem::path& file_;
  Kind kind_;
  std::size_t line_ = 0;
};

}  // namespace

Expected<std::vector<LabelledQuery>> read_queries(
    const std::filesystem::path& csv, const std::optional<std::filesystem::path>& truth_json) try {
  const auto kind = kind_of(csv);
  if (!kind) {
    return problem_in(csv,
                      "vertex-face or edge-edge queries? The path should have a folder of that "
                      "name, or the file's name should end in vf or ee");
  }
  BOOST_OUTCOME_TRY(bytes, read_bytes(csv));
  BOOST_OUTCOME_TRY(queries, CsvReader(bytes, csv, *kind).read());
  if (truth_json) {
    BOOST_OUTCOME_TRY(truths, read_truths(*truth_json));
    if (truths.size() != queries.size()) {
      return problem_in(*truth_json, fmt::format("{} truths, but {} has {} queries", truths.size(),
                                                 csv.string(), queries.size()));
    }
    for (std::size_t i = 0; i < queries.size(); ++i) queries[i].truth = truths[i];
  }
  return std::move(queries);
} catch (const std::bad_alloc&) {
  return problem_in(csv, "larger than the memory at hand");
}

}  // namespace assay::corpus
