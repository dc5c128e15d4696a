#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include "detector/mesh/enum_names.h"
#include "detector/mesh/topology.h"
#include "properties/campaign/gates/gates.h"
#include "properties/campaign/trials/trials.h"
#include "properties/judging/cause.h"
#include "properties/judging/exam.h"
#include "properties/queries/query_families.h"
#include "properties/reducer/reducer.h"
#include "properties/worker/plugin/query_case.h"

namespace assay::properties {
namespace {

using Words = std::set<std::string>;

// Returns the words of a text such as "edge-edge, t inside".
Words words_in(const std::string& text) {
  Words words;
  for (std::size_t begin = 0; begin < text.size();) {
    const auto end = std::min(text.find(", ", begin), text.size());
    words.insert(text.substr(begin, end - begin));
    begin = end + 2;
  }
  return words;
}

// Adds the words of a cause, and the opposites of those that it leaves out because they are
// ordinary.
void add_cause(Words& words, const std::string& cause) {
  words.merge(words_in(cause));
  constexpr std::array<std::array<const char*, 2>, 2> opposites = {
      {{"sharing", "sharing nothing"}, {"near contact", "apart at the start"}}};
  for (const auto& [mark, otherwise] : opposites) {
    if (cause.find(mark) == std::string::npos) words.insert(otherwise);
  }
  if (!words.contains("sharing nothing")) words.insert("neighbours");
}

// The traits of a mesh, and of two of its triangles.
class MeshTraits {
 public:
  explicit MeshTraits(const Case& c)
      : is_query_(query_of(c).has_value()),
        mesh_(detector::make_topology(c.triangles, c.frames.front().rows())) {}

  // Adds the traits of the mesh, and of this pair. A query has no mesh.
  void add_to(Words& words, const TrianglePair& pair) const {
    if (is_query_) return;
    const auto of = [&](std::int32_t t) { return mesh_.component_of_triangle[detector::at(t)]; };
    words.insert(of(pair.a) == of(pair.b) ? "within one component" : "between two components");
    const bool is_closed = std::ranges::all_of(mesh_.components, &detector::Component::is_cycle);
    words.insert(is_closed ? "a closed mesh" : "an unclosed mesh");
    for (std::size_t decade = 1; decade <= mesh_.triangles.size(); decade *= 10) {
      for (const auto least : {decade, 2 * decade, 5 * decade}) {
        if (least > 2 && least <= mesh_.triangles.size())
          words.insert(fmt::format("at least {} triangles", least));
      }
    }
  }

 private:
  const bool is_query_;
  const detector::Topology mesh_;
};

// Adds which of the two triangles move, and how small the smaller one is at the start.
void add_motion(Words& words, const TrianglesView& triangles, const SteppedMesh& motion,
                const TrianglePair& pair) {
  int moving = 0;
  double area = std::numeric_limits<double>::infinity();
  for (const auto t : {pair.a, pair.b}) {
    const auto at_start = [&](int k) -> Eigen::Vector3d {
      return motion.vertices_t0.row(triangles(t, k)).transpose();
    };
    bool moves = false;
    for (const auto v : triangles.row(t))
      moves |= motion.vertices_t0.row(v) != motion.vertices_t1.row(v);
    moving += moves ? 1 : 0;
    const Eigen::Vector3d u = at_start(1) - at_start(0), w = at_start(2) - at_start(0);
    area = std::min(area, u.cross(w).norm() / 2);
  }
  if (moving > 0) words.insert(moving == 2 ? "both triangles move" : "one triangle rests");
  for (const double below : {1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12}) {
    if (area < below) words.insert(fmt::format("a triangle with an area below {}", below));
  }
}

// Returns the traits of the contacts of a case, of one pair alone if it is given.
std::vector<Words> contacts_of(const Case& c, const Contract& contract,
                               const TrianglePair* alone = nullptr) {
  std::vector<Words> contacts;
  const MeshTraits mesh(c);
  const bool is_query = query_of(c).has_value(), of_distance = contract.separation > 0;
  const auto judgements = judge_case(c, contract);
  for (std::size_t s = 0; s < judgements.size(); ++s) {
    const auto step = steps_of(c)[s];
    const SteppedMesh motion{start_of(c, step), end_of(c, step)};
    for (const auto& contact : truth_of(c, judgements[s], contract).pairs) {
      if (alone && contact.pair != *alone) continue;
      auto& words = contacts.emplace_back();
      words.insert(name_of(contact.feature.kind));
      add_cause(words, cause_of(c.triangles, motion, contact, of_distance, is_query));
      mesh.add_to(words, contact.pair);
      if (!is_query) add_motion(words, c.triangles, motion, contact.pair);
    }
  }
  return contacts;
}

// Returns the contacts of each of up to so many cases that hold and have a contact.
std::vector<std::vector<Words>> contacts_that_hold(const RunFindings& findings, std::size_t most) {
  std::vector<std::pair<std::string, std::string>> trials;  // family, id
  const auto take = [&](const TrialRecord& trial) {
    const bool holds =
        trial.outcomes.find_first_not_of(letter_of(Outcome::holds)) == std::string::npos;
    if (holds && trial.collisions > 0 && !is_size_family(trial.family))
      trials.emplace_back(trial.family, trial.id);
  };
  const auto reading = catch_store_problem([&] {
    for (const auto& file : value_or_throw(stored_runs(findings.folder)))
      value_or_throw(Store::read(file)).for_each_trial(take);
  });
  if (!reading) return {};  // the folder holds no run, or cannot be read any more
  std::vector<std::vector<Words>> contacts;
  const auto count = std::min(most, trials.size());
  const auto& contract = findings.run.detector.contract;
  for (std::size_t i = 0; i < count; ++i) {
    const auto& [family, id] = trials[i * trials.size() / count];
    const auto c = case_within(contract, *find_family(family), id).input;
    if (c) contacts.push_back(contacts_of(*c, contract));
  }
  return contacts;
}

// Returns the deed of failures of this kind.
std::string deed_of(const FailureRecord& failure) {
  const auto claim = from_name<Claim>(failure.claim);
  if (failure.flaky) return name_of(Deed::differs);
  if (!claim) return "break a law";
  // A first time is wrong in two ways.
  const bool is_early = failure.kind.starts_with("early");
  return name_of(is_early ? Deed::reports : row_of(*claim).deed);
}

// Returns the two triangles that the explanation names; nothing if the mesh lacks one.
std::optional<TrianglePair> pair_told(const std::string& explanation, const Case& c) {
  constexpr const char* word = "triangles ";
  TrianglePair pair{0, 0};
  for (auto at = explanation.find(word); at != std::string::npos;
       at = explanation.find(word, at + 1)) {
    if (std::sscanf(explanation.c_str() + at, "triangles %d and %d", &pair.a, &pair.b) != 2)
      continue;
    const auto [low, high] = std::minmax(pair.a, pair.b);
    if (low >= 0 && high < c.triangles.rows()) return pair;
  }
  return std::nullopt;
}

// Returns the traits of the contact that a failure lost: the contact of the named pair that the
// oracle finds and that fits the signature. For a large mesh, on which the oracle takes long, only
// the traits in the signature are known; a signature of the built-in detector has no cause.
Words traits_of(const FailureRecord& failure, const Contract& contract) {
  constexpr Eigen::Index most_triangles = 1000;
  Words words = words_in(failure.contact);
  const auto c = corpus::parse_case(failure.mesh, "stored case");
  const auto pair = c ? pair_told(failure.explanation, c.value()) : std::nullopt;
  if (!pair) return words;
  if (c.value().triangles.rows() <= most_triangles) {
    for (auto& exact : contacts_of(c.value(), contract, &*pair)) {
      if (std::ranges::includes(exact, words)) return std::move(exact);
    }
  }
  MeshTraits(c.value()).add_to(words, *pair);
  return words;
}

// A set of traits, a bit each.
using Traits = std::uint64_t;
constexpr std::size_t most_traits = 64;

bool holds(Traits all, Traits some) { return (all & some) == some; }

// A kind of failure that loses a contact, with the traits that all of its contacts share.
struct LossKind {
  std::string signature;
  Traits traits = ~Traits{0};
  Words cases;  // ids of those that show it
};

using LossKinds = std::vector<LossKind>;

// Sorts the kinds that lose a contact by the traits that set their contacts apart from contacts
// that were found.
struct Sorter {
  LossKinds kinds_;
  const std::vector<std::string> names_;
  const std::vector<std::vector<Traits>> contacts_;

  std::vector<FailureGroup> run() {
    std::vector<FailureGroup> groups;
    while (!kinds_.empty()) {
      const auto traits = next();
      LossKinds group, others;
      for (auto& kind : kinds_) (holds(kind.traits, traits) ? group : others).push_back(kind);
      kinds_ = std::move(others);
      groups.push_back(group_of(group));
    }
    return groups;
  }

 private:
  // Returns how many of the cases that hold have a contact with all of these traits.
  std::size_t holds_with(Traits traits) const {
    return static_cast<std::size_t>(std::ranges::count_if(contacts_, [&](const auto& contacts) {
      return std::ranges::any_of(contacts, [&](Traits of) { return holds(of, traits); });
    }));
  }

  static std::size_t cases_of(const LossKinds& kinds, Traits traits) {
    Words cases;
    for (const auto& kind : kinds) {
      if (holds(kind.traits, traits)) cases.insert(kind.cases.begin(), kind.cases.end());
    }
    return cases.size();
  }

  static Traits common(const LossKinds& kinds) {
    Traits all = ~Traits{0};
    for (const auto& kind : kinds) all &= kind.traits;
    return all;
  }

  // Returns minus the logarithm of the probability that so many failing cases have these traits by
  // chance, if traits are as frequent in failing cases as in cases that hold, or a little more.
  double surprise(std::size_t cases, Traits traits) const {
    const double share =
        (static_cast<double>(holds_with(traits)) + 1) / (static_cast<double>(contacts_.size()) + 1);
    return -static_cast<double>(cases) * std::log(share);
  }

  // Returns the traits of the next group: those that would be the greatest surprise by chance.
  // Traits that all remaining kinds share come first, unless they surprise less than half as much,
  // because one mistake is likelier than two. Returns no trait, for all remaining kinds, if nothing
  // is a surprise.
  Traits next() const {
    const Traits all = common(kinds_);
    const double of_all = surprise(cases_of(kinds_, 0), all);
    Traits best = 0;
    double most = least_surprise_of_some;
    for (std::size_t a = 0; a < names_.size(); ++a) {
      for (std::size_t b = a; b < names_.size(); ++b) {
        const Traits traits = Traits{1} << a | Traits{1} << b;
        const auto cases = cases_of(kinds_, traits);
        const double worth = surprise(cases, traits);
        if (cases < least_cases || worth < least_surprise_of_a_case * static_cast<double>(cases))
          continue;
        if (worth > most) most = worth, best = traits;
      }
    }
    return 2 * of_all >= most && of_all >= least_surprise_of_all ? all : best;
  }

  FailureGroup group_of(const LossKinds& kinds) const {
    FailureGroup group{name_of(Deed::loses), {}, {}, "", contacts_.size(), contacts_.size()};
    for (const auto& kind : kinds) group.kinds.push_back(kind.signature);
    const Traits shared = common(kinds);
    const auto cases = cases_of(kinds, 0);
    if (surprise(cases, shared) < least_surprise_of_all) return group;
    // Takes the most telling trait first, then each trait that leaves at most half of the cases
    // that hold, or two traits together if no single one does.
    Traits group_traits = 0;
    for (bool tells = true; tells && group.holds_with > 0;) {
      Traits best = 0;
      auto fewest = group.holds_with / 2 + 1;
      const auto offer = [&](Traits traits) {
        if (!holds(shared, traits)) return;
        const auto others = holds_with(group_traits | traits);
        if (others < fewest) fewest = others, best = traits;
      };
      for (std::size_t a = 0; a < names_.size(); ++a) offer(Traits{1} << a);
      for (std::size_t a = 0; best == 0 && a < names_.size(); ++a) {
        for (std::size_t b = 0; b < a; ++b) offer(Traits{1} << a | Traits{1} << b);
      }
      tells = best != 0;
      if (!tells) break;
      group_traits |= best;
      group.holds_with = fewest;
      for (std::size_t a = 0; a < names_.size(); ++a) {
        if (best >> a & 1) group.shared.push_back(names_[a]);
      }
    }
    if (surprise(cases, group_traits) < least_surprise_of_all) {
      group.shared.clear();
      group.holds_with = group.all_holds;
    }
    return group;
  }

  static constexpr double least_surprise_of_all = 9.21;    // 1e-4; some thirty traits are tried
  static constexpr double least_surprise_of_some = 13.82;  // 1e-6; some hundreds are
  static constexpr std::size_t least_cases = 3;
  static constexpr double least_surprise_of_a_case = 2.08;  // an eighth of the cases that hold
};

std::vector<FailureGroup> groups_of_lost(const RunFindings& findings,
                                         const std::vector<const FailureRecord*>& kinds) {
  constexpr std::size_t most_that_hold = 100;
  if (kinds.empty()) return {};
  std::map<std::string, std::size_t> numbers;
  const auto traits_in = [&](const Words& words, bool adds) {
    Traits traits = 0;
    for (const auto& word : words) {
      if (adds && numbers.size() < most_traits) numbers.emplace(word, numbers.size());
      if (const auto number = numbers.find(word); number != numbers.end())
        traits |= Traits{1} << number->second;
    }
    return traits;
  };
  LossKinds loss_kinds;
  for (const auto* kind : kinds) {
    auto& one = loss_kinds.emplace_back();
    one.signature = kind->signature();
    for (const auto& failure : findings.failures) {
      if (failure.signature() != one.signature) continue;
      one.traits &= traits_in(traits_of(failure, findings.run.detector.contract), true);
      one.cases.insert(failure.id());
    }
  }
  std::vector<std::vector<Traits>> contact_traits;
  for (const auto& contacts : contacts_that_hold(findings, most_that_hold)) {
    auto& of_case = contact_traits.emplace_back();
    for (const auto& words : contacts) of_case.push_back(traits_in(words, false));
  }
  std::vector<std::string> names(numbers.size());
  for (const auto& [word, number] : numbers) names[number] = word;
  return Sorter{std::move(loss_kinds), std::move(names), std::move(contact_traits)}.run();
}

}  // namespace

std::vector<FailureGroup> failure_groups(const RunFindings& findings) {
  std::vector<FailureGroup> groups;
  const auto kinds = findings.kinds();
  if (kinds.size() < 2) return {};
  std::vector<const FailureRecord*> losses;
  for (const auto* kind : kinds) {
    const auto deed = deed_of(*kind);
    if (deed == name_of(Deed::loses)) {
      losses.push_back(kind);
      continue;
    }
    auto group = std::ranges::find(groups, deed, &FailureGroup::does);
    if (group == groups.end()) group = groups.insert(group, {deed, {}, {}, ""});
    group->kinds.push_back(kind->signature());
  }
  for (auto& group : groups_of_lost(findings, losses)) groups.push_back(std::move(group));
  std::map<std::string, MeshSize> sizes;
  for (const auto* kind : kinds) {
    const auto& mesh = kind->smallest.empty() ? kind->mesh : kind->smallest;
    if (const auto c = corpus::parse_case(mesh, "stored case"))
      sizes[kind->signature()] = size_of(c.value());
  }
  const auto is_smaller = [&](const std::string& a, const std::string& b) {
    return sizes.contains(a) && (!sizes.contains(b) || sizes[a] < sizes[b]);
  };
  for (auto& group : groups) group.smallest = *std::ranges::min_element(group.kinds, is_smaller);
  std::ranges::stable_sort(groups, std::greater(),
                           [](const FailureGroup& group) { return group.kinds.size(); });
  return groups;
}

std::string text_of(const FailureGroup& group, std::size_t kinds) {
  const auto count = group.kinds.size();
  auto text = count == kinds
                  ? fmt::format("all {} kinds of failure {}", kinds, group.does)
                  : fmt::format("{} of {} kinds of failure {}", count, kinds, group.does);
  if (!group.shared.empty())
    text += fmt::format(": {} (of {} colliding cases without a failure, {} {} such a contact)",
                        fmt::join(group.shared, ", "), group.all_holds, group.holds_with,
                        group.holds_with == 1 ? "has" : "have");
  return text;
}

}  // namespace assay::properties
