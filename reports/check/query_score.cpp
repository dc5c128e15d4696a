#include "reports/check/query_score.h"

#include <fmt/format.h>

#include <chrono>
#include <nlohmann/json.hpp>

#include "detector/contact/contact_exact.h"
#include "detector/contact/elementary.h"
#include "oracle/referee/referee.h"
#include "properties/queries/query_methods.h"
#include "properties/words.h"
#include "reports/estimate.h"
#include "reports/terminal/words.h"

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

namespace {

using corpus::LabelledQuery;

detector::FourPoints four_points_of(const LabelledQuery& q) {
  return std::visit([](const auto& query) { return detector::four_points(query); }, q.query);
}

QueryAnswer answer_by_oracle(const LabelledQuery& q) {
  const auto answer = properties::ask_oracle(four_points_of(q), detector::Want::yes_no);
  return {answer.contact, static_cast<int>(answer.rung)};
}

template <detector::Arithmetic arithmetic>
QueryAnswer answer_by_detector(const LabelledQuery& q) {
  const auto answer = detector::test_contact(four_points_of(q), detector::Want::yes_no, arithmetic);
  return {answer.contact, static_cast<int>(answer.rung)};
}

QueryAnswer answer_by_referee(const LabelledQuery& q) {
  const auto decision =
      std::visit([](const auto& query) { return oracle::referee(query); }, q.query);
  return {decision == detector::Decision::yes, 0, decision == detector::Decision::open};
}

struct Method {
  RungNames rungs;
  QueryAnswer (*answer)(const LabelledQuery&);
};

const Method& method_of(QueryMethod method) {
  using detector::Arithmetic;
  static const std::array<Method, 6> methods = {{
      {{"axis", "interval", "quadratic", "", ""}, answer_by_oracle},
      {{"", "", "", "", ""}, answer_by_referee},
      {{"axis", "filter", "fixed", "unbounded", ""}, answer_by_detector<Arithmetic::exact>},
      {{"axis", "filter", "", "", "open"}, answer_by_detector<Arithmetic::bounded>},
      {{"axis", "filter", "", "", ""}, answer_by_detector<Arithmetic::double_precision>},
      {{"axis", "filter", "", "", ""}, answer_by_detector<Arithmetic::single_precision>},
  }};
  return methods[static_cast<std::size_t>(method)];
}

}  // namespace

const char* name_of(QueryMethod method) { return properties::word_of(query_method_names, method); }

QueryAnswer answer_by(QueryMethod method, const LabelledQuery& query) {
  return method_of(method).answer(query);
}

const RungNames& rungs_of(QueryMethod method) { return method_of(method).rungs; }

bool claims_no_false_positives(QueryMethod method) { return method <= QueryMethod::detector_exact; }
bool claims_no_false_negatives(QueryMethod method) {
  return method <= QueryMethod::detector_bounded;
}

bool is_label_disputed(QueryMethod method, const LabelledQuery& query, bool contact) {
  const auto other =
      method == QueryMethod::oracle ? QueryMethod::detector_exact : QueryMethod::oracle;
  return detector::coplanar_throughout(four_points_of(query)) &&
         answer_by(other, query).contact == contact;
}

}  // namespace assay::reports
