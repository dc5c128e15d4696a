// `assay verify`: a certificate against the files beside it.
#include <fmt/format.h>

#include <filesystem>

#include "reports/certificate/verify.h"
#include "reports/commands.h"
#include "reports/complaint.h"

namespace assay::reports {

int run_verify(const VerifyRequest& request) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(request.certificate, ignored))
    return refuse(fmt::format("{}: no such file", request.certificate));
  const auto result = verify_certificate(request.certificate);
  for (const auto& line : result.differences) fmt::print("{}\n", line);
  if (!result.differences.empty()) {
    fmt::print("NOT VERIFIED: {} differences; this certificate says nothing\n",
               result.differences.size());
    return exit_defect;
  }
  const auto& predicate = result.statement["predicate"];
  fmt::print("verified: {} of {}, verdict {}\n", predicate["campaign"]["name"].get<std::string>(),
             predicate["detector"]["name"].get<std::string>(),
             predicate["verdict"].get<std::string>());
  return predicate["exit_code"].get<int>();
}

}  // namespace assay::reports
