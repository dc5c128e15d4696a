#include "properties/queries/self_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <charconv>
#include <chrono>
#include <cmath>
#include <exception>
#include <iterator>
#include <limits>
#include <mutex>
#include <string_view>

#include "detector/detector.h"
#include "oracle/distance/feature_distance.h"
#include "oracle/mesh/step.h"
#include "properties/generators/draft.h"
#include "properties/judging/agreement.h"
#include "properties/queries/distance_queries.h"
#include "properties/queries/listed_queries.h"
#include "properties/random.h"
#include "properties/threads.h"
#include "properties/worlds/small_steps.h"

namespace assay::properties {

namespace {

constexpr std::uint64_t indices_at_once = 64;  // indices that a thread takes at once
constexpr std::size_t failures_kept = 5;

std::optional<std::uint64_t> whole_number(std::string_view text) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return {};
  return value;
}

}  // namespace

FamilyResult run_family(const SelfTestFamily& family, const SelfTestOptions& options,
                        const std::function<void(std::uint64_t)>& progress) {
  const auto start = std::chrono::steady_clock::now();
  const std::uint64_t indices = family.indices(options.queries);
  std::atomic<std::uint64_t> next = 0;
  std::atomic<bool> stopped = false;
  std::mutex mutex;
  FamilyResult result;
  std::uint64_t done = 0;
  const auto merge = [&](FamilyResult& found, std::uint64_t count) {
    const std::lock_guard lock(mutex);
    result.tally += found.tally;
    auto& kept = result.failures;
    std::move(found.failures.begin(), found.failures.end(), std::back_inserter(kept));
    std::sort(kept.begin(), kept.end(),
              [](const auto& a, const auto& b) { return a.index < b.index; });
    if (kept.size() > failures_kept) kept.resize(failures_kept);
    done += count;
    if (progress) progress(done);
  };
  in_threads(options.jobs, [&] {
    while (!stopped) {
      const std::uint64_t begin = next.fetch_add(indices_at_once);
      if (begin >= indices) return;
      FamilyResult found;
      const std::uint64_t end = std::min(begin + indices_at_once, indices);
      std::uint64_t index = begin;
      for (; index < end && !stopped; ++index) {
        if (options.stop && options.stop()) {
          stopped = true;
          break;
        }
        auto wrong = family.check(options.seed, index, found.tally);
        if (!wrong) continue;
        found.failures.push_back({index, std::move(*wrong)});
        stopped = stopped || options.stop_at_contradiction;
      }
      merge(found, index - begin);
    }
  });
  result.complete = done == indices;
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

std::optional<SelfTestCase> self_test_case(const std::string& name) {
  const auto last = name.rfind(':');
  if (last == std::string::npos || last == 0) return {};
  const auto middle = name.rfind(':', last - 1);
  if (middle == std::string::npos) return {};
  const std::string_view all = name;
  const auto seed = whole_number(all.substr(middle + 1, last - middle - 1));
  const auto index = whole_number(all.substr(last + 1));
  if (!seed || !index) return {};
  for (const auto& family : self_test_families()) {
    if (family->name() == all.substr(0, middle)) return SelfTestCase{family.get(), *seed, *index};
  }
  return {};
}

std::optional<std::string> SelfTestFamily::check(std::uint64_t seed, std::uint64_t index,
                                                 QueryTally& tally) const {
  const auto made = at(seed, index);
  if (!made) return {};
  return check_query(*made, Random(~seed, index).next(), tally);
}

std::string SelfTestFamily::text(std::uint64_t seed, std::uint64_t index) const {
  const auto made = at(seed, index);
  return made ? exact_text(made->query) + answers_text(made->query)
              : "no query at this place: an equal one stands elsewhere\n";
}

namespace {

class RungFamily final : public SelfTestFamily {
 public:
  RungFamily() : SelfTestFamily("rungs", "named queries, each with the rung that must decide it") {}
  std::uint64_t indices(std::uint64_t) const override { return rung_cases().size(); }

  std::optional<GeneratedQuery> at(std::uint64_t, std::uint64_t index) const override {
    return GeneratedQuery{named_at(index).query, {}};
  }

  std::optional<std::string> check(std::uint64_t seed, std::uint64_t index,
                                   QueryTally& tally) const override {
    if (auto wrong = SelfTestFamily::check(seed, index, tally)) return wrong;
    const RungCase& named = named_at(index);
    for (const auto want : {detector::Want::yes_no, detector::Want::first_time}) {
      const auto answer = oracle::contact_of(named.query, want);
      if (answer.contact != named.contact ||
          (named.contact && want == detector::Want::first_time && answer.first != named.first)) {
        ++tally.contradictions;
        return fmt::format("`{}`: not the answer or time that is known", named.name);
      }
      if (answer.rung == named.rung) continue;
      ++tally.contradictions;
      return fmt::format("`{}`: rung {} decided, {} must", named.name, name_of(answer.rung),
                         name_of(named.rung));
    }
    return {};
  }

  std::string text(std::uint64_t seed, std::uint64_t index) const override {
    return fmt::format("{}\n{}", named_at(index).name, SelfTestFamily::text(seed, index));
  }

 private:
  static const RungCase& named_at(std::uint64_t index) {
    return rung_cases()[index % rung_cases().size()];
  }
};

class WorldFamily final : public SelfTestFamily {
 public:
  // The world is left out if fewer than `from` queries are asked for.
  WorldFamily(std::string name, std::string about, const SmallWorld& world, std::uint64_t from)
      : SelfTestFamily(std::move(name), std::move(about)), world_(world), from_(from) {}
  std::uint64_t indices(std::uint64_t queries) const override {
    return queries >= from_ ? world_.places() : 0;
  }

  std::optional<GeneratedQuery> at(std::uint64_t, std::uint64_t index) const override {
    const auto query = world_.at(index);
    return query ? std::optional(GeneratedQuery{*query, {}}) : std::nullopt;
  }

 private:
  SmallWorld world_;
  std::uint64_t from_;
};

class RandomFamily final : public SelfTestFamily {
 public:
  explicit RandomFamily(const QueryGenerator& generator)
      : SelfTestFamily(generator.name, generator.about), generator_(generator) {}
  std::uint64_t indices(std::uint64_t queries) const override {
    const auto one_in = static_cast<std::uint64_t>(generator_.one_in);
    return (queries + one_in - 1) / one_in;
  }

  std::optional<GeneratedQuery> at(std::uint64_t seed, std::uint64_t index) const override {
    return generator_.make(seed, index);
  }

 private:
  QueryGenerator generator_;
};

// Whole steps of small meshes. They exercise features, spreading and piercing, which single
// queries do not. The detector tests every pair.
class StepFamily final : public SelfTestFamily {
 public:
  using Make = SmallStep (*)(std::uint64_t seed, std::uint64_t index);
  StepFamily(std::string name, std::string about, Make make)
      : SelfTestFamily(std::move(name), std::move(about)), make_(make) {}
  std::uint64_t indices(std::uint64_t queries) const override { return (queries + 19) / 20; }
  std::optional<GeneratedQuery> at(std::uint64_t, std::uint64_t) const override { return {}; }

  std::optional<std::string> check(std::uint64_t seed, std::uint64_t index,
                                   QueryTally& tally) const override {
    ++tally.queries;
    try {
      const SmallStep step = make_(seed, index);
      const auto judged = oracle::judge_step({step.x_t0, step.x_t1}, step.triangles, {});
      tally.contacts += judged.answer == detector::Answer::collision ? 1 : 0;
      tally.rungs += judged.rungs;
      const auto found = detect(step);
      if (compare(found, judged, claims_of({})).outcome == Outcome::holds) return {};
    } catch (const std::exception& thrown) {
      ++tally.contradictions;
      return fmt::format("threw: {}", thrown.what());
    }
    ++tally.contradictions;
    return "pairs or times of the oracle's step and the detector's differ";
  }

  std::string text(std::uint64_t seed, std::uint64_t index) const override {
    const SmallStep step = make_(seed, index);
    const auto judged = oracle::judge_step({step.x_t0, step.x_t1}, step.triangles, {});
    const auto found = detect(step);
    std::string out = step.family + "\n";
    for (Eigen::Index v = 0; v < step.x_t0.rows(); ++v) {
      out += fmt::format("  vertex {}: t=0 ({:a}, {:a}, {:a})  t=1 ({:a}, {:a}, {:a})\n", v,
                         step.x_t0(v, 0), step.x_t0(v, 1), step.x_t0(v, 2), step.x_t1(v, 0),
                         step.x_t1(v, 1), step.x_t1(v, 2));
    }
    for (Eigen::Index t = 0; t < step.triangles.rows(); ++t) {
      out += fmt::format("  triangle {}: {} {} {}\n", t, step.triangles(t, 0), step.triangles(t, 1),
                         step.triangles(t, 2));
    }
    return out + pairs_text("oracle", judged.pairs) + pairs_text("detector", found.pairs);
  }

 private:
  static detector::StepResult detect(const SmallStep& step) {
    auto made = detector::Detector::create(
        step.triangles, step.x_t0,
        {detector::Culling::none, detector::Start::verified, detector::Pairs::all});
    return made.value().step(step.x_t0, step.x_t1, {});
  }

  static std::string pairs_text(const char* who, const std::vector<detector::PairContact>& pairs) {
    std::string out = fmt::format("{}: {} pairs\n", who, pairs.size());
    for (const auto& p : pairs) {
      out += fmt::format("  {} {} at [{:a}, {:a}], {}\n", p.pair.a, p.pair.b, p.time.lo, p.time.hi,
                         name_of(p.feature.kind));
    }
    return out;
  }

  Make make_;
};

// The first step of a small mesh with everyday numbers.
SmallStep everyday_step(std::uint64_t seed, std::uint64_t index) {
  const auto name = index % 2 == 0 ? "closed-everyday" : "unclosed-everyday";
  const auto c = make_case(*find_family(name), fmt::format("steps:{}:{}:{}", seed, name, index)).c;
  return {name, c.triangles, c.frames[0], c.frames[1], {}, {}};
}

// Queries of distance (distance_queries.h), asked of the oracle and of the distance referee. Where
// d is 0 the contact oracle has to agree in every bit. For some of them the least distance is asked
// for, too: it comes within d just where the query does.
class DistanceFamilyCheck final : public SelfTestFamily {
 public:
  explicit DistanceFamilyCheck(const DistanceFamily& family)
      : SelfTestFamily(family.name, family.about), family_(family) {}
  // A query of distance takes longer than one of contact, so there are fewer.
  std::uint64_t indices(std::uint64_t queries) const override {
    const auto one_in = static_cast<std::uint64_t>(4 * family_.one_in);
    return (queries + one_in - 1) / one_in;
  }
  std::optional<GeneratedQuery> at(std::uint64_t, std::uint64_t) const override { return {}; }

  std::optional<std::string> check(std::uint64_t seed, std::uint64_t index,
                                   QueryTally& tally) const override {
    const DistanceQuery query = family_.make(seed, index);
    const auto d = query.distance;
    oracle::FirstNear answer;
    DistanceTally found;
    auto wrong = check_distance(
        query,
        [&](const DistanceQuery& q) {
          answer = oracle::first_time_within(q.motion, d);
          return DistanceAnswer{answer.near, answer.first};
        },
        found);
    ++tally.queries;
    tally.contacts += answer.near ? 1 : 0;
    tally.open += found.open;
    tally.rungs.add(answer.rung);
    if (!wrong && d.first == -d.second) wrong = against_contact(query.motion, answer);
    if (!wrong && Random(~seed, index).next() % least_asked_one_in == 0)
      wrong = against_least(query.motion, d, answer);
    tally.contradictions += wrong ? 1 : 0;
    return wrong;
  }

  std::string text(std::uint64_t seed, std::uint64_t index) const override {
    const DistanceQuery query = family_.make(seed, index);
    const auto answer = oracle::first_time_within(query.motion, query.distance);
    return exact_text(query) +
           (answer.near
                ? fmt::format("oracle: near at [{:a}, {:a}]\n", answer.first.lo, answer.first.hi)
                : "oracle: never near\n") +
           fmt::format("least distance: {:a}\n", oracle::least_distance(query.motion));
  }

 private:
  static constexpr std::uint64_t least_asked_one_in = 16;

  static std::optional<std::string> against_contact(const Query& motion,
                                                    const oracle::FirstNear& answer) {
    const auto contact = oracle::contact_of(motion, detector::Want::first_time);
    if (contact.contact == answer.near && (!answer.near || contact.first == answer.first))
      return {};
    return "within 0 is not the same as in contact";
  }

  // The least distance is the least double that the features come within.
  static std::optional<std::string> against_least(const Query& motion,
                                                  const detector::Separation& d,
                                                  const oracle::FirstNear& answer) {
    const double least = oracle::least_distance(motion);
    const auto is_within = [&](double distance) {
      return oracle::first_time_within(motion, {distance, 0}, detector::Want::yes_no).near;
    };
    if (std::isfinite(least) && !is_within(least)) return "farther apart than the least distance";
    if (least > 0 && is_within(std::nextafter(least, 0.0))) return "nearer than the least distance";
    // The sum is rounded, so only what lies beyond the rounding is compared.
    const double sum = d.first + d.second;
    if (answer.near ? least > std::nextafter(sum, std::numeric_limits<double>::infinity())
                    : std::isfinite(sum) && least < std::nextafter(sum, 0.0))
      return "the least distance does not fit the answer";
    return {};
  }

  DistanceFamily family_;
};

}  // namespace

const std::vector<std::unique_ptr<const SelfTestFamily>>& self_test_families() {
  static const auto families = [] {
    std::vector<std::unique_ptr<const SelfTestFamily>> all;
    const auto world = [&](const char* name, const char* about, int side, int dimensions,
                           WorldMotion motion, std::uint64_t from) {
      all.push_back(
          std::make_unique<WorldFamily>(name, about, SmallWorld(side, dimensions, motion), from));
    };
    using enum WorldMotion;
    all.push_back(std::make_unique<RungFamily>());
    world("line-3", "all queries on {-1,0,1}", 3, 1, every_point_moves, 0);
    world("plane-2", "all queries on {0,1}^2", 2, 2, every_point_moves, 0);
    world("plane-3-one", "all on {-1,0,1}^2, at most one point moves", 3, 2, one_point_moves, 0);
    all.push_back(std::make_unique<StepFamily>(
        "steps", "pair sets of small meshes, detector without culling", make_small_step));
    all.push_back(std::make_unique<StepFamily>(
        "steps-everyday", "the same of meshes with everyday numbers", everyday_step));
    for (const QueryGenerator& generator : query_generators()) {
      all.push_back(std::make_unique<RandomFamily>(generator));
    }
    for (const DistanceFamily& family : distance_families()) {
      all.push_back(std::make_unique<DistanceFamilyCheck>(family));
    }
    world("line-4", "all queries on {0,1,2,3}", 4, 1, every_point_moves, 20'000);
    world("cube-2", "all queries on {0,1}^3", 2, 3, every_point_moves, 100'000);
    world("cube-3-one", "all on {-1,0,1}^3, at most one point moves", 3, 3, one_point_moves,
          300'000);
    world("plane-3", "all queries on {-1,0,1}^2", 3, 2, every_point_moves, 2'000'000);
    return all;
  }();
  return families;
}

}  // namespace assay::properties
