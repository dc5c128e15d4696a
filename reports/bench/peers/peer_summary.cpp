#include "reports/bench/peers/peer_summary.h"

#include <algorithm>

#include "reports/bench/bootstrap.h"
#include "reports/bench/peers/peer_runs.h"

namespace assay::reports {
namespace {

void add_samples(std::vector<double>& sums, const std::vector<double>& samples) {
  sums.resize(std::max(sums.size(), samples.size()));
  for (std::size_t r = 0; r < samples.size(); ++r) sums[r] += samples[r];
}

PeerFamily family_of(std::span<const PeerCase* const> cases, const PeerSubject& subject) {
  PeerFamily out;
  out.detector = subject.name;
  out.family = cases.front()->family;
  out.kind = cases.front()->kind;
  std::vector<double> ms, reference_ms;
  double create = 0, reference_create = 0;
  for (const auto* one : cases) {
    ++out.cases;
    out.counts.add(one->counts);
    out.slow += one->is_once ? 1 : 0;
    out.ended += one->ended.empty() ? 0 : 1;
    if (out.first_end.empty() && !one->ended.empty())
      out.first_end = one->case_id + ": " + one->ended;
    if (one->ms.empty()) continue;
    ++out.cases_timed;
    add_samples(ms, one->ms);
    add_samples(reference_ms, one->reference_ms);
    create += one->create_ms;
    reference_create += one->reference_create_ms;
  }
  if (out.cases_timed == 0) return out;
  out.over = bootstrap_ratio(ms, reference_ms);
  if (reference_create > 0) out.create_over = create / reference_create;
  return out;
}

std::string answers_of(const PeerSubject& subject, const PeerCounts& counts) {
  std::string text = "answer";
  if (counts.timed_collisions > 0) text += ", time";
  if (subject.contract.reports_pairs) text += ", pairs";
  return text;
}

}  // namespace

std::vector<PeerFamily> peers_by_family(std::span<const PeerCase> cases,
                                        const std::vector<PeerSubject>& subjects) {
  std::vector<PeerFamily> out;
  for (std::size_t begin = 0; begin < cases.size();) {
    std::size_t end = begin;
    while (end < cases.size() && cases[end].family == cases[begin].family) ++end;
    for (std::size_t i = 0; i < subjects.size(); ++i) {
      std::vector<const PeerCase*> of_subject;
      for (std::size_t c = begin; c < end; ++c) {
        if (cases[c].subject == i) of_subject.push_back(&cases[c]);
      }
      if (!of_subject.empty()) out.push_back(family_of(of_subject, subjects[i]));
    }
    begin = end;
  }
  return out;
}

std::vector<PeerRow> peer_rows(std::span<const PeerFamily> families,
                               const std::vector<PeerSubject>& subjects) {
  std::vector<PeerRow> rows;
  for (const auto& subject : subjects) {
    PeerRow row;
    row.detector = subject.name;
    row.version = subject.version;
    row.is_built_in = subject.is_built_in();
    row.claims_soundness = subject.claims.has(properties::Claim::free_sound);
    for (const auto claim : properties::list_of(subject.claims))
      row.claims.emplace_back(name_of(claim));
    row.contract = phrases_of(subject.contract);
    std::vector<double> over, create_over;
    for (const auto& family : families) {
      if (family.detector != subject.name) continue;
      row.counts.add(family.counts);
      row.slow += family.slow;
      row.ended += family.ended;
      if (!family.over) continue;
      over.push_back(family.over->value);
      if (family.create_over) create_over.push_back(*family.create_over);
    }
    row.families = over.size();
    row.answers = answers_of(subject, row.counts);
    if (!over.empty()) row.over = bootstrap_median(std::move(over));
    if (!create_over.empty()) row.create_over = median_of(std::move(create_over)).value;
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace assay::reports
