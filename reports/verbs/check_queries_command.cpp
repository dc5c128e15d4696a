// `assay check-queries`: labelled vertex-face and edge-edge queries answered by one method, scored
// against their truth, and timed one by one.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>

#include "corpus/queries/query_csv.h"
#include "detector/contact/contact_exact.h"
#include "detector/contact/elementary.h"
#include "oracle/referee/referee.h"
#include "properties/queries/query_methods.h"
#include "properties/words.h"
#include "reports/bench/estimate.h"
#include "reports/steps/json_output.h"
#include "reports/terminal/complaint.h"
#include "reports/verbs/commands.h"

namespace assay::reports {
namespace {

using corpus::LabelledQuery;

struct Answered {
  bool contact = false;
  // 0 axis, 1 interval or filter, 2 the last: algebraic, exact or open; 0 for the referee
  int rung = 0;
  bool open = false;  // by the referee: not decided
};

detector::FourPoints four_points_of(const LabelledQuery& q) {
  return std::visit([](const auto& query) { return detector::four_points(query); }, q.query);
}

Answered answer_by_oracle(const LabelledQuery& q) {
  const auto answer = properties::ask_oracle(four_points_of(q), detector::Want::yes_no);
  return {answer.contact, static_cast<int>(answer.rung)};
}

template <detector::Arithmetic arithmetic>
Answered answer_by_detector(const LabelledQuery& q) {
  using detector::ContactRung;
  const auto answer = detector::test_contact(four_points_of(q), detector::Want::yes_no, arithmetic);
  return {answer.contact, answer.rung == ContactRung::axis     ? 0
                          : answer.rung == ContactRung::filter ? 1
                                                               : 2};
}

Answered answer_by_referee(const LabelledQuery& q) {
  const auto verdict =
      std::visit([](const auto& query) { return oracle::referee(query); }, q.query);
  return {verdict == oracle::RefereeVerdict::contact, 0, verdict == oracle::RefereeVerdict::open};
}

// By method: the names of its rungs, and how it answers.
struct MethodWords {
  std::array<const char*, 3> rungs;  // "" where there is none
  Answered (*answer)(const LabelledQuery&);
};

const MethodWords& words_of(QueryMethod method) {
  using detector::Arithmetic;
  static const std::array<MethodWords, 6> words = {{
      {{"axis", "interval", "algebraic"}, answer_by_oracle},
      {{"", "", ""}, answer_by_referee},
      {{"axis", "filter", "exact"}, answer_by_detector<Arithmetic::exact>},
      {{"axis", "filter", "open"}, answer_by_detector<Arithmetic::bounded>},
      {{"axis", "filter", ""}, answer_by_detector<Arithmetic::double_precision>},
      {{"axis", "filter", ""}, answer_by_detector<Arithmetic::single_precision>},
  }};
  return words[static_cast<std::size_t>(method)];
}

Answered answer(QueryMethod method, const LabelledQuery& q) { return words_of(method).answer(q); }

QueryMethod other(QueryMethod method) {
  return method == QueryMethod::oracle ? QueryMethod::detector_exact : QueryMethod::oracle;
}

const char* name_of(QueryMethod method) { return properties::word_of(query_method_names, method); }

bool has_rungs(QueryMethod method) { return method != QueryMethod::referee; }

// Whether a wrong answer refutes the method: bounded arithmetic may raise false alarms, plain
// doubles and floats promise nothing.
bool claims_no_false_positives(QueryMethod method) { return method <= QueryMethod::detector_exact; }
bool claims_no_false_negatives(QueryMethod method) {
  return method <= QueryMethod::detector_bounded;
}

// A query where the answer is not the label.
struct Difference {
  std::string file;
  std::size_t index = 0;
  bool answer = false;
  // Coplanar for the whole step, and the other exact method answers as this one: the label is in
  // doubt, not the method (labels of such queries were never checked by their makers).
  bool label_disputed = false;
};

class Score {
 public:
  explicit Score(QueryMethod method) : method_(method) {}

  void add(const std::string& file, const std::vector<LabelledQuery>& queries) {
    for (std::size_t i = 0; i < queries.size(); ++i) {
      const auto begin = std::chrono::steady_clock::now();
      const Answered answered = answer(method_, queries[i]);
      const auto end = std::chrono::steady_clock::now();
      microseconds_.push_back(std::chrono::duration<double, std::micro>(end - begin).count());
      if (answered.open) {
        ++open_;
        if (!queries[i].truth) ++unlabelled_;
        continue;
      }
      yes_ += answered.contact ? 1 : 0;
      if (method_ == QueryMethod::referee &&
          answer_by_oracle(queries[i]).contact != answered.contact) {
        contradictions_.push_back({file, i, answered.contact, false});
      }
      ++rungs_[static_cast<std::size_t>(answered.rung)];
      if (!queries[i].truth) {
        ++unlabelled_;
        continue;
      }
      if (answered.contact != *queries[i].truth)
        note_difference(file, i, queries[i], answered.contact);
    }
  }

  void print() {
    fmt::print("{}: {} queries, {} yes, {} without a label{}\n", name_of(method_), count(), yes_,
               unlabelled_,
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
                 d.label_disputed
                     ? "; coplanar throughout, both exact methods agree against the label"
                     : "");
    }
    fmt::print("us a query: mean {:.2f}, median {:.2f}, p99 {:.2f}, p99.9 {:.2f}, max {:.2f}\n",
               mean(), quantile(0.5), quantile(0.99), quantile(0.999), quantile(1));
    if (!has_rungs(method_)) return;
    const auto& rungs = words_of(method_).rungs;
    std::string text;
    for (std::size_t r = 0; r < rungs.size() && *rungs[r]; ++r) {
      text += fmt::format("{}{} {:.1f} %", r == 0 ? "rungs: " : ", ", rungs[r], share(r));
    }
    fmt::print("{}\n", text);
  }

  nlohmann::ordered_json json(const std::vector<std::string>& files) const {
    nlohmann::ordered_json differences = nlohmann::ordered_json::array();
    for (const auto& d : differences_) {
      differences.push_back({{"file", d.file},
                             {"query", d.index},
                             {"answer", d.answer},
                             {"label", !d.answer},
                             {"label_disputed", d.label_disputed}});
    }
    nlohmann::ordered_json rungs;
    for (std::size_t r = 0; r < rungs_.size(); ++r) {
      const char* name = words_of(method_).rungs[r];
      if (*name) rungs[name] = rungs_[r];
    }
    return {{"schema", "assay-queries/1"},
            {"version", version_text()},
            {"method", name_of(method_)},
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

  bool is_unsound() const { return !contradictions_.empty(); }
  bool is_wrong() const {
    return (false_positives_ > 0 && claims_no_false_positives(method_)) ||
           (false_negatives_ > 0 && claims_no_false_negatives(method_));
  }

 private:
  void note_difference(const std::string& file, std::size_t index, const LabelledQuery& query,
                       bool contact) {
    const bool disputed = detector::coplanar_throughout(four_points_of(query)) &&
                          answer(other(method_), query).contact == contact;
    differences_.push_back({file, index, contact, disputed});
    if (!disputed) ++(contact ? false_positives_ : false_negatives_);
  }

  std::size_t count() const { return microseconds_.size(); }
  std::size_t disputed() const { return differences_.size() - false_positives_ - false_negatives_; }
  double share(std::size_t rung) const {
    return count() ? 100.0 * static_cast<double>(rungs_[rung]) / static_cast<double>(count()) : 0;
  }
  double mean() const {
    double sum = 0;
    for (const double t : microseconds_) sum += t;
    return count() ? sum / static_cast<double>(count()) : 0;
  }
  double quantile(double share) const {
    return microseconds_.empty() ? 0 : reports::quantile(microseconds_, share);
  }

  static constexpr std::size_t most_listed = 50;

  QueryMethod method_;
  std::vector<double> microseconds_;
  std::size_t yes_ = 0, unlabelled_ = 0, false_positives_ = 0, false_negatives_ = 0;
  std::array<std::size_t, 3> rungs_ = {0, 0, 0};
  std::size_t open_ = 0;  // by the referee; neither yes nor a difference
  std::vector<Difference> differences_, contradictions_;
};

}  // namespace

int run_check_queries(const CheckQueriesRequest& request) {
  if (!request.truths.empty() && request.truths.size() != request.files.size()) {
    return refuse(
        fmt::format("{} truth files for {} query files: give one for each, in the same order",
                    request.truths.size(), request.files.size()));
  }
  if (auto problem = cannot_write(request.json_file, request.files)) return refuse(*problem);
  std::vector<std::vector<LabelledQuery>> sets;
  for (std::size_t i = 0; i < request.files.size(); ++i) {
    std::optional<std::filesystem::path> truth;
    if (!request.truths.empty()) truth = request.truths[i];
    auto queries = corpus::read_queries(request.files[i], truth);
    if (!queries) return refuse(queries.error().message);
    sets.push_back(std::move(queries.value()));
  }
  Score score(request.method);
  for (std::size_t i = 0; i < sets.size(); ++i) score.add(request.files[i], sets[i]);
  score.print();
  if (!request.json_file.empty()) {
    if (auto problem = write_json_file(request.json_file, score.json(request.files))) {
      return refuse(*problem);
    }
    fmt::print("wrote {}\n", request.json_file);
  }
  if (score.is_unsound()) return exit_unsound;
  return score.is_wrong() ? exit_defect : exit_holds;
}

}  // namespace assay::reports
