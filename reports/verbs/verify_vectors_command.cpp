// `assay verify-vectors` finds all that a conformance set states once more, by all methods.
#include <fmt/format.h>

#include "properties/vectors/methods.h"
#include "properties/vectors/set_files.h"
#include "properties/vectors/set_reader.h"
#include "reports/terminal/words.h"
#include "reports/verbs/verbs.h"

namespace assay::reports {
namespace {

struct VerifyVectorsRequest {
  std::string folder;
  std::uint64_t neighbours = 0;
  int jobs = 1;
};

void print_contradictions(const std::vector<properties::VectorContradiction>& contradictions) {
  constexpr std::size_t most = 20;
  for (std::size_t i = 0; i < std::min(most, contradictions.size()); ++i)
    fmt::print("{}: {}\n", contradictions[i].id, contradictions[i].text);
  if (contradictions.size() > most) fmt::print("... and {} more\n", contradictions.size() - most);
}

Expected<int> verify_vectors(const VerifyVectorsRequest& request) {
  BOOST_OUTCOME_TRY(read, properties::read_set(request.folder));
  const auto contradictions = properties::contradictions_of(read.set, request.jobs);
  print_contradictions(contradictions);
  std::size_t cases = 0, open = 0;
  for (const auto& group : read.set.groups) {
    cases += group.cases.size();
    for (const auto& v : group.cases) open += v.open.empty() ? 0 : 1;
  }
  bool is_wrong = !contradictions.empty();
  fmt::print("{} cases, {} of them with a method that stays open: {} different\n", cases, open,
             contradictions.size());
  if (properties::digest_of(read.set) != read.digest) {
    fmt::print("the digest in set.json is not that of the cases\n");
    is_wrong = true;
  }
  if (request.neighbours > 0) {
    const auto tally = properties::check_neighbours(read.set, request.neighbours, request.jobs);
    print_contradictions(tally.contradictions);
    fmt::print("{} neighbours of queries, {} with a method that stays open: {} contradictions\n",
               tally.queries, tally.open, tally.contradictions.size());
    is_wrong = is_wrong || !tally.contradictions.empty();
  }
  fmt::print("vectors: {}\n", is_wrong ? "WRONG" : "hold");
  return is_wrong ? exit_unsound : exit_holds;
}

void add_options(Verb& verb, VerifyVectorsRequest& request) {
  verb.add("DIR", request.folder, "The folder that holds set.json").required();
  verb.add("--neighbours N", request.neighbours,
           "Ask all methods about so many queries beside those of the set, too")
      .in_range(0, 1'000'000'000);
  add_jobs(verb, request.jobs);
}

}  // namespace

AddedVerb add_verify_vectors(CLI::App& app) {
  return make_verb(app, "verify-vectors",
                   "Find the answers of a conformance set once more, by several methods",
                   add_options, verify_vectors);
}

}  // namespace assay::reports
