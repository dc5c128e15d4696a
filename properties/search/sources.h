// The sources of fresh cases: the families of the strata, their queries as meshes of few
// triangles and as queries, hard cases by construction, and the curated cases.
#pragma once

#include <filesystem>
#include <functional>

#include "properties/search/search.h"

namespace assay::properties {

struct SourcesAsked {
  bool meshes = true, queries = false;
  std::filesystem::path curated{};  // folder of the curated cases; empty: none
  // Leaves a curated case out. A fault that a case was made for is found by it without any search.
  std::function<bool(const corpus::Case&)> leaves_out{};
};

// They may be drawn from in several threads. A curated case is read when it is first drawn.
std::vector<CaseSource> case_sources(const SourcesAsked& asked);

}  // namespace assay::properties
