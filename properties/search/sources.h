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

// The four points of a query as a closed mesh: a corner and the face across it, or two edges across
// each other, are its only features that do not share a vertex.
corpus::Case tetrahedron(const detector::FourPoints& query, std::string id);

// The two features of a query as a mesh of two triangles, whose other corners lie away from the
// features.
corpus::Case two_triangles(const detector::FourPoints& query, Random& random, std::string id);

}  // namespace assay::properties
