// Gives the rows of an enum's table of names, and turns counts and whole numbers into words or
// back. Makes text from outside, such as a plug-in's name, safe to print. Imports the names of the
// types of meshes, cases, steps, results and problems from the rooms detector/ and corpus/.
#pragma once

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "corpus/cases/case_file.h"
#include "corpus/problem.h"
#include "detector/mesh/enum_names.h"
#include "detector/options.h"
#include "detector/step_result.h"

namespace assay::properties {

using assay::name_of;  // of enums that list their values
using corpus::Case, corpus::CaseStep, corpus::CaseView;
// A function of properties/ returns its failure as a value; the only exception that leaves this
// folder is std::bad_alloc.
using corpus::Expected, corpus::Problem, corpus::ProblemKind;
using detector::Answer, detector::Arithmetic, detector::CountedPairs, detector::Culling,
    detector::Feature, detector::FeatureKind, detector::FourPoints, detector::MovingPoint,
    detector::Options, detector::PairContact, detector::Point, detector::Positions,
    detector::PositionsView, detector::StepResult, detector::SteppedMesh, detector::StopFunction,
    detector::TimeEnclosure, detector::TrianglePair, detector::Triangles, detector::TrianglesView,
    detector::ViewPrimitive, detector::ViewSign, detector::Want;

// The rows of the table names_of(Enum), in the order of the enum's values, which begin at 0. A row
// may have further columns besides the name.
template <Listed Enum>
inline constexpr auto all_rows = names_of(Enum{});
template <Listed Enum>
constexpr const auto& row_of(Enum value) {
  return all_rows<Enum>[static_cast<std::size_t>(value)];
}

// Returns the whole number that the word spells. Returns nothing if the word has other characters
// than digits, or if the number does not fit into T.
template <class T = std::uint64_t>
std::optional<T> whole_number_of(std::string_view word) {
  T number = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  const bool is_number = error == std::errc() && end == word.data() + word.size();
  return is_number ? std::optional(number) : std::nullopt;
}

// Returns "once" or "3 times".
inline std::string times_text(std::uint64_t count) {
  return count == 1 ? "once" : std::to_string(count) + " times";
}

// Returns the text as UTF-8 without control characters: each control character becomes '?', and
// each byte that is no part of a character becomes U+FFFD. A terminal can then show the text, and
// writers of JSON and XML, which escape quotes and brackets themselves, accept the text.
std::string printable(std::string_view text);

}  // namespace assay::properties
