// Case files, schema `assay-case/1`: a deforming mesh and the known facts about it.
//
// The schema is reports/schemas/case.schema.json. Writing is canonical: equal cases give equal
// bytes. Each vertex, triangle or pair has a line of its own, and numbers are the shortest
// decimals that read back to the same double.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "corpus/problem.h"
#include "detector/mesh/counted_pairs.h"
#include "detector/mesh/step_types.h"

namespace assay::corpus {

inline constexpr std::string_view case_schema = "assay-case/1";

// A view primitive: its end points q0 and q1 have one place for each frame, and move linearly
// between frames. q1 is empty for a view-point.
struct CaseView {
  std::vector<detector::Point> q0, q1;
};

// Ghost triangles that close the mesh. With N mesh vertices, index N + k is apex k.
struct CaseGhosts {
  std::vector<std::vector<detector::Point>> apexes;  // [frame][apex]
  detector::Triangles triangles;
};

// One evaluation of a detector, from frame `from` to frame `to`. If `commit`, the detector's state
// advances to the end of the step; otherwise the state stays unchanged. A step that does not start
// where the last committed step ended is a new start.
struct CaseStep {
  std::int32_t from = 0, to = 1;
  bool commit = true;
  friend bool operator==(const CaseStep&, const CaseStep&) = default;
};

struct ExpectedPair {
  detector::TrianglePair pair;
  detector::TimeEnclosure time;  // first contact of this pair
  friend bool operator==(const ExpectedPair&, const ExpectedPair&) = default;
};

// Facts of one step. An absent optional says nothing about its fact.
struct ExpectedStep {
  detector::Answer answer = detector::Answer::free;
  std::optional<detector::TimeEnclosure> first_time;          // of a collision
  std::optional<std::vector<ExpectedPair>> pairs;             // the complete pair set, ascending
  std::optional<std::vector<detector::ViewSign>> view_signs;  // one for each mesh triangle
  std::optional<std::vector<detector::ViewSign>> ghost_view_signs;  // one for each ghost
};

// `answer` is `collision` if a step has a contact, and `error` if a detector must refuse the mesh.
// If `answer` is absent, nothing is known.
struct ExpectedFacts {
  std::optional<detector::Answer> answer;
  std::vector<ExpectedStep> steps;  // one for each step of the case, or none
};

// The relation of counted pairs, and facts about counted pairs. Case::expected speaks of all pairs,
// counted or not, because laws and detector state depend on all pairs (L19); `steps` speaks of
// counted pairs only.
struct CaseRelation {
  detector::CountedPairs pairs;
  std::vector<ExpectedStep> steps;  // one for each step of the case, without signs, or none
};

struct Case {
  std::string id;      // the file's name without .json
  std::string about;   // one line: the property that the case shows
  std::string source;  // the origin of the case
  detector::Triangles triangles;
  std::vector<detector::Positions> frames;  // at least one
  // The steps in order, as they are after the caller's responses to collisions. If empty, the steps
  // are consecutive_steps().
  std::vector<CaseStep> script;
  std::optional<CaseView> view;
  std::optional<CaseGhosts> ghosts;
  // Options such as culling and start, by name, in the words of the command line.
  std::map<std::string, std::string, std::less<>> options;
  ExpectedFacts expected;
  std::optional<CaseRelation> counted;  // absent: every pair counts
  // Further facts by name: a JSON object in compact text, stored verbatim.
  // tests/properties/curated/curated_checks.h explains them. "{}" if there are no further facts.
  std::string pending = "{}";
};

// Returns which pairs count; null: all of them.
inline const detector::CountedPairs* counted_of(const Case& c) {
  return c.counted ? &c.counted->pairs : nullptr;
}

// Returns a committed step for each two consecutive frames; for a single frame, one step in which
// nothing moves.
std::vector<CaseStep> consecutive_steps(std::size_t frames);

// Returns the script of the case or, if it is empty, the consecutive steps.
std::vector<CaseStep> steps_of(const Case& c);

// Returns the places of the vertices at the start and at the end of the step. REQUIRES a step of
// this case.
const detector::Positions& start_of(const Case& c, const CaseStep& step);
const detector::Positions& end_of(const Case& c, const CaseStep& step);

// Returns the view primitive during steps_of(c)[step]; nothing if the case has no view primitive.
std::optional<detector::ViewPrimitive> view_of_step(const Case& c, std::size_t step);

// Makes a case of one step. A detector is created from the frame `rest`, which becomes the first
// frame; if `rest` is null, from the start of the step. `counted` says which pairs count; if it is
// null, all pairs count.
Case case_of_step(const detector::Triangles& triangles, const detector::CountedPairs* counted,
                  const detector::Positions* rest, const detector::Positions& x_t0,
                  const detector::Positions& x_t1);

// Returns the vertices of a frame as points.
std::vector<detector::Point> points_of(const detector::Positions& x);

// Returns the canonical text of a case.
std::string case_text(const Case& c);

// Reads a case from its text, and checks shape, lengths and index ranges. A mesh triangle may
// repeat an index only if the expected answer is `error`. Messages begin with `name`.
Expected<Case> parse_case(std::string_view text, std::string_view name);

Expected<Case> read_case(const std::filesystem::path& path);
// Writes a case. Refuses every case that read_case would refuse, with the same problem, so that
// every written file can be read. Also refuses a coordinate that is not finite, because JSON has no
// form for it.
Expected<void> write_case(const std::filesystem::path& path, const Case& c);

// Returns the case files of a folder (*.json), sorted by name.
Expected<std::vector<std::filesystem::path>> case_files(const std::filesystem::path& folder);

}  // namespace assay::corpus
