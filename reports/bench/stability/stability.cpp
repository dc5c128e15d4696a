#include "reports/bench/stability/stability.h"

#include <algorithm>

#include "oracle/view/view_sign.h"
#include "properties/judging/case_options.h"
#include "properties/worker/case_run.h"
#include "reports/bench/sweep.h"

namespace assay::reports {

using detector::StepResult;
using detector::ViewSign;

std::vector<StabilitySubject> all_arithmetics() {
  std::vector<StabilitySubject> subjects;
  for (const auto arithmetic : all_values<detector::Arithmetic>)
    subjects.push_back({name_of(arithmetic), arithmetic});
  return subjects;
}

StepResult run_hard_case(const corpus::Case& c, const StabilitySubject& subject) {
  detector::Options options = properties::options_of(c);
  if (!c.options.contains("culling")) options.culling = detector::Culling::view_point;
  options.arithmetic = subject.arithmetic;
  auto made = properties::CasePlayer::make(c, options, subject.stages(options));
  if (!made) {
    StepResult refused;
    refused.problem = made.error();
    return refused;
  }
  return made.value().look(0);
}

HardTruth::HardTruth(const corpus::Case& c)
    : case_(c), judgement_(oracle::judge_step({c.frames[0], c.frames[1]}, c.triangles, {})) {
  component_of_triangle_ =
      detector::make_topology(c.triangles, c.frames[0].rows()).component_of_triangle;
}

bool HardTruth::agrees_with_construction() const {
  const auto& known = case_.expected.steps.front();
  if (judgement_.answer != known.answer) return false;
  if (known.first_time && judgement_.first != *known.first_time) return false;
  if (!known.view_signs) return true;
  const auto view = corpus::view_of_step(case_, 0);
  return oracle::view_signs({case_.frames[0], case_.frames[1]}, case_.triangles, {&*view, 1}, 1) ==
         *known.view_signs;
}

const std::vector<ViewSign>& HardTruth::signs(const StepResult& result) {
  const auto same_place = [](const detector::ViewPrimitive& a, const detector::ViewPrimitive& b) {
    return a.q0.t0 == b.q0.t0 && a.q0.t1 == b.q0.t1 && a.q1.t0 == b.q1.t0 && a.q1.t1 == b.q1.t1;
  };
  const auto& from = result.primitives;
  if (!signs_.empty() &&
      std::equal(from.begin(), from.end(), seen_from_.begin(), seen_from_.end(), same_place)) {
    return signs_;
  }
  seen_from_ = from;
  std::vector<detector::ViewPrimitive> of_triangle;
  for (const auto component : component_of_triangle_) {
    of_triangle.push_back(from[static_cast<std::size_t>(component)]);
  }
  signs_ = oracle::view_signs({case_.frames[0], case_.frames[1]}, case_.triangles, of_triangle, 1);
  return signs_;
}

StabilityCell& StabilityCell::operator+=(const StabilityCell& other) {
  for (const auto member :
       {&StabilityCell::cases, &StabilityCell::right, &StabilityCell::exactly_right,
        &StabilityCell::refuted, &StabilityCell::wrong_signs})
    this->*member += other.*member;
  errors += other.errors;
  return *this;
}

StabilityCell judge_hard_case(const StepResult& result, HardTruth& truth,
                              detector::Arithmetic arithmetic) {
  using properties::Outcome;
  const auto& judged = truth.judgement();
  const auto holds = [&](const detector::Options& options) {
    return properties::compare(result, judged, properties::claims_of(options)).outcome ==
           Outcome::holds;
  };
  StabilityCell out;
  out.cases = 1;
  out.errors = errors_of(properties::compare(result, judged, properties::claims_of({}), {},
                                             truth.of_case().triangles));
  bool all_signs = true;
  if (!result.signs.empty()) {
    const auto& signs = truth.signs(result);
    for (std::size_t t = 0; t < signs.size(); ++t) {
      if (result.signs[t] == signs[t]) continue;
      all_signs = false;
      if (result.signs[t] != ViewSign::zero) out.wrong_signs = 1;
    }
  }
  const auto& e = out.errors;
  const bool finds_all = e.undecided + e.missed + e.missing + e.alarming == 0;
  out.right = finds_all && !(out.wrong_signs > 0 && truth.of_case().view) ? 1 : 0;
  out.exactly_right = out.right > 0 && all_signs && holds({}) ? 1 : 0;
  out.refuted = out.wrong_signs > 0 || !holds({.arithmetic = arithmetic}) ? 1 : 0;
  return out;
}

namespace {

std::vector<int> strengths_of(const corpus::HardFamily& family, int step) {
  std::vector<int> strengths;
  for (int s = 0; s < family.strongest; s += step) strengths.push_back(s);
  strengths.push_back(family.strongest);
  if (family.touching > 0) strengths.push_back(family.last_strength());
  return strengths;
}

StabilityCell empty_cell(const corpus::HardFamily& family, const std::string& arithmetic,
                         int strength) {
  StabilityCell cell;
  cell.family = family.name;
  cell.arithmetic = arithmetic;
  cell.strength = strength;
  cell.exponent = family.exponent(strength);
  cell.touches = family.touches(strength);
  cell.knob = family.knob;
  if (!family.unit.empty()) cell.knob.append(", ").append(family.unit);
  return cell;
}

void add_result(const StepResult& result, const StabilityCell& judged, const std::string& id,
                FamilyStability& to) {
  to.cells.back() += judged;
  if (judged.exactly_right == 0 && to.first_wrong.empty()) to.first_wrong = id;
  if (judged.refuted > 0 && to.first_refuted.empty()) to.first_refuted = id;
  to.rungs += result.counts.narrow.rungs;
  to.view_rungs += result.counts.view;
}

// Adds a case. Returns whether the oracle finds in it what it was built for.
bool add_case(const corpus::Case& c, std::span<const StabilitySubject> subjects,
              std::vector<FamilyStability>& results) {
  HardTruth truth(c);
  std::vector<StepResult> originals;
  for (std::size_t i = 0; i < subjects.size(); ++i) {
    originals.push_back(run_hard_case(c, subjects[i]));
    add_result(originals.back(), judge_hard_case(originals.back(), truth, subjects[i].arithmetic),
               c.id, results[i]);
  }
  // Crowds of more triangles than this take long, so they are run as they are and not changed.
  constexpr Eigen::Index most_triangles_changed = 600;
  if (c.triangles.rows() > most_triangles_changed) return truth.agrees_with_construction();
  for (std::size_t k = 0; k < case_changes().size(); ++k) {
    const auto changed = case_changes()[k].make(c);
    if (!changed) continue;
    for (std::size_t i = 0; i < subjects.size(); ++i) {
      const bool times = subjects[i].arithmetic == detector::Arithmetic::exact;
      Survival& survival = results[i].survivals[k];
      ++survival.changed;
      survival.same += same_but_for_numbering(
          originals[i], run_hard_case(changed->changed, subjects[i]), changed->triangle, times);
    }
  }
  return truth.agrees_with_construction();
}

}  // namespace

std::optional<int> FamilyStability::breaks_at() const {
  for (const auto& cell : cells) {
    if (cell.right < cell.cases) return cell.strength;
  }
  return std::nullopt;
}

StabilityCell FamilyStability::total() const {
  StabilityCell sum;
  for (const auto& cell : cells) sum += cell;
  return sum;
}

std::vector<FamilyStability> measure_stability(const corpus::HardFamily& family,
                                               std::span<const StabilitySubject> subjects,
                                               const StabilityPlan& plan,
                                               std::vector<std::string>& disagreements,
                                               const std::function<void()>& tick) {
  std::vector<FamilyStability> results(subjects.size());
  for (auto& result : results) result.survivals.resize(case_changes().size());
  for (const int strength : strengths_of(family, plan.strength_step)) {
    if (corpus::hard_case(family, strength, 0).triangles.rows() > plan.most_triangles) continue;
    for (std::size_t i = 0; i < subjects.size(); ++i)
      results[i].cells.push_back(empty_cell(family, subjects[i].name, strength));
    const int rounds = family.touches(strength) ? plan.touching_rounds : plan.rounds;
    for (int variant = 0; variant < rounds * family.kinds_at(strength); ++variant) {
      const auto c = corpus::hard_case(family, strength, variant);
      if (!add_case(c, subjects, results)) disagreements.push_back(c.id);
      tick();
    }
  }
  return results;
}

}  // namespace assay::reports
