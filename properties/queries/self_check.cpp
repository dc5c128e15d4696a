#include "properties/queries/self_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <boost/outcome/try.hpp>
#include <cassert>
#include <chrono>
#include <exception>
#include <iterator>
#include <mutex>
#include <string_view>
#include <utility>

#include "corpus/json_fields.h"
#include "detector/detector.h"
#include "oracle/mesh/step.h"
#include "properties/judging/agreement.h"
#include "properties/numbering.h"
#include "properties/queries/query_families.h"
#include "properties/random.h"
#include "properties/threads.h"
#include "properties/words.h"
#include "properties/worker/plugin/query_case.h"

namespace assay::properties {

namespace {

constexpr std::uint64_t indices_at_once = 64;  // indices that a thread takes at once
constexpr std::size_t failures_kept = 5;

}  // namespace

FamilyResult run_family(const SelfTestFamily& family, const SelfTestOptions& options,
                        const std::function<void(std::uint64_t)>& progress) {
  const auto start = std::chrono::steady_clock::now();
  const std::uint64_t indices = family.indices(options.queries);
  std::atomic<std::uint64_t> next = 0;
  std::atomic<bool> is_stopped = false;
  std::mutex mutex;
  FamilyResult result;
  std::uint64_t done_count = 0;
  const auto merge = [&](FamilyResult& addend, std::uint64_t count) {
    const std::lock_guard lock(mutex);
    result.tally += addend.tally;
    auto& failures = result.failures;
    std::ranges::move(addend.failures, std::back_inserter(failures));
    std::ranges::sort(failures, {}, &SelfTestFailure::index);
    if (failures.size() > failures_kept) failures.resize(failures_kept);
    done_count += count;
    if (progress) progress(done_count);
  };
  in_threads(options.jobs, [&] {
    while (!is_stopped) {
      const std::uint64_t begin = next.fetch_add(indices_at_once);
      if (begin >= indices) return;
      FamilyResult result_of_part;
      const std::uint64_t end = std::min(begin + indices_at_once, indices);
      std::uint64_t index = begin;
      for (; index < end && !is_stopped; ++index) {
        if (options.stop && options.stop()) {
          is_stopped = true;
          break;
        }
        auto wrong = family.check(options.seed, index, result_of_part.tally);
        if (!wrong) continue;
        result_of_part.failures.push_back({index, std::move(*wrong)});
      }
      merge(result_of_part, index - begin);
    }
  });
  result.complete = done_count == indices;
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

std::optional<SelfTestCase> self_test_case(const std::vector<SelfTestFamily>& families,
                                           const std::string& name) {
  const auto last = name.rfind(':');
  if (last == std::string::npos || last == 0) return {};
  const auto middle = name.rfind(':', last - 1);
  if (middle == std::string::npos) return {};
  const std::string_view all = name;
  const auto seed = whole_number_of(all.substr(middle + 1, last - middle - 1));
  const auto index = whole_number_of(all.substr(last + 1));
  const auto family = std::ranges::find(families, all.substr(0, middle), &SelfTestFamily::name);
  if (!seed || !index || family == families.end()) return {};
  return SelfTestCase{&*family, *seed, *index};
}

namespace {

// Whole steps of small meshes. They exercise features, spreading and piercing, which single
// queries do not. The detector tests every pair.

StepResult detect(const SmallStep& step) {
  auto creation = detector::Detector::create(
      step.triangles, step.x_t0, {Culling::none, detector::Start::verified, detector::Pairs::all});
  return creation.value().step(step.x_t0, step.x_t1, {});
}

StepJudgement judge(const SmallStep& step) {
  return oracle::judge_step({step.x_t0, step.x_t1}, step.triangles, {});
}

std::optional<std::string> check_step(const SmallStep& step, QueryTally& tally) {
  const auto judgement = judge(step);
  tally.contacts += judgement.answer == Answer::collision ? 1 : 0;
  tally.rungs += judgement.rungs;
  if (compare(detect(step), judgement, claims_of({})).outcome == Outcome::holds) return {};
  return "the pairs or times of the oracle and of the detector differ";
}

std::string pairs_text(const char* who, const std::vector<PairContact>& pairs) {
  std::string out = fmt::format("{}: {} pairs\n", who, pairs.size());
  for (const auto& p : pairs) {
    out += fmt::format("  {} {} at [{:a}, {:a}], {}\n", p.pair.a, p.pair.b, p.time.lo, p.time.hi,
                       name_of(p.feature.kind));
  }
  return out;
}

std::string step_text(const SmallStep& step) {
  std::string out = step.family + "\n";
  const SteppedMesh motion{step.x_t0, step.x_t1};
  for (int v = 0; v < static_cast<int>(step.x_t0.rows()); ++v)
    out += fmt::format("  vertex {}: {}\n", v, exact_text(motion.path(v)));
  for (Eigen::Index t = 0; t < step.triangles.rows(); ++t) {
    out += fmt::format("  triangle {}: {} {} {}\n", t, step.triangles(t, 0), step.triangles(t, 1),
                       step.triangles(t, 2));
  }
  return out + pairs_text("oracle", judge(step).pairs) + pairs_text("detector", detect(step).pairs);
}

// Returns the first step of a small mesh with everyday numbers.
SmallStep everyday_step(std::uint64_t seed, std::uint64_t index) {
  const auto name = index % 2 == 0 ? "closed-everyday" : "unclosed-everyday";
  const auto c = make_case(*find_family(name), fmt::format("steps:{}:{}:{}", seed, name, index)).c;
  return {name, c.triangles, c.frames[0], c.frames[1], {}, {}};
}

}  // namespace

std::uint64_t SelfTestFamily::indices(std::uint64_t queries) const {
  if (one_in > 0) return (queries + one_in - 1) / one_in;
  return queries >= from ? list_size : 0;
}

std::optional<std::string> SelfTestFamily::check(std::uint64_t seed, std::uint64_t index,
                                                 QueryTally& tally) const {
  if (!step) {
    const auto task = query(seed, index);
    return task ? check_query(*task, Random(~seed, index).next(), tally) : std::nullopt;
  }
  ++tally.queries;
  std::optional<std::string> wrong;
  try {
    wrong = check_step(step(seed, index), tally);
  } catch (const std::exception& thrown) {
    wrong = fmt::format("the check threw: {}", thrown.what());
  }
  tally.contradictions += wrong ? 1 : 0;
  return wrong;
}

std::string SelfTestFamily::text(std::uint64_t seed, std::uint64_t index) const {
  if (step) return step_text(step(seed, index));
  const auto task = query(seed, index);
  return task ? exact_text(*task) + answers_text(*task)
              : "no query has this number, because an equal query has another number\n";
}

Expected<std::vector<QueryTask>> named_queries(const std::filesystem::path& corpus) {
  const auto& rungs = method_of("oracle")->rungs;
  std::vector<QueryTask> list;
  const auto folder = corpus / "queries" / "named";
  BOOST_OUTCOME_TRY(files, corpus::case_files(folder));
  if (files.empty()) return corpus::problem_in(folder, "no named query");
  for (const auto& file : files) {
    BOOST_OUTCOME_TRY(c, corpus::read_case(file));
    BOOST_OUTCOME_TRY(pending, corpus::parse_json(c.pending, file));
    BOOST_OUTCOME_TRY(field, corpus::JsonField(pending, file).at("rung"));
    BOOST_OUTCOME_TRY(word, field.text());
    const auto query = query_of(c);
    const auto rung = std::ranges::find(rungs, word) - rungs.begin();
    if (!query || word.empty() || rung == std::ssize(rungs) || c.expected.steps.empty())
      return corpus::problem_in(file, "no query whose answer and rung are known");
    const auto& step = c.expected.steps[0];
    const bool is_met = step.answer == Answer::collision;
    list.push_back({.query = *query,
                    .name = c.about,
                    .truth = MethodAnswer{is_met ? detector::Decision::yes : detector::Decision::no,
                                          step.first_time, static_cast<int>(rung)}});
  }
  return list;
}

Expected<std::vector<SelfTestFamily>> self_test_families(const std::filesystem::path& corpus) {
  using enum WorldMotion;
  std::vector<SelfTestFamily> all;
  const auto family_of_list = [&](const char* name, const char* about, std::uint64_t count,
                                  std::uint64_t from, auto at) {
    all.push_back(
        {name, about, count, from, 0, [at](std::uint64_t, std::uint64_t i) { return at(i); }});
  };
  const auto world = [&](const char* name, const char* about, const SmallWorld& of,
                         std::uint64_t from) {
    family_of_list(name, about, of.places(), from, [of](std::uint64_t place) {
      const auto query = of.at(place);
      return query ? std::optional(QueryTask{*query}) : std::nullopt;
    });
  };
  const auto random = [&](std::string_view name, const Family& family, int one_in) {
    all.push_back({std::string(name), std::string(family.about), 0, 0,
                   static_cast<std::uint64_t>(one_in), family.query});
  };
  const auto steps = [&](const char* name, const char* about, auto step) {
    all.push_back({name, about, 0, 0, 20, {}, step});
  };
  BOOST_OUTCOME_TRY(queries, named_queries(corpus));
  family_of_list("rungs", "named queries, each with the rung that must decide it", queries.size(),
                 0, [queries](std::uint64_t i) {
                   return i < queries.size() ? std::optional(queries[i]) : std::nullopt;
                 });
  world("line-3", "all queries on {-1,0,1}", {3, 1, every_point_moves}, 0);
  world("plane-2", "all queries on {0,1}^2", {2, 2, every_point_moves}, 0);
  world("plane-3-one", "queries on {-1,0,1}^2, at most 1 point moves", {3, 2, one_point_moves}, 0);
  steps("steps", "pair sets of small meshes by the detector without culling", make_small_step);
  steps("steps-everyday", "like `steps`, for meshes with everyday numbers", everyday_step);
  for (const Family& family : self_test_queries())
    random(family.name.substr(std::string_view("query-").size()), family, family.one_in);
  // A query of distance takes longer than one of contact, so there are fewer.
  for (const Family& family : distance_families()) random(family.name, family, 4 * family.one_in);
  world("line-4", "all queries on {0,1,2,3}", {4, 1, every_point_moves}, 20'000);
  world("cube-2", "all queries on {0,1}^3", {2, 3, every_point_moves}, 100'000);
  world("cube-3-one", "queries on {-1,0,1}^3, at most 1 point moves", {3, 3, one_point_moves},
        300'000);
  world("plane-3", "all queries on {-1,0,1}^2", {3, 2, every_point_moves}, 2'000'000);
  return all;
}

namespace {

using Paths = SmallWorld::Paths;

// Returns the least arrangement of the points of a query: they are sorted within each group, and
// the lesser edge stands first.
Paths sort_paths(Paths p, int first_group) {
  std::sort(p.begin() + first_group, p.end());
  if (first_group == 2) {
    if (p[1] < p[0]) std::swap(p[0], p[1]);
    if (std::pair(p[2], p[3]) < std::pair(p[0], p[1])) {
      std::swap(p[0], p[2]);
      std::swap(p[1], p[3]);
    }
  }
  return p;
}

}  // namespace

SmallWorld::SmallWorld(int side, int dimensions, WorldMotion motion)
    : side_(side), dimensions_(dimensions), motion_(motion), grid_points_(power(side, dimensions)) {
  assert(side >= 2 && dimensions >= 1 && dimensions <= 3);
  for_each_symmetry(dimensions,
                    [&](const ImageOfGrid& image_of) { symmetries_.push_back(image_of(side)); });
}

std::uint64_t SmallWorld::places() const {
  const auto n = static_cast<std::uint64_t>(grid_points_);
  // If every point moves, there are two kinds of queries with four paths each. Otherwise there are
  // three kinds of movers (vertex, corner, end of an edge), four points, and one end of the path.
  return motion_ == WorldMotion::every_point_moves ? 2 * n * n * n * n * n * n * n * n
                                                   : 3 * n * n * n * n * n;
}

std::optional<SmallWorld::Arranged> SmallWorld::arranged_at(std::uint64_t place) const {
  const auto n = static_cast<std::uint64_t>(grid_points_);
  auto digit = [&] {
    const auto d = static_cast<int>(place % n);
    place /= n;
    return d;
  };
  Arranged query{};
  if (motion_ == WorldMotion::every_point_moves) {
    for (Path& path : query.paths) path = {digit(), digit()};
    query.first_group = 1 + static_cast<int>(place);
    return query;
  }
  for (Path& path : query.paths) path[0] = path[1] = digit();
  const int end = digit();
  const auto mover = static_cast<int>(place);  // 0 vertex, 1 corner of the face, 2 end of an edge
  query.first_group = mover == 2 ? 2 : 1;
  Path& moving_path = query.paths[mover == 1 ? 1 : 0];
  query.mover_first = end != moving_path[0];
  if (mover == 1 && !query.mover_first) return {};  // at rest: it is counted where the vertex moves
  moving_path[1] = end;
  return query;
}

// If one point moves, each arrangement of the other points is one place, so only these need to be
// in order.
bool SmallWorld::is_least_of_its_class(const Arranged& query) const {
  const Paths& p = query.paths;
  const bool corner_moves = p[1][0] != p[1][1];
  const bool in_order =
      query.mover_first
          ? (query.first_group == 1 ? corner_moves || p[1] <= p[2] : true) && p[2] <= p[3]
          : p == sort_paths(p, query.first_group);
  if (!in_order) return false;
  const Paths own = sort_paths(p, query.first_group);
  return std::ranges::all_of(symmetries_, [&](const std::vector<int>& image) {
    Paths other;
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t e = 0; e < 2; ++e) other[i][e] = image[static_cast<std::size_t>(p[i][e])];
    }
    return own <= sort_paths(other, query.first_group);
  });
}

Query SmallWorld::query_of(const Arranged& query) const {
  const int least = side_ == 3 ? -1 : 0;
  Query q{};
  q.first_group = query.first_group;
  for (std::size_t i = 0; i < 4; ++i) {
    for (int k = 0; k < dimensions_; ++k) {
      const int unit = power(side_, k);
      const auto axis = static_cast<std::size_t>(k);
      q.points[i].t0[axis] = query.paths[i][0] / unit % side_ + least;
      q.points[i].t1[axis] = query.paths[i][1] / unit % side_ + least;
    }
  }
  return q;
}

std::optional<Query> SmallWorld::at(std::uint64_t place) const {
  if (place >= places()) return {};
  const auto query = arranged_at(place);
  if (!query || !is_least_of_its_class(*query)) return {};
  return query_of(*query);
}

}  // namespace assay::properties
