#include "reports/vectors/score_matrix.h"

#include <fmt/format.h>

#include <algorithm>

#include "reports/estimate.h"

namespace assay::reports {
namespace {

constexpr std::size_t most_ids = 8;  // that the text lists

// Adds the outcome of a case to the cell.
void add(MatrixCell& cell, CaseOutcome outcome) {
  if (outcome == CaseOutcome::unsupported) return;
  ++cell.cases;
  if (outcome == CaseOutcome::miss) {
    ++cell.misses;
  } else if (outcome == CaseOutcome::late) {
    ++cell.late;
  } else if (outcome == CaseOutcome::alarm) {
    ++cell.alarms;
  } else if (outcome != CaseOutcome::right) {
    ++cell.unanswered;
  }
}

// `is_of` says whether a case belongs to the row of a name.
template <class IsOf>
std::vector<MatrixRow> rows_of(const std::vector<std::string>& names,
                               const std::vector<JudgedResults>& all, IsOf is_of) {
  std::vector<MatrixRow> rows;
  for (const auto& name : names) {
    MatrixRow row{name, {}};
    for (const auto& judged : all) {
      MatrixCell cell;
      for (const auto& one : judged.cases)
        if (is_of(one, name)) add(cell, one.outcome);
      row.cells.push_back(cell);
    }
    if (std::any_of(row.cells.begin(), row.cells.end(),
                    [](const MatrixCell& cell) { return cell.cases > 0; }))
      rows.push_back(std::move(row));
  }
  return rows;
}

using TextTable = std::vector<std::vector<std::string>>;

// Characters, of which some are several bytes.
std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xc0U) != 0x80U;
  }));
}

// Columns, of which the first `left` are set to the left.
std::string table_text(const TextTable& rows, std::size_t left) {
  std::vector<std::size_t> widths(rows.front().size(), 0);
  for (const auto& row : rows)
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], width_of(row[i]));
  std::string text;
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string blanks(widths[i] - width_of(row[i]), ' ');
      line += (i == 0 ? "" : "  ") + (i < left ? row[i] + blanks : blanks + row[i]);
    }
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return text;
}

std::string matrix_text(const std::string& title, const std::vector<MatrixRow>& rows,
                        std::size_t products) {
  if (rows.empty()) return "";
  TextTable table = {{title}};
  for (std::size_t i = 0; i < products; ++i) table[0].push_back(letter_of(i));
  for (const auto& row : rows) {
    table.push_back({row.name});
    for (const auto& cell : row.cells) {
      table.back().push_back(cell.cases > 0 ? fmt::format("{}/{}", cell.misses, cell.cases) : "-");
    }
  }
  return "\n" + table_text(table, 1);
}

constexpr std::pair<CaseOutcome, const char*> listed[] = {
    {CaseOutcome::miss, "misses"},     {CaseOutcome::late, "late"},
    {CaseOutcome::alarm, "alarms"},    {CaseOutcome::undecided, "undecided"},
    {CaseOutcome::error, "error"},     {CaseOutcome::crash, "crash"},
    {CaseOutcome::timeout, "timeout"}, {CaseOutcome::unsupported, "unsupported"}};

std::string products_text(const std::vector<JudgedResults>& all) {
  TextTable table = {{"", "product", "cases"}};
  for (const auto& [unused, words] : listed) table[0].emplace_back(words);
  for (std::size_t i = 0; i < all.size(); ++i) {
    table.push_back({letter_of(i), all[i].title(), std::to_string(all[i].supported())});
    for (const auto& [outcome, unused] : listed)
      table.back().push_back(std::to_string(all[i].count(outcome)));
  }
  return table_text(table, 2);
}

std::string lines_of(const JudgedResults& judged, const std::string& letter) {
  std::string text;
  for (const auto& [outcome, words] : listed) {
    const auto cases = judged.with(outcome);
    if (cases.empty() || outcome == CaseOutcome::unsupported) continue;
    text += letter + " " + words + ":";
    for (std::size_t i = 0; i < std::min(cases.size(), most_ids); ++i)
      text += " " + cases[i]->asked->c.id;
    if (cases.size() > most_ids) text += fmt::format(" and {} more", cases.size() - most_ids);
    text += "\n";
  }
  if (judged.closed + judged.open > 0) {
    text += fmt::format("{} where features only touch: {} closed, {} open\n", letter, judged.closed,
                        judged.open);
  }
  if (judged.early > 0) text += fmt::format("{} times early: {}\n", letter, judged.early);
  if (judged.gave_pairs) {
    text += fmt::format("{} pairs: {} missing, {} spurious\n", letter, judged.missing_pairs,
                        judged.spurious_pairs);
  }
  if (!judged.uses.empty()) text += fmt::format("{} limits: {}\n", letter, uses_text(judged));
  return text;
}

}  // namespace

std::vector<MatrixRow> rows_by_flag(const properties::ReadSet& read,
                                    const std::vector<JudgedResults>& all) {
  std::vector<std::string> names;
  for (const auto& text : read.flags) names.emplace_back(name_of(text.flag));
  return rows_of(names, all, [](const JudgedCase& one, const std::string& name) {
    return one.asked->has(*from_name<properties::VectorFlag>(name));
  });
}

std::vector<MatrixRow> rows_by_group(const properties::ReadSet& read,
                                     const std::vector<JudgedResults>& all) {
  return rows_of(read.titles, all, [&](const JudgedCase& one, const std::string& name) {
    return read.titles[one.group] == name;
  });
}

std::string letter_of(std::size_t product) {
  constexpr std::size_t letters = 26;
  const std::string letter(1, static_cast<char>('A' + product % letters));
  return product < letters ? letter : letter + std::to_string(product / letters + 1);
}

std::string uses_text(const JudgedResults& judged) {
  return fmt::format("{} safe, the median uses {:.1f} % of the way", judged.uses.size(),
                     100 * median_of(judged.uses).value);
}

std::string score_text(const properties::ReadSet& read, const std::vector<JudgedResults>& all) {
  std::string text =
      fmt::format("set {} ({}), {} cases, digest {}\n\n{}", read.version, read.set.profile,
                  read.set.size(), read.digest.substr(0, 12), products_text(all));
  text += matrix_text("misses/cases by flag", rows_by_flag(read, all), all.size());
  text += matrix_text("misses/cases by group", rows_by_group(read, all), all.size());
  std::string lines;
  for (std::size_t i = 0; i < all.size(); ++i) lines += lines_of(all[i], letter_of(i));
  return lines.empty() ? text : text + "\n" + lines;
}

}  // namespace assay::reports
