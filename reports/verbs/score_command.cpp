// `assay score` judges what products answered to a conformance set.
#include <fmt/format.h>

#include "reports/terminal/shipped.h"
#include "reports/terminal/text_file.h"
#include "reports/vectors/matrix_page.h"
#include "reports/verbs/verbs.h"

namespace assay::reports {
namespace {

struct ScoreRequest {
  std::vector<std::string> results;
  std::string set;   // empty: the shipped one
  std::string page;  // empty: not written
};

Expected<int> run_score(const ScoreRequest& request) {
  BOOST_OUTCOME_TRY(may_write({request.page}, request.results));
  std::string set = request.set;
  if (set.empty()) {
    BOOST_OUTCOME_TRY(corpus, shipped_corpus());
    set = corpus / "vectors";
  }
  BOOST_OUTCOME_TRY(read, properties::read_set(set));
  std::vector<JudgedResults> all;
  for (const auto& file : request.results) {
    BOOST_OUTCOME_TRY(results, properties::read_results(file, read));
    all.push_back(judge_results(results, read.set));
  }
  fmt::print("{}", score_text(read, all));
  if (!request.page.empty()) {
    BOOST_OUTCOME_TRY(write_text_file(request.page, matrix_page(read, all)));
    fmt::print("\npage {}: opens in a browser, without a network\n", request.page);
  }
  return exit_code_of(all);
}

void add_options(Verb& verb, ScoreRequest& request) {
  verb.add("RESULTS", request.results,
           "Results of vectors.py, assay_vectors.h or answer-vectors, a file a product")
      .required();
  verb.add("--set DIR", request.set,
           "The folder of the set that was asked (default: the shipped one)");
  verb.add("--out FILE", request.page, "Write the matrix of all products here (.html)")
      .in(OptionGroup::output);
}

}  // namespace

AddedVerb add_score(CLI::App& app) {
  return make_verb(app, "score", "Answers to a conformance set, judged", add_options, run_score);
}

}  // namespace assay::reports
