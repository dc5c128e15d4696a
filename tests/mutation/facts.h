// What the oracle knows of a set of cases, as plain data in a file: a detector is judged by it
// without the oracle. Written by mutation_facts, read by mutant_judge.
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
  detector::TimeEnclosure first;  // when there is a contact
};

// A pair of the oracle's complete set. part: of the contact graph at the first time (triangles as
// nodes, pairs that have this time as edges); -1 where the pair is later.
struct PairFact {
  detector::TrianglePair pair;
  detector::TimeEnclosure time;
  std::int32_t part = -1;
};

// View sets of one step in one setting. They hold for these primitives and apexes alone.
struct ViewFact {
  bool known = false;
  std::vector<detector::ViewPrimitive> primitives;
  std::vector<detector::MovingPoint> apexes;
  std::vector<detector::ViewSign> signs;  // mesh, then ghosts (L2)
  std::vector<std::uint8_t> doubts;       // violated (L11) and dirty (L8, L9)
};

struct StepFact {
  std::int32_t from = 0, to = 0;  // frames
  bool commit = true;
  std::optional<detector::ViewPrimitive> view;  // of the case, where it states one
  std::vector<PairFact> pairs;
  std::optional<detector::TimeEnclosure> first;  // none: the step is free
  std::vector<ViewFact> views;                   // by setting; not known where it has no views
};

struct CaseFact {
  std::string id;
  detector::Triangles triangles;
  std::vector<detector::Positions> frames;
  bool starts_clean = false;    // what Start::clean vouches for is true
  std::vector<StepFact> steps;  // none where the mesh must be refused
};

struct Facts {
  std::vector<QueryFact> queries;
  std::vector<CaseFact> cases;
};

void write_facts(const std::string& path, const Facts& facts);
// Throws std::runtime_error where the file is not one of facts.
Facts read_facts(const std::string& path);

}  // namespace assay::mutation
