#include "reports/page/data/run_json.h"

#include <fmt/format.h>

#include "reports/certificate/statement.h"

namespace assay::reports {
namespace {

using Json = nlohmann::ordered_json;

std::string why_text(const properties::Judgement& judgement) {
  if (!judgement.failed)
    return judgement.verdict == "not judged" ? "no gate was judged" : "no gate fails";
  const auto& reasons = judgement.of(*judgement.failed).reasons;
  return fmt::format("gate \"{}\" fails: {}{}", properties::rule_of(*judgement.failed).name,
                     reasons[0],
                     reasons.size() > 1 ? fmt::format("; and {} more", reasons.size() - 1) : "");
}

}  // namespace

Json run_json(const properties::RunFindings& findings, const properties::Judgement& judgement,
              const Json& statement, const std::string& unverified) {
  const bool is_certificate = statement.is_object();
  return {
      {"folder", findings.folder.string()},
      {"library", findings.library.empty() ? Json() : Json(findings.library)},
      {"verdict", unverified.empty() ? judgement.verdict : "unverified"},
      {"why",
       unverified.empty() ? why_text(judgement) : "the certificate does not verify: " + unverified},
      {"subject", is_certificate ? statement.at("subject") : Json()},
      {"findings", is_certificate ? statement.at("predicate")
                                  : make_predicate(findings, judgement, findings.run.plan, "")}};
}

}  // namespace assay::reports
