// A law is a statement, as code, that holds in every step of every case. A tally says how often the
// premise of a law held.
//
// A law whose premise never holds proves nothing, so each law counts the steps in which its premise
// held, and the close steps among these. In a close step the law was nearly broken or nearly did
// not apply: the smallest of the values on which the law rests is at most 1 % of the largest. These
// values are |view values| over the step; for L13 they say how far the triangles of a certified
// patch face the direction of the patch (case_facts.h).
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace assay::properties {

class CaseFacts;
struct CaseChange;

struct LawTally {
  std::uint64_t premise = 0;       // steps in which the premise held
  std::uint64_t close = 0;         // steps that met the premise and were close
  std::uint64_t broken_steps = 0;  // steps that met the premise and refute the law
  std::string first_broken;        // case id, step, finding; the alphabetically first if several

  LawTally& operator+=(const LawTally& other);
  friend bool operator==(const LawTally&, const LawTally&) = default;
};

// The cullings under which the premise of a law has to hold somewhere in a campaign. Each culling
// finds in its own way which triangles are clean from step to step: Culling::view_point finds them
// after every step, but Culling::view_auto does some steps without views. So if a law about clean
// triangles holds under one culling, that says nothing about the other cullings.
enum class PremiseScope : std::uint8_t { any_culling, each_culling, each_that_chooses_views };

struct Law {
  std::string_view name;       // "L4_AllPositiveIsCollisionFree_Line"
  std::string_view number;     // "L1" .. "L15"; "sets", "claim", "change" for laws without a number
  std::string_view statement;  // the law in one or two sentences
  std::string_view needs;      // the law's demands on the oracle
  void (*check)(CaseFacts&, LawTally&);  // adds its tally of this case
  // The law is checked on one case in this many, because laws that run the case again are slow.
  int one_in = 1;
  PremiseScope met_under = PremiseScope::any_culling;
  // The change that the law is about, if any detector can run the changed case; else null.
  const CaseChange* change = nullptr;
};

// Returns all laws in a fixed order: by number, then sets, claims, changes.
std::span<const Law> laws();

// Returns whether the case is in the share of cases on which the law is checked (Law::one_in).
bool is_checked_on(const Law& law, std::string_view case_id);

// Returns the law of this name, or nullptr.
const Law* law_named(std::string_view name);

}  // namespace assay::properties
