#include "reports/queries/query_score.h"

#include <fmt/format.h>

#include <chrono>
#include <nlohmann/json.hpp>

#include "detector/contact/contact_exact.h"
#include "reports/estimate.h"
#include "reports/terminal/words.h"

namespace assay::reports {

using detector::Decision;

namespace {

properties::MethodAnswer ask(const properties::QueryMethod& method,
                             const corpus::LabelledQuery& asked) {
  return asked.separation ? method.within(asked.query, *asked.separation)
                          : method.answer(asked.query);
}

// " within 0.1", or nothing of a query of contact.
std::string within_text(const std::optional<double>& separation) {
  return separation ? fmt::format(" within {}", *separation) : "";
}

// Whether the label of a query that is coplanar throughout is in doubt, because another exact
// method gives the same answer as this one (such labels were never checked by their makers).
bool is_label_disputed(const properties::QueryMethod& method, const properties::Query& query,
                       Decision answer) {
  const auto& oracle = properties::oracle_method();
  const auto& other = &method == &oracle ? properties::detector_method() : oracle;
  return detector::coplanar_throughout(query) && other.answer(query).decision == answer;
}

}  // namespace

void QueryScore::add(const std::string& file, const std::vector<corpus::LabelledQuery>& queries) {
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const auto& [query, truth, separation] = queries[i];
    const auto begin = std::chrono::steady_clock::now();
    const auto [decision, first, rung] = ask(*method_, queries[i]);
    const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - begin;
    Answered answered{decision == Decision::yes, truth, separation, false, took.count()};
    answered.open = decision == Decision::open;
    answered.rung = rung;
    if (!answered.open) {
      answered.contradicted =
          method_->is_referee && ask(properties::oracle_method(), queries[i]).decision != decision;
      answered.label_disputed = truth && *truth != answered.contact && !separation &&
                                is_label_disputed(*method_, query, decision);
    }
    add_answer(file, i, answered);
  }
}

void QueryScore::add_answer(const std::string& file, std::size_t index, const Answered& answered) {
  microseconds_.push_back(answered.microseconds);
  unlabelled_ += answered.truth ? 0 : 1;
  open_ += answered.open ? 1 : 0;
  if (const auto& d = answered.separation) {
    ++of_distance_;
    least_ = std::min(least_, *d);
    greatest_ = std::max(greatest_, *d);
  }
  if (answered.open) return;
  const bool contact = answered.contact;
  yes_ += contact ? 1 : 0;
  if (answered.contradicted)
    contradictions_.push_back({file, index, contact, false, answered.separation});
  ++rungs_[static_cast<std::size_t>(answered.rung)];
  if (!answered.truth || *answered.truth == contact) return;
  differences_.push_back({file, index, contact, answered.label_disputed, answered.separation});
  if (!answered.label_disputed) ++(contact ? false_positives_ : false_negatives_);
}

void QueryScore::print() const {
  constexpr std::size_t most_listed = 50;
  std::string of_distance;
  if (of_distance_ > 0)
    of_distance = fmt::format(" ({}{}{})", of_distance_, within_text(least_),
                              least_ < greatest_ ? fmt::format(" to {}", greatest_) : "");
  fmt::print("{}: {} queries{}, {} yes, {} without a label{}\n", name_, count(), of_distance, yes_,
             unlabelled_,
             method_ && method_->is_referee
                 ? fmt::format(", {} open, {} contradictions", open_, contradictions_.size())
                 : "");
  for (const auto& d : contradictions_) {
    fmt::print("  CONTRADICTION: {} query {}{}: referee {}, oracle {}\n", d.file, d.index,
               within_text(d.separation), d.answer, !d.answer);
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
    fmt::print("  {} query {}{}: answer {}, label {}{}\n", d.file, d.index,
               within_text(d.separation), d.answer, !d.answer,
               !d.label_disputed ? ""
               : method_ ? "; coplanar throughout, both exact methods agree against the label"
                         : "; the oracle agrees against the label");
  }
  fmt::print("us a query: mean {:.2f}, median {:.2f}, p99 {:.2f}, p99.9 {:.2f}, max {:.2f}\n",
             mean(), quantile(0.5), quantile(0.99), quantile(0.999), quantile(1));
  if (!method_ || !*method_->rungs[0]) return;
  const auto& rungs = method_->rungs;
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
  using Json = nlohmann::ordered_json;
  Json differences = Json::array();
  for (const auto& d : differences_) {
    differences.push_back({{"file", d.file},
                           {"query", d.index},
                           {"answer", d.answer},
                           {"label", !d.answer},
                           {"label_disputed", d.label_disputed},
                           {"separation", d.separation ? Json(*d.separation) : Json()}});
  }
  Json rungs;
  for (std::size_t r = 0; method_ && r < rungs_.size(); ++r) {
    const char* name = method_->rungs[r];
    if (*name) rungs[name] = rungs_[r];
  }
  return {{"schema", "assay-queries/1"},
          {"version", version_text()},
          {"method", name_},
          {"files", files},
          {"separation", of_distance_ > 0 ? Json{least_, greatest_} : Json()},
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

double QueryScore::mean() const {
  double sum = 0;
  for (const double t : microseconds_) sum += t;
  return count() ? sum / static_cast<double>(count()) : 0;
}

double QueryScore::quantile(double share) const {
  return microseconds_.empty() ? 0 : reports::quantile(microseconds_, share);
}

}  // namespace assay::reports
