#include "reports/bench/stability/stability_family.h"

#include <algorithm>

#include "reports/bench/stability/stability_changes.h"

namespace assay::reports {
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

void note_first(std::string& first, bool happened, const std::string& id) {
  if (happened && first.empty()) first = id;
}

void add_outcome(const HardOutcome& outcome, const std::string& id, FamilyStability& to) {
  StabilityCell& cell = to.cells.back();
  ++cell.cases;
  cell.right += outcome.right;
  cell.exactly_right += outcome.exactly_right;
  cell.missed += outcome.missed;
  cell.late += outcome.late;
  cell.early += outcome.early;
  cell.spurious += outcome.spurious;
  cell.wrong_signs += outcome.wrong_signs;
  if (outcome.time_error != 0) {
    cell.time_errors.push_back(outcome.time_error);
    cell.time_errors_ulps.push_back(outcome.time_error_ulps);
  }
  note_first(to.first_wrong, !outcome.exactly_right, id);
  note_first(to.first_missed, outcome.missed || outcome.wrong_signs, id);
  note_first(to.first_late, outcome.late, id);
}

void add_rungs(const detector::StepResult& result, FamilyStability& to) {
  to.rungs += result.counts.narrow.rungs;
  to.view_rungs += result.counts.view;
}

class FamilyRun {
 public:
  FamilyRun(const corpus::HardFamily& family, std::span<const StabilitySubject> subjects)
      : family_(family), subjects_(subjects), results_(subjects.size()) {
    for (auto& result : results_) result.survivals.resize(case_changes().size());
  }

  void begin(int strength) {
    for (std::size_t i = 0; i < subjects_.size(); ++i) {
      results_[i].cells.push_back(empty_cell(family_, subjects_[i].name, strength));
    }
  }

  // Adds a case. Returns whether the oracle finds in it what it was built for.
  bool add(const corpus::Case& c) {
    HardTruth truth(c);
    std::vector<detector::StepResult> originals;
    for (std::size_t i = 0; i < subjects_.size(); ++i) {
      originals.push_back(run_hard_case(c, subjects_[i]));
      add_outcome(judge_hard_case(originals.back(), truth), c.id, results_[i]);
      add_rungs(originals.back(), results_[i]);
    }
    // Crowds of more triangles than this take long, so they are run as they are and not changed.
    constexpr Eigen::Index most_triangles_changed = 600;
    if (c.triangles.rows() > most_triangles_changed) return truth.agrees_with_construction();
    for (std::size_t k = 0; k < case_changes().size(); ++k) {
      const auto changed = case_changes()[k].make(c);
      if (!changed) continue;
      for (std::size_t i = 0; i < subjects_.size(); ++i) {
        const bool times = subjects_[i].arithmetic == detector::Arithmetic::exact;
        Survival& survival = results_[i].survivals[k];
        ++survival.changed;
        survival.same += same_but_for_numbering(
            originals[i], run_hard_case(changed->changed, subjects_[i]), changed->triangle, times);
      }
    }
    return truth.agrees_with_construction();
  }

  std::vector<FamilyStability> results() && { return std::move(results_); }

 private:
  const corpus::HardFamily& family_;
  std::span<const StabilitySubject> subjects_;
  std::vector<FamilyStability> results_;
};

}  // namespace

std::optional<int> FamilyStability::breaks_at() const {
  for (const auto& cell : cells) {
    if (cell.right < cell.cases) return cell.strength;
  }
  return std::nullopt;
}

StabilityCell FamilyStability::total() const {
  StabilityCell sum;
  for (const auto& cell : cells) {
    sum.family = cell.family;
    sum.arithmetic = cell.arithmetic;
    sum.cases += cell.cases;
    sum.right += cell.right;
    sum.exactly_right += cell.exactly_right;
    sum.missed += cell.missed;
    sum.late += cell.late;
    sum.early += cell.early;
    sum.spurious += cell.spurious;
    sum.wrong_signs += cell.wrong_signs;
    sum.time_errors.insert(sum.time_errors.end(), cell.time_errors.begin(), cell.time_errors.end());
    sum.time_errors_ulps.insert(sum.time_errors_ulps.end(), cell.time_errors_ulps.begin(),
                                cell.time_errors_ulps.end());
  }
  return sum;
}

std::vector<FamilyStability> measure_stability(const corpus::HardFamily& family,
                                               std::span<const StabilitySubject> subjects,
                                               const StabilityPlan& plan,
                                               std::vector<std::string>& disagreements,
                                               const std::function<void()>& tick) {
  FamilyRun run(family, subjects);
  for (const int strength : strengths_of(family, plan.strength_step)) {
    if (corpus::hard_case(family, strength, 0).triangles.rows() > plan.most_triangles) continue;
    run.begin(strength);
    const int rounds = family.touches(strength) ? plan.touching_rounds : plan.rounds;
    for (int variant = 0; variant < rounds * family.kinds_at(strength); ++variant) {
      const auto c = corpus::hard_case(family, strength, variant);
      if (!run.add(c)) disagreements.push_back(c.id);
      tick();
    }
  }
  return std::move(run).results();
}

}  // namespace assay::reports
