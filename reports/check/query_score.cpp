#include "reports/check/query_score.h"

#include <fmt/format.h>

#include <chrono>
#include <nlohmann/json.hpp>

#include "reports/bench/estimate.h"
#include "reports/terminal/version.h"

namespace assay::reports {

using corpus::LabelledQuery;

void QueryScore::add(const std::string& file, const std::vector<LabelledQuery>& queries) {
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const auto begin = std::chrono::steady_clock::now();
    const QueryAnswer answered = answer_by(*method_, queries[i]);
    const auto end = std::chrono::steady_clock::now();
    microseconds_.push_back(std::chrono::duration<double, std::micro>(end - begin).count());
    if (answered.open) {
      ++open_;
      if (!queries[i].truth) ++unlabelled_;
      continue;
    }
    yes_ += answered.contact ? 1 : 0;
    if (method_ == QueryMethod::referee &&
        answer_by(QueryMethod::oracle, queries[i]).contact != answered.contact) {
      contradictions_.push_back({file, i, answered.contact, false});
    }
    ++rungs_[static_cast<std::size_t>(answered.rung)];
    if (!queries[i].truth) {
      ++unlabelled_;
      continue;
    }
    if (answered.contact != *queries[i].truth)
      note_difference(file, i, is_label_disputed(*method_, queries[i], answered.contact),
                      answered.contact);
  }
}

void QueryScore::add_answer(const std::string& file, std::size_t index, const Answered& answered) {
  microseconds_.push_back(answered.microseconds);
  yes_ += answered.contact ? 1 : 0;
  unlabelled_ += answered.truth ? 0 : 1;
  if (answered.truth && *answered.truth != answered.contact)
    note_difference(file, index, answered.label_disputed, answered.contact);
}

void QueryScore::print() const {
  constexpr std::size_t most_listed = 50;
  fmt::print("{}: {} queries, {} yes, {} without a label{}\n", name_, count(), yes_, unlabelled_,
             method_ == QueryMethod::referee
                 ? fmt::format(", {} open, {} contradictions", open_, contradictions_.size())
                 : "");
  for (const auto& d : contradictions_) {
    fmt::print("  CONTRADICTION: {} query {}: referee {}, oracle {}\n", d.file, d.index, d.answer,
               !d.answer);
  }
  fmt::print(
      "differences from the truth: {} false positives, {} false negatives, {} disputed labels\n",
      false_positives_, false_negatives_, disputed());
  std::size_t listed = 0;
  for (const auto& d : differences_) {
    if (listed++ == most_listed) {
      fmt::print("  ... {} more\n", differences_.size() - most_listed);
      break;
    }
    fmt::print("  {} query {}: answer {}, label {}{}\n", d.file, d.index, d.answer, !d.answer,
               !d.label_disputed ? ""
               : method_ ? "; coplanar throughout, both exact methods agree against the label"
                         : "; the oracle agrees against the label");
  }
  fmt::print("us a query: mean {:.2f}, median {:.2f}, p99 {:.2f}, p99.9 {:.2f}, max {:.2f}\n",
             mean(), quantile(0.5), quantile(0.99), quantile(0.999), quantile(1));
  if (!method_ || !*rungs_of(*method_)[0]) return;
  const auto& rungs = rungs_of(*method_);
  std::string text;
  for (std::size_t r = 0; r < rungs.size(); ++r) {
    if (!*rungs[r]) continue;
    text += fmt::format(
        "{}{} {:.1f} %", r == 0 ? "rungs: " : ", ", rungs[r],
        count() ? 100.0 * static_cast<double>(rungs_[r]) / static_cast<double>(count()) : 0.0);
  }
  fmt::print("{}\n", text);
}

nlohmann::ordered_json QueryScore::to_json(const std::vector<std::string>& files) const {
  nlohmann::ordered_json differences = nlohmann::ordered_json::array();
  for (const auto& d : differences_) {
    differences.push_back({{"file", d.file},
                           {"query", d.index},
                           {"answer", d.answer},
                           {"label", !d.answer},
                           {"label_disputed", d.label_disputed}});
  }
  nlohmann::ordered_json rungs;
  for (std::size_t r = 0; method_ && r < rungs_.size(); ++r) {
    const char* name = rungs_of(*method_)[r];
    if (*name) rungs[name] = rungs_[r];
  }
  return {{"schema", "assay-queries/1"},
          {"version", version_text()},
          {"method", name_},
          {"files", files},
          {"count", count()},
          {"yes", yes_},
          {"unlabelled", unlabelled_},
          {"false_positives", false_positives_},
          {"false_negatives", false_negatives_},
          {"disputed_labels", disputed()},
          {"differences", differences},
          {"mean_us", mean()},
          {"median_us", quantile(0.5)},
          {"p99_us", quantile(0.99)},
          {"p999_us", quantile(0.999)},
          {"max_us", quantile(1)},
          {"open", open_},
          {"contradictions", contradictions_.size()},
          {"rungs", rungs}};
}

void QueryScore::note_difference(const std::string& file, std::size_t index, bool disputed,
                                 bool contact) {
  differences_.push_back({file, index, contact, disputed});
  if (!disputed) ++(contact ? false_positives_ : false_negatives_);
}

double QueryScore::mean() const {
  double sum = 0;
  for (const double t : microseconds_) sum += t;
  return count() ? sum / static_cast<double>(count()) : 0;
}

double QueryScore::quantile(double share) const {
  return microseconds_.empty() ? 0 : reports::quantile(microseconds_, share);
}

}  // namespace assay::reports
