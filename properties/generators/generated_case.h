// A random case, and words for what it was made of.
#pragma once

#include <string>
#include <vector>

#include "corpus/cases/case_file.h"

namespace assay::properties {

// tags: "closed", "shape:torus", "holes:2", "motion:twist", "menu:ulp", "aim:edge", ...; each once,
// ascending. They say what the generator meant to make; whether, say, an aimed contact is the first
// one of its step is for the oracle to judge.
struct GeneratedCase {
  corpus::Case c;
  std::vector<std::string> tags;
};

}  // namespace assay::properties
