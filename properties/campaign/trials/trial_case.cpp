#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "detector/boundary/boundary_handler.h"
#include "detector/detector.h"
#include "oracle/instant/layers.h"
#include "oracle/mesh/mesh_features.h"
#include "properties/campaign/trials/trials.h"
#include "properties/changes/changes.h"
#include "properties/generators/draft.h"
#include "properties/generators/parts.h"
#include "properties/judging/contracted_case.h"
#include "properties/judging/exam.h"
#include "properties/queries/query_families.h"
#include "properties/worker/child_process.h"

namespace assay::properties {

namespace {

double shortest_edge_of(const Case& c) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const auto& edge : edges_of(c)) {
    for (const auto& frame : c.frames) {
      const double length = length_of(frame, edge);
      if (length > 0) shortest = std::min(shortest, length);
    }
  }
  return shortest;
}

// Returns the power of two that brings the case into the range, or as near to it as possible.
int exponent_into_range(const Case& c, const Contract& contract) {
  const double largest = greatest_of(c);
  if (largest == 0) return 0;
  int most = std::ilogb(contract.largest) - std::ilogb(largest);
  if (std::ldexp(largest, most) > contract.largest) --most;
  if (most < 0) return most;
  const double shortest = shortest_edge_of(c), least = contract.least_nonzero;
  if (shortest >= least) return 0;
  const int exponent = std::ilogb(least) - std::ilogb(shortest);
  return std::min(most, std::ldexp(shortest, exponent) < least ? exponent + 1 : exponent);
}

// Returns x times 2^exponent, or 0 if the scaling would round it.
double scaled(double x, int exponent) {
  const double y = std::ldexp(x, exponent);
  return std::ldexp(y, -exponent) == x ? y : 0;
}

// Returns the length of most edges of a large mesh, and the longest side of a small one. A
// contract's distances are measured in this unit, so that no large mesh lies within them as a
// whole.
double unit_of(const Case& c) {
  constexpr Eigen::Index largest_small_mesh = 400;
  if (c.triangles.rows() <= largest_small_mesh) return extent_of(c);
  auto edges = edges_of(c);
  const auto middle = edges.begin() + static_cast<std::ptrdiff_t>(edges.size() / 2);
  const auto length = [&](const Edge& edge) { return length_of(c.frames.front(), edge); };
  std::nth_element(edges.begin(), middle, edges.end(),
                   [&](const Edge& a, const Edge& b) { return length(a) < length(b); });
  return length(*middle);
}

// Returns whether a case may be scaled until its largest coordinate is this.
bool fits(double largest, const Contract& contract) {
  constexpr double far_enough = 1e100;  // no mesh of anybody is larger
  return largest <= (contract.has_range() ? contract.largest : far_enough);
}

// Returns the power of two by which the case is scaled.
int exponent_within(const Case& c, const Contract& contract) {
  const double largest = greatest_of(c), extent = unit_of(c);
  const int into_range = contract.has_range() ? exponent_into_range(c, contract) : 0;
  if (contract.separation > 0 && extent > 0) {
    // The mesh becomes twice to 512 times as large as the separation, so that some of its parts are
    // nearer.
    Random random(c.id);
    const int most = extent == extent_of(c) ? 9 : 3;
    const int exponent =
        std::ilogb(contract.separation) + random.between(1, most) - std::ilogb(extent);
    if (fits(std::ldexp(largest, exponent), contract)) return exponent;
  }
  const double size = contract.start == StartRule::apart ? 8 * contract.start_distance : 0;
  if (!(extent > 0) || !(std::ldexp(extent, into_range) < size) || !std::isfinite(size))
    return into_range;
  const int apart = std::ilogb(size) - std::ilogb(extent) + 1;
  return fits(std::ldexp(largest, apart), contract) ? apart : into_range;
}

// Returns whether every fourth case of this family has to have a contact.
bool leaves_contacts_out(const Contract& contract, const Family& family) {
  return is_query_family(family.name) || contract.adjacency != Adjacency::all ||
         contract.start != StartRule::any || contract.tests_part() || contract.separation > 0;
}

bool is_every_fourth(const std::string& id) {
  const auto digits = id.substr(id.rfind(':') + 1);
  return !digits.empty() && std::strtoull(digits.c_str(), nullptr, 10) % 4 == 0;
}

// Returns whether cases may be aimed: every second case of a question about distance is.
bool may_be_aimed(const Contract& contract) {
  return least_aimed <= contract.separation && contract.separation <= most_aimed;
}

// The oracle's facts about a case: whether some step has a contact that counts, and whether some
// step is not near at its start. A step that starts near is judged, but shows little.
struct CaseContacts {
  bool contact = false, start_apart = false;
};

CaseContacts contacts_of(const Case& c, const Contract& contract) {
  CaseContacts contacts;
  for (const auto& step : judge_case(c, contract)) {
    const auto truth = truth_of(c, step, contract);
    contacts.start_apart |= !truth.starts_near;
    contacts.contact |= truth.first && !truth.starts_near;
  }
  return contacts;
}

}  // namespace

Case brought_into_contract(Case c, const Contract& contract) {
  const int exponent = exponent_within(c, contract);
  if (exponent == 0 && !contract.has_range()) return c;
  for (double* x : numbers_along(c)) *x = scaled(*x, exponent);
  if (c.counted) {
    auto& pairs = c.counted->pairs;
    for (auto& place : pairs.rest) {
      for (double& x : place) x = scaled(x, exponent);
    }
    pairs.rest_distance = scaled(pairs.rest_distance, exponent);
  }
  return c;
}

TrialCase case_within(const Contract& contract, const Family& family, const std::string& id) {
  // A large case need not have a contact, because the oracle would take long to tell.
  const bool is_large = family.triangles > 0;
  const bool wants_contact =
      !is_large && leaves_contacts_out(contract, family) && is_every_fourth(id);
  TrialCase last;
  std::uint64_t without_contact = 0;
  for (std::uint64_t redrawn = 0; redrawn <= most_redrawn; ++redrawn) {
    const auto attempt = redrawn == 0 ? id : fmt::format("{}~{}", id, redrawn);
    TrialCase trial;
    trial.source = make_case(family, attempt);
    trial.source.c = brought_into_contract(std::move(trial.source.c), contract);
    Random random(attempt + ":aimed");  // other numbers than those of the case
    if (!is_large && may_be_aimed(contract) && random.one_in(2))
      trial.source.c = with_approach(std::move(trial.source.c), contract.separation, random);
    trial.input = contract_case(trial.source.c, contract);
    trial.redrawn = redrawn;
    if (trial.input) {
      trial.steps_left_out = steps_of(trial.source.c).size() - steps_of(*trial.input).size();
      if (!wants_contact && (contract.separation == 0 || is_large)) return trial;
      const auto contacts = contacts_of(*trial.input, contract);
      if (!contacts.start_apart) {
        trial.input.reset();
      } else if (!wants_contact || contacts.contact || ++without_contact > most_without_contact) {
        return trial;
      }
    }
    if (trial.input || !last.input) last = std::move(trial);
  }
  if (!last.input) last.redrawn = most_redrawn + 1;
  return last;
}

namespace {

bool is_clean(const Positions& all, const Triangles& triangles, const Triangles& ghosts) {
  const auto layers = oracle::layers_at(oracle::Instant(all), triangles, ghosts);
  return std::ranges::all_of(layers.clean, [](std::uint8_t is_clean) { return is_clean != 0; });
}

// Does the same with the ghosts of the built-in detector, which it places by this arithmetic.
bool starts_clean_with_ghosts(const Case& c, Arithmetic arithmetic) {
  Options options;
  options.culling = Culling::view_line;
  options.arithmetic = arithmetic;
  auto creation = detector::Detector::create(c.triangles, c.frames.front(), options);
  if (!creation) return false;
  const auto& all = creation.value().surface().all().triangles;
  const auto own = static_cast<std::size_t>(c.triangles.rows());
  const auto ghosts = as_rows<Triangles>(std::span(all).subspan(own));
  const auto starts = new_starts(c);
  const auto script = steps_of(c);
  return std::ranges::all_of(starts, [&](std::size_t s) {
    const auto& start = start_of(c, script[s]);
    const auto result = creation.value().evaluate(start, start);
    return is_clean(detector::with_apexes(start, result.apexes, false), c.triangles, ghosts);
  });
}

}  // namespace

bool starts_clean(const Case& c) {
  const Triangles no_ghosts(0, 3);
  if (oracle::closes(c.triangles, no_ghosts)) {
    const auto starts = new_starts(c);
    const auto script = steps_of(c);
    return std::ranges::all_of(starts, [&](std::size_t s) {
      return is_clean(start_of(c, script[s]), c.triangles, no_ghosts);
    });
  }
  const auto run = in_a_copy([&](const Say& say) {
    if (starts_clean_with_ghosts(c, Arithmetic::exact) &&
        starts_clean_with_ghosts(c, Arithmetic::bounded))
      say("clean");
  });
  return run.output == "clean";
}

bool is_vouched_for(const DetectorUnderTest& detector, const Case& c, std::uint64_t index) {
  constexpr Eigen::Index most_triangles = 400;
  return detector.built_in && index % 2 == 1 && c.triangles.rows() <= most_triangles &&
         starts_clean(c);
}

std::vector<Configuration> with_clean_start(std::vector<Configuration> configurations) {
  for (auto& configuration : configurations) {
    if (configuration.options.start == detector::Start::verified)
      configuration.options.start = detector::Start::clean;
  }
  return configurations;
}

}  // namespace assay::properties
