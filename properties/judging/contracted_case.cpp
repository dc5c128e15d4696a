#include "properties/judging/contracted_case.h"

#include <map>
#include <vector>

#include "oracle/instant/nearness.h"
#include "properties/judging/judged_query.h"
#include "properties/worker/plugin/query_case.h"

namespace assay::properties {
namespace {

// Whether the contract takes a step that starts with the mesh at x.
bool may_start_at(const detector::PositionsView& x, const detector::TrianglesView& triangles,
                  const Contract& contract) {
  const double distance = contract.start == StartRule::apart ? contract.start_distance : 0;
  return !oracle::any_nearer_than(x, triangles, distance, [&](std::int32_t a, std::int32_t b) {
    return !leaves_out(contract, triangles, {a, b});
  });
}

// From a list with an entry for each frame, takes the entries of these frames. An empty list stays
// empty.
template <class List>
List entries_of(const List& list, const std::vector<std::int32_t>& frames) {
  List out;
  for (const auto frame : frames) {
    const auto place = static_cast<std::size_t>(frame);
    if (place < list.size()) out.push_back(list[place]);
  }
  return out;
}

}  // namespace

corpus::Case with_steps(const corpus::Case& c, const std::vector<std::size_t>& places) {
  const auto steps = corpus::steps_of(c);
  corpus::Case out = c;
  out.script.clear();
  out.expected.steps.clear();
  std::vector<std::int32_t> used;
  std::map<std::int32_t, std::int32_t> renumbered;
  const auto use = [&](std::int32_t frame) {
    const auto [entry, is_new] =
        renumbered.try_emplace(frame, static_cast<std::int32_t>(used.size()));
    if (is_new) used.push_back(frame);
    return entry->second;
  };
  for (const std::size_t place : places) {
    const auto from = use(steps[place].from);
    out.script.push_back({from, use(steps[place].to), steps[place].commit});
    if (place < c.expected.steps.size()) out.expected.steps.push_back(c.expected.steps[place]);
  }
  out.frames = entries_of(c.frames, used);
  if (c.view)
    out.view = corpus::CaseView{entries_of(c.view->q0, used), entries_of(c.view->q1, used)};
  if (c.ghosts) out.ghosts->apexes = entries_of(c.ghosts->apexes, used);
  if (out.script == corpus::consecutive_steps(out.frames.size())) out.script.clear();
  return out;
}

std::optional<corpus::Case> contracted(const corpus::Case& c, const Contract& contract) {
  corpus::Case out = c;
  for (auto& frame : out.frames) {
    frame = contracted(frame, contract.coordinates);
    if (!frame.allFinite() || !in_range(frame, contract)) return std::nullopt;
  }
  if (says_query(out)) {
    const auto query = query_of(out);
    return query && takes(contract, *query) ? std::optional(out) : std::nullopt;
  }
  if (contract.start == StartRule::any) return out;
  const auto steps = corpus::steps_of(out);
  std::map<std::int32_t, bool> may_start;  // by frame
  std::vector<std::size_t> places;
  for (std::size_t s = 0; s < steps.size(); ++s) {
    const auto [entry, is_new] = may_start.try_emplace(steps[s].from, false);
    if (is_new) entry->second = may_start_at(start_of(out, steps[s]), out.triangles, contract);
    if (entry->second) places.push_back(s);
  }
  if (places.empty()) return std::nullopt;
  return places.size() == steps.size() ? out : with_steps(out, places);
}

}  // namespace assay::properties
