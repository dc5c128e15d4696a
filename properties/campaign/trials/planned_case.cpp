#include "properties/campaign/trials/planned_case.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "oracle/instant/layers.h"
#include "oracle/mesh/loops.h"
#include "properties/judging/contracted_case.h"
#include "properties/judging/judged_run.h"
#include "properties/queries/query_families.h"
#include "properties/worker/plugin/query_case.h"

namespace assay::properties {

namespace {

double largest_of(const corpus::Case& c) {
  double largest = 0;
  for (const auto& frame : c.frames) {
    if (frame.size() > 0) largest = std::max(largest, frame.cwiseAbs().maxCoeff());
  }
  return largest;
}

double shortest_edge_of(const corpus::Case& c) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const auto& edge : edges_of(c)) {
    for (const auto& frame : c.frames) {
      const double length = length_of(frame, edge);
      if (length > 0) shortest = std::min(shortest, length);
    }
  }
  return shortest;
}

// By which power of two the case comes into the range, or as near to it as it does.
int exponent_into_range(const corpus::Case& c, const Contract& contract) {
  const double largest = largest_of(c);
  if (largest == 0) return 0;
  int most = std::ilogb(contract.largest) - std::ilogb(largest);
  if (std::ldexp(largest, most) > contract.largest) --most;
  if (most < 0) return most;
  const double shortest = shortest_edge_of(c), least = contract.least_nonzero;
  if (shortest >= least) return 0;
  const int wanted = std::ilogb(least) - std::ilogb(shortest);
  return std::min(most, std::ldexp(shortest, wanted) < least ? wanted + 1 : wanted);
}

// Multiplies by 2^exponent. The result is 0 if the scaling would round it.
double scaled(double x, int exponent) {
  const double y = std::ldexp(x, exponent);
  return std::ldexp(y, -exponent) == x ? y : 0;
}

template <class Places>
void scale_all(Places& places, int exponent) {
  for (auto& place : places) {
    for (double& x : place) x = scaled(x, exponent);
  }
}

// The longest side of the mesh's box in its first frame.
double extent_of(const corpus::Case& c) {
  const auto& x = c.frames.front();
  return x.rows() == 0 ? 0 : (x.colwise().maxCoeff() - x.colwise().minCoeff()).maxCoeff();
}

// The power of two by which the case is scaled.
int exponent_within(const corpus::Case& c, const Contract& contract) {
  const double largest = largest_of(c), extent = extent_of(c);
  const double wanted = contract.start == StartRule::apart ? 8 * contract.start_distance : 0;
  const int into_range = contract.has_range() ? exponent_into_range(c, contract) : 0;
  if (!(extent > 0) || !(std::ldexp(extent, into_range) < wanted) || !std::isfinite(wanted))
    return into_range;
  const int apart = std::ilogb(wanted) - std::ilogb(extent) + 1;
  constexpr double far_enough = 1e100;  // no mesh of anybody is larger
  const double most = contract.has_range() ? contract.largest : far_enough;
  return std::ldexp(largest, apart) <= most ? apart : into_range;
}

// Whether every fourth case of such cases has to have a contact.
bool leaves_contacts_out(const Contract& contract, const Family& family) {
  return is_query_family(family.name) || contract.adjacency != Adjacency::all ||
         contract.start != StartRule::any || contract.features != TestedFeatures::both;
}

bool is_every_fourth(const std::string& id) {
  const auto digits = id.substr(id.rfind(':') + 1);
  return !digits.empty() && std::strtoull(digits.c_str(), nullptr, 10) % 4 == 0;
}

bool has_contact(const corpus::Case& c, const Contract& contract) {
  const auto steps = judge_case(c, contract);
  return std::any_of(steps.begin(), steps.end(),
                     [&](const auto& step) { return truth_of(c, step, contract).first; });
}

}  // namespace

corpus::Case brought_into_contract(corpus::Case c, const Contract& contract) {
  const int exponent = exponent_within(c, contract);
  if (exponent == 0 && !contract.has_range()) return c;
  for (auto& frame : c.frames)
    frame = frame.unaryExpr([&](double x) { return scaled(x, exponent); }).eval();
  if (c.view) {
    scale_all(c.view->q0, exponent);
    scale_all(c.view->q1, exponent);
  }
  if (c.ghosts) {
    for (auto& apexes : c.ghosts->apexes) scale_all(apexes, exponent);
  }
  return c;
}

PlannedCase case_within(const Contract& contract, const Family& family, const std::string& id) {
  const bool wants_contact = leaves_contacts_out(contract, family) && is_every_fourth(id);
  PlannedCase last;
  std::uint64_t without_contact = 0;
  for (std::uint64_t redrawn = 0; redrawn <= most_redrawn; ++redrawn) {
    const auto attempt = redrawn == 0 ? id : fmt::format("{}~{}", id, redrawn);
    PlannedCase planned;
    planned.made = make_case(family, attempt);
    planned.made.c = brought_into_contract(std::move(planned.made.c), contract);
    planned.seen = contracted(planned.made.c, contract);
    planned.redrawn = redrawn;
    if (planned.seen) {
      planned.steps_left_out =
          corpus::steps_of(planned.made.c).size() - corpus::steps_of(*planned.seen).size();
      const bool may_stay = !wants_contact || ++without_contact > most_without_contact;
      if (may_stay || has_contact(*planned.seen, contract)) return planned;
    }
    if (planned.seen || !last.seen) last = std::move(planned);
  }
  if (!last.seen) last.redrawn = most_redrawn + 1;
  return last;
}

bool starts_clean(const corpus::Case& c) {
  const detector::Triangles no_ghosts(0, 3);
  if (!oracle::closes(c.triangles, no_ghosts)) return false;
  const corpus::CaseStep* committed = nullptr;
  const auto script = corpus::steps_of(c);
  for (const auto& step : script) {
    const auto& start = start_of(c, step);
    const bool is_new = committed == nullptr || start != end_of(c, *committed);
    if (is_new) {
      const auto layers = oracle::layers_at(oracle::Instant(start), c.triangles, no_ghosts);
      if (!std::all_of(layers.clean.begin(), layers.clean.end(),
                       [](std::uint8_t is_clean) { return is_clean != 0; })) {
        return false;
      }
    }
    if (step.commit) committed = &step;
  }
  return true;
}

bool is_vouched_for(const DetectorUnderTest& detector, const corpus::Case& c, std::uint64_t index) {
  return detector.built_in && index % 2 == 1 && starts_clean(c);
}

std::vector<Configuration> with_clean_start(std::vector<Configuration> configurations) {
  for (auto& configuration : configurations) {
    if (configuration.options.start == detector::Start::verified)
      configuration.options.start = detector::Start::clean;
  }
  return configurations;
}

}  // namespace assay::properties
