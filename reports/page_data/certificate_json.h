// A certificate beside the stores of a run: what it says goes before what the stores alone say.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "corpus/problem.h"

namespace assay::reports {

// The predicate (assay-certificate/1) of FOLDER/certificate.json with its `subject`; null where
// there is no such file. Errors: a file that is no certificate.
corpus::Expected<nlohmann::ordered_json> read_certificate(const std::filesystem::path& folder);

// Puts verdict, gates and strata with bounds of the certificate into a run of assay-report/1, and
// what only it holds into `certificate`. Errors: a field is absent or of another
// type.
corpus::Expected<void> take_certificate(const nlohmann::ordered_json& predicate,
                                        nlohmann::ordered_json& run);

}  // namespace assay::reports
