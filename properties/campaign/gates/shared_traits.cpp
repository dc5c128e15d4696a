#include "properties/campaign/gates/shared_traits.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <optional>
#include <set>
#include <tuple>
#include <vector>

#include "corpus/cases/case_file.h"
#include "detector/mesh/enum_names.h"
#include "detector/mesh/topology.h"
#include "properties/campaign/ledger/run_folder.h"
#include "properties/campaign/trials/planned_case.h"
#include "properties/judging/cause.h"
#include "properties/judging/judged_run.h"
#include "properties/queries/query_families.h"
#include "properties/worker/plugin/query_case.h"

namespace assay::properties {
namespace {

using Words = std::set<std::string>;

struct Traits {
  Words words;
  std::uint64_t triangles = 0;  // of its mesh; 0: of a query
};

// The words of a cause, and the opposites of those that it leaves out because they are ordinary.
void add_cause(Words& words, const std::string& cause) {
  for (std::size_t begin = 0; begin < cause.size();) {
    const auto end = std::min(cause.find(", ", begin), cause.size());
    words.insert(cause.substr(begin, end - begin));
    begin = end + 2;
  }
  constexpr std::array<std::array<const char*, 2>, 2> opposites = {
      {{"sharing", "sharing nothing"}, {"near contact", "apart at the start"}}};
  for (const auto& [mark, otherwise] : opposites) {
    if (cause.find(mark) == std::string::npos) words.insert(otherwise);
  }
}

// The traits of a mesh, and of two of its triangles.
class MeshTraits {
 public:
  explicit MeshTraits(const corpus::Case& c)
      : is_query_(query_of(c).has_value()),
        mesh_(detector::make_topology(c.triangles, c.frames.front().rows())) {}

  // A query has no mesh.
  std::uint64_t add_to(Words& words, const detector::TrianglePair& pair) const {
    if (is_query_) return 0;
    const auto of = [&](std::int32_t t) { return mesh_.component_of_triangle[detector::at(t)]; };
    words.insert(of(pair.a) == of(pair.b) ? "within one component" : "between two components");
    const bool closed = std::ranges::all_of(mesh_.components, &detector::Component::is_cycle);
    words.insert(closed ? "a closed mesh" : "an unclosed mesh");
    return mesh_.triangles.size();
  }

 private:
  const bool is_query_;
  const detector::Topology mesh_;
};

std::vector<Traits> contacts_of(const corpus::Case& c, const Contract& contract) {
  std::vector<Traits> contacts;
  const MeshTraits mesh(c);
  const bool is_query = query_of(c).has_value(), of_distance = contract.separation > 0;
  const auto judged = judge_case(c, contract);
  for (std::size_t s = 0; s < judged.size(); ++s) {
    const auto step = corpus::steps_of(c)[s];
    const detector::SteppedMesh motion{start_of(c, step), end_of(c, step)};
    for (const auto& contact : truth_of(c, judged[s], contract).pairs) {
      auto& [words, triangles] = contacts.emplace_back();
      words.insert(name_of(contact.feature.kind));
      add_cause(words, text_of(is_query ? cause_of_query(c.triangles, motion, contact, of_distance)
                                        : cause_of(c.triangles, motion, contact, of_distance)));
      triangles = mesh.add_to(words, contact.pair);
    }
  }
  return contacts;
}

// What its signature tells of the contact that a failure lost: "edge-edge, t inside, moving". Of a
// late pair it tells no features, because another contact of the pair was found.
std::optional<std::string> lost_contact(const std::string& signature) {
  for (const std::string kind : {": answered free, ", ": late, ", ": missing pair, "}) {
    const auto at = signature.find(kind);
    if (at != std::string::npos && !signature.starts_with(law_in_signature))
      return signature.substr(at + kind.size());
  }
  return std::nullopt;
}

// The traits of the contact that a failure lost; nothing if it lost none.
std::optional<Traits> traits_of(const StoredFailure& failure) {
  const auto contact = lost_contact(failure.signature);
  const auto c = corpus::parse_case(failure.mesh, "stored case");
  if (failure.flaky || !contact || !c) return std::nullopt;
  Traits traits;
  add_cause(traits.words, *contact);
  detector::TrianglePair pair{0, 1};
  const bool is_told =
      std::sscanf(failure.explanation.c_str(), "triangles %d and %d", &pair.a, &pair.b) == 2;
  const auto triangles = c.value().triangles.rows();
  if (is_told && std::min(pair.a, pair.b) >= 0 && std::max(pair.a, pair.b) < triangles)
    traits.triangles = MeshTraits(c.value()).add_to(traits.words, pair);
  return traits;
}

// The traits of the contacts of each of up to so many cases that hold, of those that have one.
std::vector<std::vector<Traits>> traits_that_hold(const RunFindings& findings, std::size_t most) {
  std::vector<std::pair<std::string, std::string>> trials;  // family, id
  for (const auto& file : value_or_throw(stored_runs(findings.folder))) {
    value_or_throw(Store::read(file)).for_each_trial([&](const TrialRecord& trial) {
      const bool holds =
          trial.outcomes.find_first_not_of(letter_of(Outcome::holds)) == std::string::npos;
      if (holds && trial.collisions > 0 && !is_size_family(trial.family))
        trials.emplace_back(trial.family, trial.id);
    });
  }
  std::vector<std::vector<Traits>> held;
  const auto count = std::min(most, trials.size());
  const auto& contract = findings.run.detector.contract;
  for (std::size_t i = 0; i < count; ++i) {
    const auto& [family, id] = trials[i * trials.size() / count];
    const auto c = case_within(contract, *find_family(family), id).seen;
    if (!c) continue;
    held.push_back(contacts_of(*c, contract));
  }
  return held;
}

// In how many of the cases some contact has all of the words, in a mesh of at least so many
// triangles.
std::size_t cases_with(const std::vector<std::vector<Traits>>& cases, const Words& words,
                       std::uint64_t triangles) {
  return static_cast<std::size_t>(std::ranges::count_if(cases, [&](const auto& contacts) {
    return std::ranges::any_of(contacts, [&](const Traits& traits) {
      return traits.triangles >= triangles && std::ranges::includes(traits.words, words);
    });
  }));
}

}  // namespace

std::string shared_traits_text(const RunFindings& findings) {
  constexpr std::size_t most_that_hold = 100;
  constexpr double most_by_chance = 1e-4;  // some thirty traits are tried
  Words kinds, cases, shared;
  std::uint64_t least = ~std::uint64_t{0};
  for (const auto& failure : findings.failures) {
    const auto traits = traits_of(failure);
    if (!traits) continue;
    Words both;
    std::ranges::set_intersection(shared, traits->words, std::inserter(both, both.end()));
    shared = kinds.empty() ? traits->words : both;
    least = std::min(least, traits->triangles);
    kinds.insert(failure.signature);
    cases.insert(failure.id);
  }
  if (kinds.size() < 2) return "";
  const auto held = traits_that_hold(findings, most_that_hold);

  // The most telling trait first, then each that leaves at most half of the cases that hold.
  Words told;
  std::vector<std::string> in_order;
  std::uint64_t triangles = 0;
  auto left = held.size();
  for (bool tells = true; tells && left > 0;) {
    tells = false;
    std::string best;
    auto fewest = left / 2 + 1;
    for (const auto& word : shared) {
      Words with = told;
      with.insert(word);
      const auto others = cases_with(held, with, triangles);
      if (others < fewest) std::tie(fewest, best, tells) = std::tuple(others, word, true);
    }
    const auto large = cases_with(held, told, least);
    if (large < fewest) {
      fewest = large;
      triangles = least;
      in_order.push_back(fmt::format("at least {} triangles", least));
      tells = true;
    } else if (tells) {
      told.insert(best);
      in_order.push_back(best);
    }
    left = fewest;
  }
  // How likely so many failing cases have them by chance, if they are as frequent as in those that
  // hold, or a little more.
  const double share = (static_cast<double>(left) + 1) / (static_cast<double>(held.size()) + 1);
  if (in_order.empty() || std::pow(share, cases.size()) > most_by_chance) return "";
  return fmt::format(
      "all {} kinds that lose a contact: {} ({} of {} cases that hold {} such a contact)\n",
      kinds.size(), fmt::join(in_order, ", "), left, held.size(), left == 1 ? "has" : "have");
}

}  // namespace assay::properties
