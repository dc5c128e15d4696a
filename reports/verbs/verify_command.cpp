// `assay verify`: certificates against the files beside them; several nights are pooled.
#include <fmt/format.h>

#include <filesystem>

#include "reports/certificate/pooling.h"
#include "reports/certificate/verify.h"
#include "reports/terminal/complaint.h"
#include "reports/terminal/option_words.h"
#include "reports/verbs/verbs.h"

namespace assay::reports {
namespace {

struct VerifyRequest {
  std::vector<std::string> certificates;  // several: nights, pooled
};

using Json = nlohmann::ordered_json;

int print_pooled(const std::vector<Json>& predicates) {
  const auto pooled = pool(predicates);
  if (!pooled) return refuse(pooled.error().message);
  fmt::print("{} nights together, all bounds at {} %:\n{:24} {:18} {:>9} {:>9} {:>9}\n",
             predicates.size(), 100 * predicates[0]["confidence"]["family"].get<double>(),
             "stratum", "configuration", "n", "holds", "bound");
  for (const auto& row : pooled.value()) {
    fmt::print("{:24} {:18} {:>9} {:>9} {:>9.2e}\n", row["family"].get<std::string>(),
               row["configuration"].get<std::string>(), row["n"].get<std::uint64_t>(),
               row["holds"].get<std::uint64_t>(), row["bound"].get<double>());
  }
  return exit_holds;
}

int run_verify(const VerifyRequest& request) {
  std::error_code ignored;
  for (const auto& file : request.certificates) {
    if (!std::filesystem::is_regular_file(file, ignored))
      return refuse(fmt::format("{}: no such file", file));
  }
  std::vector<Json> predicates;
  int code = exit_holds;
  for (const auto& file : request.certificates) {
    const auto result = verify_certificate(file);
    for (const auto& line : result.differences) fmt::print("{}\n", line);
    if (!result.differences.empty()) {
      fmt::print("NOT VERIFIED: {}, {} differences; it says nothing\n", file,
                 result.differences.size());
      return exit_defect;
    }
    predicates.push_back(result.statement["predicate"]);
    const auto& predicate = predicates.back();
    fmt::print("verified: {} of {}, verdict {}\n", predicate["campaign"]["name"].get<std::string>(),
               predicate["detector"]["name"].get<std::string>(),
               predicate["verdict"].get<std::string>());
    if (code == exit_holds) code = predicate["exit_code"].get<int>();
  }
  if (code == exit_holds && predicates.size() > 1) return print_pooled(predicates);
  return code;
}

void add_options(Verb& verb, VerifyRequest& request) {
  verb.add("certificate", request.certificates,
           "OUT/certificate.json; several nights of one detector are pooled")
      .required();
}

}  // namespace

Action add_verify(CLI::App& app) {
  return make_verb(app, "verify", "A certificate against the files beside it", add_options,
                   run_verify);
}

}  // namespace assay::reports
