#include "properties/reducer/search.h"

#include <algorithm>

#include "properties/random.h"
#include "properties/reducer/case_edits.h"
#include "properties/worker/messages.h"

namespace assay::properties {
namespace {

// Returns a hash of 64 bits over everything that a pass may change. Among a million contents two
// are taken for one another with a chance of 3e-8. The price is that one proposal is not judged.
std::uint64_t hash_of(const Case& c) {
  Numbers script;  // without the padding of a step
  for (const auto& [from, to, commit] : steps_of(c))
    script.insert(script.end(), {from, to, commit});
  return Random::hash(encode(c.triangles, c.frames, script, c.view, c.ghosts, c.counted));
}

}  // namespace

ReductionSearch::ReductionSearch(const Case& failing, const Judge& judge,
                                 const ReduceLimits& limits, const OnBetter& on_better)
    : judge_(judge), limits_(limits), on_better_(on_better), best_(failing) {
  best_.expected = {};
  if (best_.counted) best_.counted->steps.clear();
  best_.pending = "{}";
  size_ = reported_ = size_of(best_);
  begin_pass("start");
  if (!is_valid(best_)) return;
  ++calls_;
  ++statistics_[pass_].tries;
  if (auto finding = judge_(best_)) finding_ = std::move(*finding);
  findings_.emplace(hash_of(best_), finding_);
}

double ReductionSearch::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

bool ReductionSearch::has_ended() const {
  return calls_ >= limits_.calls || seconds() >= limits_.seconds;
}

std::optional<Finding> ReductionSearch::ask(const Case& candidate) {
  const auto [place, is_new] = findings_.try_emplace(hash_of(candidate));
  if (is_new) {
    if (has_ended() || !is_valid(candidate)) {
      findings_.erase(place);
      return std::nullopt;
    }
    ++calls_;
    ++statistics_[pass_].tries;
    place->second = judge_(candidate);
  }
  return place->second && matches(*place->second) ? place->second : std::nullopt;
}

bool ReductionSearch::matches(const Finding& finding) const {
  if (finding.signature == finding_.signature) return true;
  // "claim: kind at stage, feature, cause"
  const auto kind_of = [](const std::string& signature) {
    return signature.substr(0, std::min(signature.find(','), signature.find(" at ")));
  };
  return kind_alone_ && kind_of(finding.signature) == kind_of(finding_.signature);
}

void ReductionSearch::keep(const Case& candidate, const MeshSize& size, Finding finding) {
  best_ = candidate;
  size_ = size;
  finding_ = std::move(finding);
  if (size >= reported_) return;
  reported_ = size;
  if (on_better_) on_better_(best_);
}

bool ReductionSearch::offer(const Case& candidate) {
  const MeshSize size = size_of(candidate);
  if (size >= size_) return false;
  auto finding = ask(candidate);
  if (!finding) return false;
  ++statistics_[pass_].accepted;
  keep(candidate, size, std::move(*finding));
  return true;
}

bool ReductionSearch::replace(const Case& candidate) {
  auto finding = ask(candidate);
  if (!finding) return false;
  keep(candidate, size_of(candidate), std::move(*finding));
  return true;
}

void ReductionSearch::begin_pass(const std::string& name) {
  const double now = seconds();
  if (!statistics_.empty()) statistics_[pass_].seconds += now - pass_start_;
  pass_start_ = now;
  const auto place = std::ranges::find(statistics_, name, &PassStatistics::name);
  pass_ = static_cast<std::size_t>(place - statistics_.begin());
  if (place == statistics_.end()) statistics_.push_back({name, 0, 0, 0});
}

Rings rings_of(const ReductionSearch& search) {
  const auto& triangles = search.best().triangles;
  const auto vertices = vertex_count(search.best());
  Rings rings;
  rings.distance.assign(vertices, Rings::unreached);
  rings.parent = in_order(vertices);
  rings.neighbours.resize(vertices);
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    for (int i = 0; i < 3; ++i) {
      auto& row = rings.neighbours[at(triangles(t, i))];
      row.push_back(triangles(t, (i + 1) % 3));
      row.push_back(triangles(t, (i + 2) % 3));
    }
  }
  for (auto& row : rings.neighbours) {
    std::ranges::sort(row);
    row.erase(std::unique(row.begin(), row.end()), row.end());
  }

  std::vector<std::int32_t> queue;
  auto focus = search.finding().focus;
  std::erase_if(focus, [&](std::int32_t t) { return t < 0 || t >= triangles.rows(); });
  if (focus.empty()) focus.push_back(0);
  for (const auto t : focus) {
    for (int i = 0; i < 3; ++i) {
      auto& distance = rings.distance[at(triangles(t, i))];
      if (distance == Rings::unreached) queue.push_back(triangles(t, i));
      distance = 0;
    }
  }
  for (std::size_t head = 0; head < queue.size(); ++head) {
    const auto v = at(queue[head]);
    rings.farthest = rings.distance[v];
    for (const auto w : rings.neighbours[v]) {
      auto& distance = rings.distance[at(w)];
      if (distance != Rings::unreached) continue;
      distance = rings.distance[v] + 1;
      rings.parent[at(w)] = queue[head];
      queue.push_back(w);
    }
  }
  rings.far_first = in_order(vertices);
  std::ranges::stable_sort(rings.far_first, [&](auto a, auto b) {
    return rings.distance[at(a)] > rings.distance[at(b)];
  });
  return rings;
}

Case within(const Case& c, const Rings& rings, int ring) {
  std::vector<std::uint8_t> keep;
  for (const auto& corners : triangles_of(c)) {
    keep.push_back(std::ranges::all_of(
        corners, [&](std::int32_t v) { return rings.distance[at(v)] <= ring; }));
  }
  return keep_triangles(c, keep);
}

}  // namespace assay::properties
