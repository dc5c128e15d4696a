#include "properties/reducer/search.h"

#include <algorithm>
#include <array>
#include <bit>

#include "properties/reducer/case_edits.h"

namespace assay::properties {
namespace {

using corpus::Case;

// A hash of 64 bits over everything that a pass may change. Among a million contents two are taken
// for one another with a chance of 3e-8. The price is that one proposal is not judged.
class ContentHash {
 public:
  void add(std::uint64_t word) {
    state_ = (std::rotl(state_, 23) ^ word) * 0x9e3779b97f4a7c15u;
    state_ ^= state_ >> 32;
  }
  void add(double value) { add(std::bit_cast<std::uint64_t>(value)); }
  void add(const std::vector<detector::Point>& points) {
    add(static_cast<std::uint64_t>(points.size()));
    for (const auto& point : points) {
      for (const double value : point) add(value);
    }
  }
  void add(const detector::Triangles& triangles) {
    add(static_cast<std::uint64_t>(triangles.rows()));
    for (Eigen::Index i = 0; i < triangles.size(); ++i) {
      add(static_cast<std::uint64_t>(triangles.data()[i]));
    }
  }
  // In order, with the number of members in front.
  template <class List, class Members>
  void add_list(const List& list, const Members& members) {
    add(static_cast<std::uint64_t>(list.size()));
    for (const auto& item : list) {
      for (const std::int32_t member : members(item)) add(static_cast<std::uint64_t>(member));
    }
  }
  void add(const detector::CountedPairs& pairs) {
    const auto as_it_is = [](const auto& item) { return item; };
    add(static_cast<std::uint64_t>(pairs.level));
    add_list(pairs.body, [](std::int32_t body) { return std::array{body}; });
    add_list(pairs.apart, as_it_is);
    add(static_cast<std::uint64_t>(pairs.rings));
    add(pairs.rest_distance);
    add(pairs.rest);
    add_list(pairs.triangle_pairs, [](const auto& p) { return std::array{p.a, p.b}; });
    add_list(pairs.vertex_faces, [](const auto& p) { return std::array{p.vertex, p.face}; });
    add_list(pairs.edge_pairs, [](const auto& p) {
      return std::array{p.a[0], p.a[1], p.b[0], p.b[1]};
    });
  }
  std::uint64_t value() const { return state_; }

 private:
  std::uint64_t state_ = 0x243f6a8885a308d3u;
};

std::uint64_t hash_of(const Case& c) {
  ContentHash hash;
  hash.add(c.triangles);
  hash.add(static_cast<std::uint64_t>(c.frames.size()));
  for (const auto& frame : c.frames) {
    for (Eigen::Index i = 0; i < frame.size(); ++i) hash.add(frame.data()[i]);
  }
  for (const auto& step : corpus::steps_of(c)) {
    hash.add((static_cast<std::uint64_t>(step.from) << 33) ^
             (static_cast<std::uint64_t>(step.to) << 1) ^ (step.commit ? 1u : 0u));
  }
  if (c.view) {
    hash.add(c.view->q0);
    hash.add(c.view->q1);
  }
  if (c.ghosts) {
    hash.add(c.ghosts->triangles);
    for (const auto& apexes : c.ghosts->apexes) hash.add(apexes);
  }
  if (c.counted) hash.add(c.counted->pairs);
  return hash.value();
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
  for (std::size_t p = 0; p < statistics_.size(); ++p) {
    if (statistics_[p].name == name) {
      pass_ = p;
      return;
    }
  }
  pass_ = statistics_.size();
  statistics_.push_back({name, 0, 0, 0});
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
    std::sort(row.begin(), row.end());
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
  std::stable_sort(rings.far_first.begin(), rings.far_first.end(),
                   [&](auto a, auto b) { return rings.distance[at(a)] > rings.distance[at(b)]; });
  return rings;
}

corpus::Case within(const corpus::Case& c, const Rings& rings, int ring) {
  std::vector<std::uint8_t> keep;
  for (const auto& corners : triangles_of(c)) {
    keep.push_back(std::all_of(corners.begin(), corners.end(),
                               [&](std::int32_t v) { return rings.distance[at(v)] <= ring; }));
  }
  return keep_triangles(c, keep);
}

}  // namespace assay::properties
