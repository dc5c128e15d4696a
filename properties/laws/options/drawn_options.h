// Draws the configurations in which claims are tested, so that all pairs of options, questions,
// states and sizes occur.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "detector/mesh/enum_names.h"
#include "properties/generators/parts.h"
#include "properties/laws/facts/case_facts.h"

namespace assay::properties {

// Draws values of several factors so that all pairs of values occur. Some faults show only if two
// factors have certain values, and no test that varies only one factor finds them.

// A row has one value for each factor; the sizes are the numbers of values of each factor.
using FactorRow = std::vector<std::uint8_t>;
using FactorSizes = std::vector<std::uint8_t>;

// A value a of factor f and a value b of factor g, with f < g.
struct TwoValues {
  std::size_t f, g;
  std::uint8_t a, b;
};
using MayMeet = std::function<bool(const TwoValues&)>;

// Returns a covering array of strength 2 (pairwise coverage): rows that contain every pair of
// values that may meet, and no other pair. The choice is greedy: each row begins with a missing
// pair, and each further factor takes the value that adds most missing pairs. Equal seeds give
// equal rows, different seeds mostly different ones. If may_meet is empty, all pairs may meet.
// REQUIRES that each factor has a value that may meet all values of the other factors.
std::vector<FactorRow> covering_rows(const FactorSizes& sizes, std::uint64_t seed,
                                     const MayMeet& may_meet = {});

// The history of a detector when the case begins.
enum class StateBefore : std::uint8_t {
  fresh,      // nothing
  elsewhere,  // committed a step at other positions
  carried,    // committed a step that ends where the case begins
  restored,   // before each step its state moves into a detector that has committed something else
  reset,      // played the case, and was reset
};
constexpr auto names_of(StateBefore) {
  using enum StateBefore;
  return std::to_array<Named<StateBefore>>({{fresh, "fresh"},
                                            {elsewhere, "elsewhere"},
                                            {carried, "carried"},
                                            {restored, "restored"},
                                            {reset, "reset"}});
}

// The distance, as a share of the mesh's extent, within which pairs are looked for.
enum class Apart : std::uint8_t { none, little, much };
constexpr auto names_of(Apart) {
  using enum Apart;
  return std::to_array<Named<Apart>>(
      {{none, "contact"}, {little, "little apart"}, {much, "apart"}});
}

// A question that the detector is asked before each step. The step's answer must be the same
// without the question.
enum class Question : std::uint8_t {
  none,
  limit,          // how far the step may go
  stopped_step,   // the step itself; its evaluation is stopped
  stopped_limit,  // how far the step may go; the call is stopped
};
constexpr auto names_of(Question) {
  using enum Question;
  return std::to_array<Named<Question>>({{none, "only steps"},
                                         {limit, "limits"},
                                         {stopped_step, "stopped steps"},
                                         {stopped_limit, "stopped limits"}});
}

struct DrawnOptions {
  Options options;  // without separation and relation, which follow from the case
  StateBefore state = StateBefore::fresh;
  bool is_scaled = false;  // by a power of two, up to the largest doubles or down to the smallest
  Apart apart = Apart::none;
  LeftOut left_out = LeftOut::nothing;
  Question question = Question::none;
  bool has_far_body = false;  // the case has a far body (with_far_body)

  std::string text() const;
};

// Draws a row for the case's kind of mesh and size, from one of several covering arrays. Some pairs
// are not drawn. A separation is not drawn with a culling or an arithmetic that does not answer it;
// with scaled coordinates, because they leave the range of distances; or with many triangles,
// because the oracle then takes long. A far body is not drawn without a tree, with scaled
// coordinates, or with a vouched start, because such a start is then hard to check.
DrawnOptions drawn_options(const CaseFacts& facts);

}  // namespace assay::properties
