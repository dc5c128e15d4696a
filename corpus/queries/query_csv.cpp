#include "corpus/queries/query_csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <boost/outcome/try.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <new>
#include <string>
#include <utility>

#include "corpus/files.h"
#include "corpus/formats/text_lines.h"
#include "corpus/json_fields.h"

namespace assay::corpus {

namespace {

constexpr std::size_t rows_a_query = 8;

enum class Kind { vertex_face, edge_edge };

// Returns the name with a hyphen for each underscore.
std::string with_hyphens(std::string name) {
  std::ranges::replace(name, '_', '-');
  return name;
}

std::optional<Kind> kind_of(const std::filesystem::path& path) {
  std::filesystem::path name = path.filename();
  if (name.extension() == ".gz") name.replace_extension();
  const std::string stem = with_hyphens(name.stem().string());
  if (stem.ends_with("vf") || stem.starts_with("vertex-face")) return Kind::vertex_face;
  if (stem.ends_with("ee") || stem.starts_with("edge-edge")) return Kind::edge_edge;
  // If both names are in the path, the nearest folder rules.
  for (auto folder = path.parent_path(); folder.has_filename(); folder = folder.parent_path()) {
    const auto kind = with_hyphens(folder.filename().string());
    if (kind == "vertex-face") return Kind::vertex_face;
    if (kind == "edge-edge") return Kind::edge_edge;
  }
  return std::nullopt;
}

struct Row {
  detector::Point x{};
  std::optional<bool> label;
  std::optional<double> separation;
};

class CsvReader {
 public:
  CsvReader(std::string_view text, const std::filesystem::path& file, Kind kind)
      : lines_(text, '#', false), file_(file), kind_(kind) {}

  Expected<std::vector<LabelledQuery>> read() {
    std::vector<LabelledQuery> queries;
    std::array<Row, rows_a_query> rows;
    std::size_t filled = 0;
    while (const auto line = lines_.next()) {
      BOOST_OUTCOME_TRY(row, read_row(*line));
      rows[filled] = row;
      const bool is_labelled_alike = row.label == rows[0].label;
      if (!is_labelled_alike || row.separation != rows[0].separation) {
        return wrong(fmt::format("its {} differs from the first row of its query, {} rows above",
                                 is_labelled_alike ? "separation" : "label", filled));
      }
      ++filled;
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
    return problem_in(file_, fmt::format("line {}: {}", lines_.number(), detail));
  }

  static std::vector<std::string_view> columns_of(std::string_view line) {
    std::vector<std::string_view> columns;
    if (line.find(',') == std::string_view::npos) {
      split_words(line, columns);
      return columns;
    }
    for (bool more = true; more;) {
      const std::size_t comma = std::min(line.find(','), line.size());
      columns.push_back(trimmed(line.substr(0, comma)));
      more = comma < line.size();
      line.remove_prefix(more ? comma + 1 : comma);
    }
    return columns;
  }

  Expected<Row> read_row(std::string_view line) const {
    const auto columns = columns_of(line);
    const std::size_t count = columns.size();
    if (count < 3 || count > 8) {
      return wrong(
          fmt::format("{} columns; a row has 3 (x,y,z) or 6 (a numerator and denominator each), "
                      "then perhaps a label, then perhaps a separation",
                      count));
    }
    const std::size_t numbers = count < 6 ? 3 : 6;
    Row row;
    for (std::size_t k = 0; k < 3; ++k) {
      BOOST_OUTCOME_TRY(value, numbers == 3
                                   ? decimal(columns[k], "xyz"[k])
                                   : coordinate(columns[2 * k], columns[2 * k + 1], "xyz"[k]));
      row.x[k] = value;
    }
    if (count == numbers + 1 || (count == numbers + 2 && !columns[numbers].empty())) {
      // Writers of arrays write the label as they write the coordinates.
      const auto label = parse_double(columns[numbers]);
      if (label != 0 && label != 1) return wrong("the label is neither 0 nor 1");
      row.label = label == 1;
    }
    if (count == numbers + 2) {
      row.separation = parse_double(columns.back());
      if (!row.separation || !(*row.separation >= 0) || !std::isfinite(*row.separation)) {
        return wrong("the separation is no finite number >= 0");
      }
    }
    return row;
  }

  Expected<double> decimal(std::string_view column, char axis) const {
    const auto value = parse_double(column);
    if (value && std::isfinite(*value)) return *value;
    return wrong(fmt::format("{}: {} is no finite number", axis, excerpt(column)));
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
        return wrong(fmt::format("{}: the denominator is 0", axis));
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
    return {{{point(0), point(1), point(2), point(3)}, kind_ == Kind::vertex_face ? 1 : 2},
            rows[0].label,
            rows[0].separation};
  }

  Lines lines_;
  const std::filesystem::path& file_;
  Kind kind_;
};

}  // namespace

Expected<std::vector<LabelledQuery>> read_queries(
    const std::filesystem::path& csv, const std::optional<std::filesystem::path>& truth_json) try {
  const auto kind = kind_of(csv);
  if (!kind) {
    return problem_in(
        csv,
        "vertex-face or edge-edge queries? Give a folder one of these two names, or let the file's "
        "name begin with one of them or end in vf or ee, as in posted_vf.csv");
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

Expected<std::vector<bool>> read_truths(const std::filesystem::path& path) {
  BOOST_OUTCOME_TRY(bytes, read_bytes(path));
  BOOST_OUTCOME_TRY(json, parse_json(bytes, path));
  if (!json.is_array()) {
    return problem_in(path, "an array of booleans expected");
  }
  std::vector<bool> truths;
  for (const Json& truth : json) {
    if (!truth.is_boolean()) {
      return problem_in(path, fmt::format("item {} is not a boolean", truths.size()));
    }
    truths.push_back(truth.get<bool>());
  }
  return truths;
}

namespace {

using boost::multiprecision::cpp_int;

constexpr std::size_t most_digits = 20'000;

// Parses an optional sign and digits. cpp_int itself would take hexadecimal and octal too.
std::optional<cpp_int> parse_big(std::string_view text) {
  const bool negative = text.starts_with('-');
  if (negative || text.starts_with('+')) text.remove_prefix(1);
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  if (text.empty() || text.size() > most_digits) return std::nullopt;
  if (!std::all_of(text.begin(), text.end(), is_digit)) return std::nullopt;
  text.remove_prefix(std::min(text.find_first_not_of('0'), text.size() - 1));
  cpp_int value{std::string(text)};
  return negative ? cpp_int(-value) : value;
}

// Takes the factors 2 out of a number that is not 0, and says how many.
std::int64_t take_twos(cpp_int& value) {
  const auto twos = boost::multiprecision::lsb(value);
  value >>= twos;
  return static_cast<std::int64_t>(twos);
}

// Returns m * 2^exponent if that is a double. REQUIRES an odd m.
std::optional<double> scaled(const cpp_int& m, std::int64_t exponent) {
  const auto bits = static_cast<std::int64_t>(boost::multiprecision::msb(m)) + 1;
  using Limits = std::numeric_limits<double>;
  constexpr std::int64_t least = Limits::min_exponent - Limits::digits;  // of the least denormal
  if (bits > Limits::digits || exponent < least || bits + exponent > Limits::max_exponent) {
    return std::nullopt;
  }
  return std::ldexp(static_cast<double>(static_cast<std::uint64_t>(m)), static_cast<int>(exponent));
}

}  // namespace

RationalValue exact_double(std::string_view numerator, std::string_view denominator) {
  auto n = parse_big(numerator);
  auto d = parse_big(denominator);
  if (!n || !d) return {RationalState::not_a_number, 0};
  if (*d == 0) return {RationalState::zero_denominator, 0};
  if (*n == 0) return {RationalState::exact, 0};
  const bool negative = (*n < 0) != (*d < 0);
  cpp_int m = abs(*n), over = abs(*d);
  const std::int64_t exponent = take_twos(m) - take_twos(over);
  // m/over is dyadic only when the odd part of the denominator divides it.
  if (over != 1) {
    const cpp_int quotient = m / over;
    if (quotient * over != m) return {RationalState::not_a_double, 0};
    m = quotient;
  }
  const auto value = scaled(m, exponent);
  if (!value) return {RationalState::not_a_double, 0};
  return {RationalState::exact, negative ? -*value : *value};
}

}  // namespace assay::corpus
