// Laws that are judged of every detector, because they need nothing of its inside: a case is put to
// it in another form, in which the answers follow from those of the case.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "corpus/cases/case_file.h"
#include "detector/step_result.h"
#include "properties/laws/law.h"
#include "properties/laws/metamorphic/change_laws.h"

namespace assay::properties {

// A case in another form. It states no views and no facts.
struct Form {
  corpus::Case c;
  // By triangle of the form: the triangle of the case that it is, or of which it is a part.
  std::vector<std::int32_t> parent;
  // By step of the case: the step of the form that it has become. Empty if the answers cannot be
  // set side by side, because coordinates were rounded or steps divided.
  std::vector<std::size_t> step;
  bool same_times = true;  // contacts keep their times to the last bit
};

// Nothing if the form does not apply. The case's id is the only source of randomness.
using MakeForm = std::optional<Form> (*)(const corpus::Case&);

struct FormLaw {
  std::string_view law;  // the name of the law, in laws()
  MakeForm make;
  // The steps of the case are asked for as they were, between others that must not matter: what a
  // detector that claims to be deterministic answers is then the same.
  bool same_calls = false;
  bool keeps_lengths = true;
};

// All such laws, always in the same order: changes of the mesh, then of its steps.
std::vector<FormLaw> form_laws();

// Whether the law is judged of a plug-in: if it is one of form_laws(), or says that threads do not
// show, which the second runs of trials tell. No state is saved and restored, because the interface
// of plug-ins has no such call.
inline constexpr std::string_view threads_law = "Change_ThreadsDoNotShow";
bool is_of_plugins(const Law& law);

// Whether the case is in the share of cases that a plug-in is given in this form.
bool is_given_in_form(const FormLaw& law, std::string_view case_id);

// How the answer to a step of the form differs from that to the step of the case, both given by one
// detector; empty if it does not. `pairs`: whether all pairs were asked for.
std::string difference_in_form(const detector::StepResult& of_case, const Form& form,
                               const detector::StepResult& of_form, bool pairs = true);

// Plays the form through the built-in detector, and compares each step with the given results.
void check_form(CaseFacts& facts, LawTally& tally, MakeForm make);
template <MakeForm make>
void check_form(CaseFacts& facts, LawTally& tally) {
  check_form(facts, tally, make);
}

// The case with a change of its mesh, made on a grid or not (change_laws.h).
std::optional<Form> form_by_change(const corpus::Case& c, MakeChange make, bool on_grid);
template <MakeChange make, bool on_grid = false>
std::optional<Form> form_by(const corpus::Case& c) {
  return form_by_change(c, make, on_grid);
}
std::span<const FormLaw> change_forms();                 // those of change_laws.cpp
std::optional<Form> scaled_form(const corpus::Case& c);  // by a power of two

// The case with its mesh, frames and steps alone, as forms begin with.
corpus::Case bare(const corpus::Case& c);

// L18: some edges are split in all triangles that have them.
std::optional<Form> refined(const corpus::Case& c);

// The same of steps: compares every committed step of the case in two halves with the whole step,
// both rounded to a grid, so that the middle places of vertices, primitives and apexes are exact. A
// pair of the whole step is one of a half, at twice its time or at twice its time less one; and a
// pair of a half is one of the whole.
void check_halves(CaseFacts& facts, LawTally& tally);

// The run with every committed step in two halves; nothing if some middle place is no double.
std::optional<PinnedRun> halved_run(const PinnedRun& whole);

}  // namespace assay::properties
