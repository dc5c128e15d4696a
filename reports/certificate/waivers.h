// Known failures that a certificate may leave aside for a while: corpus/known.json.
#pragma once

#include <string>
#include <vector>

#include "corpus/problem.h"

namespace assay::reports {

struct Waiver {
  std::string signature;  // of a failure, as `assay list failures` prints it
  std::string reason;
  std::string link;     // where it is being worked on
  std::string expires;  // the last day on which it holds, YYYY-MM-DD
};

// Reads a file of waivers, schema `assay-known/1` (corpus/README.md): {"schema", "waivers":
// [{signature, reason, link, expires}]}. Every field is stated and none is empty; each signature
// occurs once.
corpus::Expected<std::vector<Waiver>> read_waivers(const std::filesystem::path& file);

// `today` is YYYY-MM-DD.
bool is_expired(const Waiver& waiver, const std::string& today);

}  // namespace assay::reports
