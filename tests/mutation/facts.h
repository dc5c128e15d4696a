// What the oracle knows of a set of cases, as plain data in a file. mutation_facts writes the file;
// mutant_judge reads it and judges a detector without the oracle.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "detector/mesh/step_types.h"

namespace assay::mutation {

// An elementary query.
struct QueryFact {
  detector::FourPoints query;
  bool contact = false;
  detector::TimeEnclosure first;  // set if there is a contact
};

// A pair of the oracle's complete pair set. `part` is the connected part of the contact graph at
// the first time (its nodes are triangles, its edges the pairs that have this time); -1 if the pair
// is later.
struct PairFact {
  detector::TrianglePair pair;
  detector::TimeEnclosure time;
  std::int32_t part = -1;
};

// View sets of one step in one setting. The sets are right only for these primitives and apexes.
struct ViewFact {
  bool known = false;
  std::vector<detector::ViewPrimitive> primitives;
  std::vector<detector::MovingPoint> apexes;
  std::vector<detector::ViewSign> signs;  // of the mesh, then of the ghosts (L2)
  std::vector<std::uint8_t> doubts;       // violated (L11) and dirty (L8, L9)
};

struct StepFact {
  std::int32_t from = 0, to = 0;  // frames
  bool commit = true;
  std::optional<detector::ViewPrimitive> view;  // the primitive that the case states, if any
  std::vector<PairFact> pairs;
  std::optional<detector::TimeEnclosure> first;  // none: the step is free
  std::vector<ViewFact> views;                   // by setting; `known` is false without views
};

struct CaseFact {
  std::string id;
  detector::Triangles triangles;
  std::vector<detector::Positions> frames;
  bool starts_clean = false;    // Start::clean would be right
  std::vector<StepFact> steps;  // none if the detector must refuse the mesh
};

struct Facts {
  std::vector<QueryFact> queries;
  std::vector<CaseFact> cases;
};

void write_facts(const std::string& path, const Facts& facts);
// Throws std::runtime_error if the file does not hold facts.
Facts read_facts(const std::string& path);

}  // namespace assay::mutation
