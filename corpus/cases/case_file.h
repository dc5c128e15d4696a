// Case files, schema `assay-case/1`: a deforming mesh and the facts that are known of it.
//
// The schema is documented in corpus/README.md. Writing is canonical: equal cases give equal bytes,
// one vertex, triangle or pair a line, numbers as the shortest decimals that read back to the same
// double.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "corpus/problem.h"
#include "detector/mesh/step_types.h"

namespace assay::corpus {

// A view primitive, one place a frame, linear in between. q1 is empty for a point.
struct CaseView {
  std::vector<detector::Point> q0, q1;
};

// Ghost triangles that close the mesh: with N mesh vertices, index N + k names apex k.
struct CaseGhosts {
  std::vector<std::vector<detector::Point>> apexes;  // [frame][apex]
  detector::Triangles triangles;
};

// One evaluation of a detector: from frame `from` to frame `to`; with `commit` its state advances
// to the end of it. A step that starts elsewhere than the last commit ended is a new start.
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

// Facts of one step. An absent optional is not stated; it is not a claim that there is nothing.
struct ExpectedStep {
  detector::Answer answer = detector::Answer::free;
  std::optional<detector::TimeEnclosure> first_time;          // stated when answer is collision
  std::optional<std::vector<ExpectedPair>> pairs;             // the complete pair set, ascending
  std::optional<std::vector<detector::ViewSign>> view_signs;  // one a mesh triangle
  std::optional<std::vector<detector::ViewSign>> ghost_view_signs;  // one a ghost triangle
};

// answer: collision when a step has a contact; error for a mesh that must be refused.
struct ExpectedFacts {
  detector::Answer answer = detector::Answer::free;
  std::vector<ExpectedStep> steps;  // one for each step of the case, or none
};

struct Case {
  std::string id;      // the file's name without .json
  std::string about;   // one line: what it shows
  std::string source;  // where it comes from
  detector::Triangles triangles;
  std::vector<detector::Positions> frames;  // at least one
  // The steps in order (a response of the caller to a collision shows here); empty: consecutive
  // frames, each committed.
  std::vector<CaseStep> script;
  std::optional<CaseView> view;
  std::optional<CaseGhosts> ghosts;
  // culling, start, ...: as on the command line.
  std::map<std::string, std::string, std::less<>> options;
  ExpectedFacts expected;
  // A JSON object in compact text, kept verbatim: facts that no code checks yet. "{}" when none.
  std::string pending = "{}";
};

// Consecutive frames, each committed.
std::vector<CaseStep> consecutive_steps(std::size_t frames);

// The script, or what an empty one stands for.
std::vector<CaseStep> steps_of(const Case& c);

// Where the vertices are when the step starts and when it ends. REQUIRES a step of this case.
const detector::Positions& start_of(const Case& c, const CaseStep& step);
const detector::Positions& end_of(const Case& c, const CaseStep& step);

// The primitive of step `step`; nothing when the case states none.
std::optional<detector::ViewPrimitive> view_of_step(const Case& c, std::size_t step);

// The canonical text of a case.
std::string case_text(const Case& c);

// Checks shape, lengths and index ranges. A triangle that repeats an index is let through only
// where the expected answer is `error`. `name` stands for the file in messages.
Expected<Case> parse_case(std::string_view text, std::string_view name);

Expected<Case> read_case(const std::filesystem::path& path);
// Refuses, with the same problem, what read_case would refuse (a coordinate that is not finite has
// no JSON form: malformed), and cannot_write.
Expected<void> write_case(const std::filesystem::path& path, const Case& c);

// The case files of a folder (*.json), sorted by name.
Expected<std::vector<std::filesystem::path>> case_files(const std::filesystem::path& folder);

}  // namespace assay::corpus
