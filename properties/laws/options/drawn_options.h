// The configurations in which the claims are tried: options, questions, states and sizes in pairs.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "detector/mesh/enum_names.h"
#include "detector/options.h"
#include "properties/generators/parts.h"
#include "properties/laws/facts/case_facts.h"

namespace assay::properties {

// Values of several factors in pairs: faults hide in corners of their product, where no test of one
// of them alone looks.

// One value of each factor, and how many values each has.
using FactorRow = std::vector<std::uint8_t>;
using FactorSizes = std::vector<std::uint8_t>;

// A value of factor f and one of factor g, with f < g.
struct TwoValues {
  std::size_t f, g;
  std::uint8_t a, b;
};
using MayMeet = std::function<bool(const TwoValues&)>;
inline bool all_may_meet(const TwoValues&) { return true; }

// Rows in which every two values stand together that may meet, and no others. A greedy choice: each
// row begins with two values that do not stand together yet, and each further factor takes the
// value that makes most of such pairs. Equal seeds give equal rows, others mostly other ones.
// REQUIRES in each factor a value that may meet all others.
std::vector<FactorRow> covering_rows(const FactorSizes& sizes, std::uint64_t seed,
                                     const MayMeet& may_meet = all_may_meet);

// What a detector has behind it when the case begins.
enum class StateBefore : std::uint8_t {
  fresh,      // nothing
  elsewhere,  // it has committed a step elsewhere
  carried,    // it has committed a step that ends where the case begins
  restored,   // before each step its state goes into a detector that has committed something else
  reset,      // it has played the case, and was reset
};
constexpr auto names_of(StateBefore) {
  using enum StateBefore;
  return std::to_array<Named<StateBefore>>({{fresh, "fresh"},
                                            {elsewhere, "elsewhere"},
                                            {carried, "carried"},
                                            {restored, "restored"},
                                            {reset, "reset"}});
}

// Within which distance, of the extent of the mesh, pairs are looked for.
enum class Apart : std::uint8_t { none, little, much };
constexpr auto names_of(Apart) {
  using enum Apart;
  return std::to_array<Named<Apart>>(
      {{none, "contact"}, {little, "little apart"}, {much, "apart"}});
}

// What is asked before each step is played. None of it may show in what the step then answers.
enum class Question : std::uint8_t {
  none,
  limit,          // how far the step may be gone
  stopped_step,   // the step, and it is stopped
  stopped_limit,  // how far, and that is stopped
};
constexpr auto names_of(Question) {
  using enum Question;
  return std::to_array<Named<Question>>({{none, "steps alone"},
                                         {limit, "limits"},
                                         {stopped_step, "stopped steps"},
                                         {stopped_limit, "stopped limits"}});
}

struct DrawnOptions {
  detector::Options options;  // without separation and relation, which follow from the case
  StateBefore state = StateBefore::fresh;
  bool is_scaled = false;  // by a power of two, up to the largest doubles or down to the least
  Apart apart = Apart::none;
  LeftOut left_out = LeftOut::nothing;
  Question question = Question::none;
  bool has_far_body = false;  // with_far_body

  std::string text() const;
};

// One of the rows of the case's mesh and size, of one of several covering arrays. Not drawn are:
// a separation with other cullings and arithmetics than answer it, with scaled coordinates, which
// leave the range of distances, or among many triangles, where the oracle takes long; a far body
// without a tree, with scaled coordinates, or with a start that is vouched for, which is hard to
// tell then.
DrawnOptions drawn_options(const CaseFacts& facts);

}  // namespace assay::properties
