// `assay vectors` writes the conformance set.
#include <fmt/format.h>

#include <array>
#include <filesystem>

#include "properties/vectors/choice.h"
#include "properties/vectors/set_files.h"
#include "reports/terminal/progress.h"
#include "reports/terminal/shipped.h"
#include "reports/terminal/text_file.h"
#include "reports/terminal/words.h"
#include "reports/verbs/verbs.h"

namespace assay::reports {
namespace {

struct VectorsRequest {
  std::string out;
  properties::VectorProfile profile = properties::VectorProfile::core;
  int jobs = 1;
};

Expected<int> write_vectors(const VectorsRequest& request) {
  Progress progress("vectors", std::chrono::seconds(10));
  BOOST_OUTCOME_TRY(corpus, shipped_corpus());
  BOOST_OUTCOME_TRY(may_fill(request.out));
  BOOST_OUTCOME_TRY(set, properties::choose_vectors({request.profile, corpus / "curated",
                                                     corpus / "vectors" / "found.json",
                                                     request.jobs, [&](std::string_view group) {
                                                       progress.phase(std::string(group));
                                                     }}));
  progress.finish();
  BOOST_OUTCOME_TRYV(properties::write_set(request.out, set));
  std::size_t all = 0;
  for (const auto& group : set.groups) {
    std::array<std::size_t, 3> results{};
    for (const auto& v : group.cases) ++results[static_cast<std::size_t>(v.result())];
    fmt::print("{:<32}{:>7} cases: {} collision, {} acceptable, {} free\n", group.name(),
               group.cases.size(), results[2], results[1], results[0]);
    all += group.cases.size();
  }
  fmt::print("{} cases, version {}, digest {}\n", all, properties::vectors_version,
             properties::digest_of(set));
  fmt::print("next: {}\n",
             line_to_paste("verify-vectors " + shell_word(request.out), PastedIn::this_folder));
  return exit_holds;
}

void add_options(Verb& verb, VectorsRequest& request) {
  verb.add("--out DIR", request.out, "Folder for set.json, a file for each group, and csv/")
      .required()
      .in(OptionGroup::output);
  add_choice(verb, "--profile", request.profile, all_names<properties::VectorProfile>(),
             from_name<properties::VectorProfile>,
             "core (default): about 1,000 cases; full: about 20,000");
  add_jobs(verb, request.jobs);
}

}  // namespace

AddedVerb add_vectors(CLI::App& app) {
  return make_verb(app, "vectors", "Write the conformance set, the same bytes on every machine",
                   add_options, write_vectors);
}

}  // namespace assay::reports
