#include "properties/vectors/choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/outcome/try.hpp>
#include <cmath>
#include <map>
#include <set>

#include "corpus/file_bytes.h"
#include "corpus/hard/hard_families.h"
#include "corpus/json_fields.h"
#include "properties/judging/contracted_case.h"
#include "properties/judging/judged_run.h"
#include "properties/queries/distance_queries.h"
#include "properties/queries/query_families.h"
#include "properties/search/focus.h"
#include "properties/threads.h"
#include "properties/vectors/mesh_facts.h"
#include "properties/vectors/methods.h"
#include "properties/vectors/query_facts.h"
#include "properties/worker/plugin/query_case.h"

namespace assay::properties {
namespace {

using detector::FourPoints;

// How many cases a group may hold beside those that are wanted anyway, how many of one kind, and
// how many are tried of each source.
struct Quotas {
  std::size_t of_queries, of_distances, of_steps, of_limits;  // in doubles; in floats a half
  std::size_t of_a_kind;
  std::uint64_t queries, meshes;  // of each family
  int strengths;                  // of each hard family
};
constexpr Quotas quotas_of(VectorProfile profile) {
  return profile == VectorProfile::core ? Quotas{120, 50, 90, 50, 1, 120, 20, 3}
                                        : Quotas{3200, 900, 2400, 500, 150, 2500, 600, 100};
}

constexpr Eigen::Index most_triangles = 500;

// A case before its facts are known.
struct Draft {
  corpus::Case c;
  double distance = 0;
  std::vector<std::string> breaks{};
  std::string split_of{};
  bool is_wanted = false;  // whatever there is of its kind already
};

corpus::Case plain(corpus::Case c) {
  const auto query = query_word(c);
  c.options.clear();
  if (!query.empty()) say_query(c, query);
  c.expected = {};
  c.view.reset();
  c.ghosts.reset();
  c.counted.reset();
  c.pending = "{}";
  return c;
}

std::optional<corpus::Case> in_floats(const corpus::Case& c) {
  Contract contract;
  contract.coordinates = Coordinates::float32;
  auto rounded = contracted(c, contract);
  if (rounded) *rounded = plain(std::move(*rounded));
  return rounded;
}

bool is_at_rest(const corpus::Case& c) {
  return std::all_of(c.frames.begin(), c.frames.end(),
                     [&](const auto& frame) { return frame == c.frames[0]; });
}

std::string time_text(double t) { return fmt::format("{:.6g}", t); }

// "A vertex and a face meet first at t = 0.5, where two roots of the cubic coincide."
std::string sentence_of(const Vector& v, VectorFeatures features) {
  const auto& facts = v.steps[0];
  const bool is_free = v.result() == VectorResult::free;
  const bool touches = v.result() == VectorResult::acceptable;
  std::string text;
  if (features == VectorFeatures::mesh) {
    text = fmt::format("{} triangles", v.c.triangles.rows());
    if (v.steps.size() > 1) text += fmt::format(" in {} steps", v.steps.size());
    text += is_free ? " do not meet" : touches ? " only touch" : " meet";
    if (!is_free && v.steps.size() == 1)
      text += fmt::format(", first at t = {}", time_text(facts.first->lo));
  } else {
    text = features == VectorFeatures::vertex_face ? "A vertex and a face" : "Two edges";
    if (v.question == VectorQuestion::distance) {
      const auto d = fmt::format("{:.6g}", v.distance);
      text += is_free ? " stay farther apart than " + d
                      : (touches ? " only just come to the distance " : " come within ") + d;
    } else {
      text += is_free ? " do not meet" : touches ? " only touch" : " meet";
    }
    if (!is_free) text += fmt::format(", first at t = {}", time_text(facts.first->lo));
  }
  std::string where;
  for (const auto flag : v.flags) {
    const auto phrase = flag_texts()[static_cast<std::size_t>(flag)].when;
    where += (where.empty() ? "; " : ", ") + std::string(phrase);
  }
  return text + where + ".";
}

std::string kind_of(const Vector& v) {
  std::string kind = name_of(v.result());
  for (const auto flag : v.flags) kind += std::string(" ") + name_of(flag);
  const auto size = says_query(v.c) ? 0 : std::ilogb(static_cast<double>(v.c.triangles.rows()));
  constexpr int bits_of_a_kind = 12;
  return kind + fmt::format(" {} {} {}", v.hard.kind, v.hard.bits / bits_of_a_kind, size);
}

std::optional<Vector> vector_of(const Draft& draft, const VectorGroup& group) {
  auto v = group.features == VectorFeatures::mesh
               ? mesh_vector(draft.c, group.question, group.precision)
               : query_vector(draft.c, draft.distance, group.precision);
  if (!v) return v;
  v->breaks = draft.breaks;
  v->split_of = draft.split_of;
  if (!draft.split_of.empty()) {
    v->flags.push_back(VectorFlag::split_invariant);
    std::sort(v->flags.begin(), v->flags.end());
  }
  return v;
}

// Takes drafts in order until a group is full, few of each kind. Their facts are found in threads,
// many at a time.
class GroupChoice {
 public:
  GroupChoice(VectorGroup& group, std::string prefix, std::size_t most, const Quotas& quotas,
              int jobs)
      : group_(group), prefix_(std::move(prefix)), most_(most), quotas_(quotas), jobs_(jobs) {}

  void offer(const std::vector<Draft>& drafts) {
    std::vector<std::optional<Vector>> vectors(drafts.size());
    for_each_in_threads(drafts.size(), jobs_,
                        [&](std::size_t i) { vectors[i] = vector_of(drafts[i], group_); });
    for (std::size_t i = 0; i < drafts.size(); ++i) {
      if (vectors[i]) take(std::move(*vectors[i]), drafts[i].is_wanted);
    }
  }

  bool is_full() const { return group_.cases.size() - wanted_ >= most_; }

 private:
  void take(Vector v, bool is_wanted) {
    if (is_full() && !is_wanted) return;
    auto motion = motion_of(v);
    if (const auto met = met_.find(motion); met != met_.end()) {
      add_breaks(group_.cases[met->second], v.breaks);  // another detector failed on it, too
      return;
    }
    auto& count = kinds_[kind_of(v)];
    if (!is_wanted && (count >= quotas_.of_a_kind || is_one_too_many(v))) return;
    if (is_wanted) {
      ++wanted_;
    } else {
      ++count;
      ++results_[v.result()];
      for (const auto flag : v.flags) ++flags_[flag];
    }
    met_.emplace(std::move(motion), group_.cases.size());
    v.c.about = sentence_of(v, group_.features);
    v.c.id = fmt::format("{}-{:04}", prefix_, group_.cases.size() + 1);
    group_.cases.push_back(std::move(v));
  }

  static void add_breaks(Vector& v, const std::vector<std::string>& more) {
    for (const auto& name : more) {
      if (std::find(v.breaks.begin(), v.breaks.end(), name) == v.breaks.end())
        v.breaks.push_back(name);
    }
  }

  // What is frequent may fill a part of the group, and no more.
  bool is_one_too_many(const Vector& v) {
    if (v.result() == VectorResult::free && 5 * results_[VectorResult::free] >= 2 * most_)
      return true;
    return std::any_of(v.flags.begin(), v.flags.end(),
                       [&](VectorFlag flag) { return 4 * flags_[flag] >= most_; }) ||
           (v.has(VectorFlag::at_rest) && 12 * flags_[VectorFlag::at_rest] >= most_);
  }

  static std::string motion_of(const Vector& v) {
    corpus::Case c;
    c.triangles = v.c.triangles;
    c.frames = v.c.frames;
    c.script = v.c.script;
    c.options = v.c.options;
    return case_text(c) + fmt::format("{}", v.distance);
  }

  VectorGroup& group_;
  std::string prefix_;
  std::size_t most_;
  const Quotas& quotas_;
  int jobs_;
  std::size_t wanted_ = 0;
  // Of the others.
  std::map<std::string, std::size_t> kinds_;
  std::map<VectorResult, std::size_t> results_;
  std::map<VectorFlag, std::size_t> flags_;
  std::map<std::string, std::size_t> met_;  // the place of each motion that was taken
};

bool is_float(const VectorGroup& group) { return group.precision == VectorPrecision::float32; }

// Puts a draft of a query or mesh into a list if it fits the group; in floats it is rounded, and
// every other one is then moved by an ulp here and there.
void add_draft(std::vector<Draft>& drafts, Draft draft, const VectorGroup& group) {
  draft.c = plain(std::move(draft.c));
  const auto word = query_word(draft.c);
  if (word != (group.features == VectorFeatures::mesh ? "" : name_of(group.features))) return;
  if (draft.c.triangles.rows() > most_triangles) return;
  if (is_float(group)) {
    auto rounded = in_floats(draft.c);
    if (!rounded) return;
    draft.c = std::move(*rounded);
    Random random(draft.c.source + draft.c.id + ":float");
    if (group.features != VectorFeatures::mesh && random.one_in(2)) {
      const auto moved = neighbour_of(*query_of(draft.c), group.precision, random);
      auto c = case_of_query(moved, draft.c.id);
      c.source = draft.c.source + ", moved by ulps";
      draft.c = std::move(c);
    }
  }
  drafts.push_back(std::move(draft));
}

// The two halves of a query's step, if the middle of each way is a double.
std::vector<FourPoints> halves_of(const FourPoints& query) {
  FourPoints first = query, second = query;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double a = query.points[i].t0[k], b = query.points[i].t1[k];
      // What rounding takes from the sum (Knuth, TwoSum), and from its half.
      const double sum = a + b, of_b = sum - a, lost = (a - (sum - of_b)) + (b - of_b);
      const double middle = sum / 2;
      if (lost != 0 || middle * 2 != sum) return {};
      first.points[i].t1[k] = second.points[i].t0[k] = middle;
    }
  }
  return {first, second};
}

struct Found {
  Draft draft;
  VectorPrecision precision = VectorPrecision::float64;
};

Expected<std::vector<Found>> read_found(const std::filesystem::path& path) {
  std::vector<Found> found;
  BOOST_OUTCOME_TRY(bytes, corpus::read_bytes(path));
  BOOST_OUTCOME_TRY(json, corpus::parse_json(bytes, path));
  const corpus::JsonField root(json, path);
  BOOST_OUTCOME_TRY(list, root.at("found"));
  BOOST_OUTCOME_TRY(size, list.size());
  for (std::size_t i = 0; i < size; ++i) {
    const auto item = list.item(i);
    Found one;
    BOOST_OUTCOME_TRY(product, item.at("breaks"));
    BOOST_OUTCOME_TRY(name, product.text());
    BOOST_OUTCOME_TRY(precision, item.at("precision"));
    BOOST_OUTCOME_TRY(word, precision.text());
    const auto named = from_name<VectorPrecision>(word);
    if (!named) return precision.problem("is no precision");
    BOOST_OUTCOME_TRY(text, item.at("case"));
    BOOST_OUTCOME_TRY(c, corpus::parse_case(corpus::json_text(text.json()), path.string()));
    one.draft.c = std::move(c);
    one.precision = *named;
    one.draft.breaks = {name};
    one.draft.is_wanted = true;
    found.push_back(std::move(one));
  }
  return found;
}

class Chooser {
 public:
  explicit Chooser(const ChoiceAsked& asked) : asked_(asked), quotas_(quotas_of(asked.profile)) {
    set_.profile = name_of(asked.profile);
  }

  Expected<VectorSet> run() {
    BOOST_OUTCOME_TRY(found, read_found(asked_.found));
    found_ = std::move(found);
    BOOST_OUTCOME_TRYV(read_curated());
    using enum VectorFeatures;
    using enum VectorQuestion;
    for (const auto precision : all_values<VectorPrecision>) {
      for (const auto features : {vertex_face, edge_edge}) {
        choose({features, contact, precision, {}}, quotas_.of_queries,
               [&](auto& group, auto& choice) { queries(group, choice); });
        choose({features, distance, precision, {}}, quotas_.of_distances,
               [&](auto& group, auto& choice) { distances(group, choice); });
      }
      choose({mesh, contact, precision, {}}, quotas_.of_steps,
             [&](auto& group, auto& choice) { meshes(group, choice); });
      choose({mesh, limit, precision, {}}, quotas_.of_limits,
             [&](auto& group, auto& choice) { meshes(group, choice); });
    }
    return std::move(set_);
  }

 private:
  template <class Fill>
  void choose(VectorGroup group, std::size_t most, const Fill& fill) {
    if (asked_.progress) asked_.progress(group.name());
    constexpr const char* of_features[] = {"vf", "ee", "st"};
    std::string prefix = of_features[static_cast<std::size_t>(group.features)];
    if (group.question == VectorQuestion::limit) prefix = "lm";
    if (group.question == VectorQuestion::distance) prefix += "-within";
    prefix += is_float(group) ? "-f" : "-d";
    GroupChoice choice(group, prefix, is_float(group) ? most / 2 : most, quotas_, asked_.jobs);
    std::vector<Draft> drafts;
    for (const auto& one : found_) {
      if (one.precision == group.precision && group.question == VectorQuestion::contact)
        add_draft(drafts, one.draft, group);
    }
    choice.offer(drafts);
    fill(group, choice);
    set_.groups.push_back(std::move(group));
  }

  // In rounds, so that a group that is full early holds all families.
  void queries(VectorGroup& group, GroupChoice& choice) {
    hard_queries(group, choice);
    constexpr std::uint64_t together = 20, dear_one_in = 10;
    for (std::uint64_t begin = 0; begin < quotas_.queries && !choice.is_full(); begin += together) {
      std::vector<Draft> drafts;
      for (const auto& family : query_families()) {
        if (family.name.ends_with("-everyday")) continue;  // younger than this edition
        const bool is_dear = is_dear_query_family(family.name);
        for (std::uint64_t i = begin; i < begin + together; ++i) {
          if (is_dear && i % dear_one_in != 0) continue;
          const auto id = fmt::format("vectors:1:{}:{}", family.name, i);
          Draft draft{make_case(family, id).c};
          draft.c.source = id;
          add_draft(drafts, std::move(draft), group);
        }
      }
      choice.offer(drafts);
    }
    halves(group, choice);
  }

  // The features that meet first in hard cases, or are nearest.
  void hard_queries(VectorGroup& group, GroupChoice& choice) {
    std::vector<Draft> drafts;
    for_each_hard_case([&](const corpus::Case& c) {
      const auto truth = judge_case(c);
      Random random("focus");
      const auto focus = focus_of(c, truth, {}, random);
      if (!focus) return;
      Draft draft{case_of_query(query_at(c, *focus), c.id)};
      draft.c.source = "first features of " + c.source;
      add_draft(drafts, std::move(draft), group);
    });
    choice.offer(drafts);
  }

  // Some cases once more as their two halves.
  void halves(VectorGroup& group, GroupChoice& choice) {
    constexpr std::size_t one_in = 12;
    const std::size_t whole = group.cases.size();
    for (std::size_t i = 0; i < whole; i += one_in) {
      const auto& v = group.cases[i];
      if (is_at_rest(v.c)) continue;
      std::vector<Draft> drafts;
      int number = 0;
      for (const auto& half : halves_of(*query_of(v.c))) {
        Draft draft{case_of_query(half, v.c.id)};
        draft.c.source = fmt::format("half {} of {}", ++number, v.c.id);
        draft.split_of = v.c.id;
        draft.is_wanted = true;
        if (is_float(group) && !in_floats_already(draft.c)) break;
        drafts.push_back(std::move(draft));
      }
      if (drafts.size() < 2) continue;
      auto& flags = group.cases[i].flags;
      flags.push_back(VectorFlag::split_invariant);
      std::sort(flags.begin(), flags.end());
      group.cases[i].c.about = sentence_of(group.cases[i], group.features);
      choice.offer(drafts);
    }
  }

  static bool in_floats_already(const corpus::Case& c) {
    return std::all_of(c.frames.begin(), c.frames.end(), [](const auto& frame) {
      return frame == frame.template cast<float>().template cast<double>();
    });
  }

  void distances(VectorGroup& group, GroupChoice& choice) {
    constexpr std::uint64_t together = 10;
    const auto wanted = group.features == VectorFeatures::vertex_face ? 0u : 1u;
    for (std::uint64_t begin = 0; begin < quotas_.queries && !choice.is_full(); begin += together) {
      std::vector<Draft> drafts;
      for (const auto& family : distance_families()) {
        for (std::uint64_t i = begin; i < begin + together; ++i) {
          auto made = family.make(1, 2 * i + wanted);
          if (made.motion.first_group != static_cast<int>(wanted) + 1 || made.distance.second != 0)
            continue;
          const auto source = fmt::format("{}:1:{}", family.name, 2 * i + wanted);
          if (is_float(group)) made.distance.first = static_cast<float>(made.distance.first);
          if (!(made.distance.first > 0) || !std::isfinite(made.distance.first)) continue;
          Draft draft{case_of_query(made.motion, source), made.distance.first};
          draft.c.source = source;
          add_draft(drafts, std::move(draft), group);
        }
      }
      choice.offer(drafts);
    }
  }

  Expected<void> read_curated() {
    BOOST_OUTCOME_TRY(files, corpus::case_files(asked_.curated));
    for (const auto& file : files) {
      BOOST_OUTCOME_TRY(c, corpus::read_case(file));
      if (c.expected.answer == detector::Answer::error || says_query(c)) continue;
      c.source = "corpus/curated/" + c.id;
      curated_.push_back(std::move(c));
    }
    return boost::outcome_v2::success();
  }

  void meshes(VectorGroup& group, GroupChoice& choice) {
    std::vector<Draft> drafts;
    for (const auto& c : curated_) {
      Draft draft{c};
      draft.is_wanted = group.question == VectorQuestion::contact && !is_float(group);
      add_draft(drafts, std::move(draft), group);
    }
    choice.offer(drafts);
    hard_meshes(group, choice);
    random_meshes(group, choice);
  }

  // At their edges: exact touching, the strongest, and some between.
  template <class Use>
  void for_each_hard_case(const Use& use) {
    for (const auto& family : corpus::hard_families()) {
      const int last = family.last_strength();
      for (int s = 0; s < quotas_.strengths && s <= last; ++s) {
        const int strength = last - s * std::max(1, last / quotas_.strengths);
        for (int kind = 0; kind < family.kinds_at(strength); ++kind) {
          auto c = corpus::hard_case(family, strength, kind);
          if (c.triangles.rows() > most_triangles) continue;
          c.source =
              fmt::format("hard family {}, strength {}, variant {}", family.name, strength, kind);
          use(c);
        }
      }
    }
  }

  void hard_meshes(VectorGroup& group, GroupChoice& choice) {
    std::vector<Draft> drafts;
    for_each_hard_case([&](const corpus::Case& c) { add_draft(drafts, {c}, group); });
    choice.offer(drafts);
  }

  void random_meshes(VectorGroup& group, GroupChoice& choice) {
    for (std::uint64_t i = 0; i < quotas_.meshes && !choice.is_full(); ++i) {
      std::vector<Draft> drafts;
      for (const auto& family : families()) {
        if (family.name.ends_with("-everyday")) continue;
        const auto id = fmt::format("vectors:1:{}:{}", family.name, i);
        Draft draft{make_case(family, id).c};
        draft.c.source = id;
        const bool fits = draft.c.triangles.rows() <= 40 && draft.c.frames.size() <= 11;
        if (fits) add_draft(drafts, std::move(draft), group);
      }
      choice.offer(drafts);
    }
  }

  const ChoiceAsked& asked_;
  Quotas quotas_;
  std::vector<Found> found_;
  std::vector<corpus::Case> curated_;
  VectorSet set_;
};

}  // namespace

Expected<VectorSet> choose_vectors(const ChoiceAsked& asked) {
  BOOST_OUTCOME_TRY(set, Chooser(asked).run());
  say_open_methods(set, asked.jobs);
  return set;
}

}  // namespace assay::properties
