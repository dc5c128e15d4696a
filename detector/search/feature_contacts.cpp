#include "detector/search/feature_contacts.h"

#include <atomic>
#include <iterator>
#include <utility>

#include "detector/parallel/workers.h"
#include "detector/search/stopwatch.h"

namespace assay::detector {
namespace {

// Tests are made in batches of this size, so that each phase keeps its code and data in the caches.
constexpr std::size_t tests_at_once = 2048;

}  // namespace

struct FeatureContacts::OneType {
  Representatives representatives;
  std::vector<TriangleType> types;
};

FeatureContacts::FeatureContacts(const Topology& mesh, const SteppedMesh& motion,
                                 const ElementaryTest& elementary, Want want,
                                 const Representatives& representatives,
                                 const std::vector<TriangleType>& types)
    : mesh_(mesh),
      motion_(motion),
      elementary_(elementary),
      want_(want),
      neighbours_count_(elementary.separation() == 0),
      pairs_(mesh, representatives, types) {
  make_lanes(1);
}

FeatureContacts::FeatureContacts(const Topology& mesh, const SteppedMesh& motion,
                                 const ElementaryTest& elementary, Want want,
                                 std::unique_ptr<OneType> own, PacedStop* pace)
    : FeatureContacts(mesh, motion, elementary, want, own->representatives, own->types) {
  own_ = std::move(own);
  take_near_in(motion, 0, pace);
}

FeatureContacts::FeatureContacts(const Topology& mesh, const SteppedMesh& motion,
                                 const ElementaryTest& elementary, Want want, PacedStop* pace)
    : FeatureContacts(mesh, motion, elementary, want,
                      std::unique_ptr<OneType>(
                          new OneType{Representatives(mesh, pace),
                                      std::vector(mesh.triangles.size(), TriangleType::positive)}),
                      pace) {}

FeatureContacts::~FeatureContacts() = default;

QueryVertices FeatureContacts::vertices_of(FeatureKey key) const {
  const auto first = first_of(key), second = second_of(key);
  if (kind_of(key) == FeatureKind::edge_edge) {
    const auto &a = mesh_.edges[at(first)], &b = mesh_.edges[at(second)];
    return {{a[0], a[1], b[0], b[1], -1}};
  }
  const auto& f = mesh_.triangles[at(second)];
  if (kind_of(key) == FeatureKind::vertex_face) return {{first, f[0], f[1], f[2], -1}};
  const auto& e = mesh_.edges[at(first)];
  return {{e[0], e[1], f[0], f[1], f[2]}};
}

FourPoints FeatureContacts::query(FeatureKey key) const {
  const QueryVertices vertices = vertices_of(key);
  const auto point = [&](std::size_t i) { return motion_.path(vertices.v[i]); };
  return {{point(0), point(1), point(2), point(3)},
          kind_of(key) == FeatureKind::vertex_face ? 1 : 2};
}

void FeatureContacts::make_lanes(std::size_t count) {
  while (lanes_.size() < count) {
    lanes_.push_back(std::make_unique<Lane>());
    Lane& lane = *lanes_.back();
    constexpr std::size_t room = tests_at_once + FeaturePairs::max_keys;
    lane.untested.reserve(room);
    if (!elementary_.first_rungs()) continue;
    lane.open.reserve(room);
    lane.keys.reserve(room);
    lane.queries.reserve(room);
    lane.rungs.resize(room);
  }
}

NarrowCounts FeatureContacts::counts() const {
  NarrowCounts sum;
  for (const auto& lane : lanes_) sum += lane->counts;
  return sum;
}

double FeatureContacts::test_time() const {
  double sum = 0;
  for (const auto& lane : lanes_) sum += lane->test_time;
  return sum / static_cast<double>(lanes_.size());
}

bool FeatureContacts::add_candidate(std::int32_t a, std::int32_t b, bool may_pierce,
                                    const StopFunction& stop, std::size_t lane) {
  Lane& of_lane = *lanes_[lane];
  pairs_.append(a, b, may_pierce, of_lane.untested);
  return of_lane.untested.size() < tests_at_once || run(of_lane, stop);
}

bool FeatureContacts::counts(std::int32_t a, std::int32_t b) const {
  if (neighbours_count_) return true;
  const auto &p = mesh_.triangles[at(a)], &q = mesh_.triangles[at(b)];
  return std::find_first_of(p.begin(), p.end(), q.begin(), q.end()) == p.end();
}

bool FeatureContacts::some_pair_counts(FeatureKey key) const {
  if (neighbours_count_) return true;
  const auto first = first_of(key), second = second_of(key);
  const bool is_vertex = kind_of(key) == FeatureKind::vertex_face;
  const auto of_first = (is_vertex ? mesh_.vertex_triangles : mesh_.edge_triangles).row(first);
  const auto of_second = kind_of(key) == FeatureKind::edge_edge ? mesh_.edge_triangles.row(second)
                                                                : std::span(&second, 1);
  return std::any_of(of_first.begin(), of_first.end(), [&](std::int32_t a) {
    return std::any_of(of_second.begin(), of_second.end(),
                       [&](std::int32_t b) { return counts(a, b); });
  });
}

void FeatureContacts::test(FeatureKey key, Lane& lane) const {
  if (!some_pair_counts(key)) return;
  const auto first = first_of(key), second = second_of(key);
  const auto& face = mesh_.triangles[at(second)];
  const auto add = [&](std::int32_t a, std::int32_t b, const TimeEnclosure& time,
                       const Feature& feature) {
    if (!counts(a, b)) return;
    lane.found.push_back({{std::min(a, b), std::max(a, b)}, time, feature});
  };
  if (kind_of(key) == FeatureKind::piercing) {
    const auto& e = mesh_.edges[at(first)];
    const Point e0 = motion_.start(e[0]), e1 = motion_.start(e[1]);
    const std::array<Point, 3> corners = {motion_.start(face[0]), motion_.start(face[1]),
                                          motion_.start(face[2])};
    if (!elementary_.pierces(e0, e1, corners)) return;
    const TimeEnclosure time = elementary_.piercing_time(e0, e1, corners);
    if (bound_ && bound_->leaves_out(time)) return;
    const Feature feature{FeatureKind::piercing, {e[0], e[1], face[0], face[1], face[2]}};
    for (const auto t : mesh_.edge_triangles.row(first)) add(t, second, time, feature);
  } else {
    const FourPoints points = query(key);
    if (elementary_.is_apart_along_an_axis(points)) {
      lane.counts.rungs.add(ContactRung::axis);
      return;
    }
    ++lane.counts.elementary_tests;
    const bool is_bounded = bound_ && bound_->has_unique_times && bound_->until < 1;
    const ContactResult result = is_bounded ? elementary_.test_until(points, want_, bound_->until)
                                            : elementary_.test(points, want_);
    lane.counts.rungs.add(result.rung);
    if (!result.contact || (bound_ && bound_->leaves_out(result.time))) return;
    if (kind_of(key) == FeatureKind::vertex_face) {
      const Feature feature{FeatureKind::vertex_face, {first, face[0], face[1], face[2], -1}};
      for (const auto t : mesh_.vertex_triangles.row(first)) add(t, second, result.time, feature);
    } else {
      const auto &a = mesh_.edges[at(first)], &b = mesh_.edges[at(second)];
      const Feature feature{FeatureKind::edge_edge, {a[0], a[1], b[0], b[1], -1}};
      for (const auto t : mesh_.edge_triangles.row(first)) {
        for (const auto s : mesh_.edge_triangles.row(second)) add(t, s, result.time, feature);
      }
    }
  }
}

// Copies those contacts of the feature pair that count. A pair of features counts for all pairs of
// triangles that hold it. A piercing counts for the pairs of triangles that have a counted feature
// pair.
void FeatureContacts::sort_features(FeatureKey key, std::size_t found_before, Lane& lane) const {
  const auto first = first_of(key), second = second_of(key);
  const auto found = std::span(lane.found).subspan(found_before);
  const bool pierces = kind_of(key) == FeatureKind::piercing;
  const bool counts = kind_of(key) == FeatureKind::vertex_face
                          ? relation_->counts_vertex_face(mesh_, first, second)
                          : !pierces && relation_->counts_edges(mesh_, first, second);
  for (const auto& contact : found) {
    if (pierces ? relation_->counts(mesh_, contact.pair) : counts) {
      lane.found_counted.push_back(contact);
    } else if (mesh_.component_of_triangle[at(contact.pair.a)] ==
               mesh_.component_of_triangle[at(contact.pair.b)]) {
      lane.found_ignored = true;
    }
  }
}

// Only contacts that count bound a search for the first one.
void FeatureContacts::note_ends(std::size_t found_before, std::size_t counted_before,
                                Lane& lane) const {
  if (relation_ && relation_->is_of_features()) {
    for (const auto& contact : std::span(lane.found_counted).subspan(counted_before))
      lane.least_end = std::min(lane.least_end, contact.time.hi);
    return;
  }
  for (const auto& contact : std::span(lane.found).subspan(found_before)) {
    if (contact.time.hi < lane.least_end &&
        (!relation_ || relation_->counts(mesh_, contact.pair))) {
      lane.least_end = contact.time.hi;
    }
  }
}

double FeatureContacts::least_end() const {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& lane : lanes_) least = std::min(least, lane->least_end);
  return least;
}

constexpr std::size_t pairs_between_stops = 64;

std::optional<bool> FeatureContacts::found_ignored(const StopFunction& stop) const {
  if (!relation_ || !relation_->sorts_contacts()) return false;
  if (relation_->is_of_features()) {
    return std::any_of(lanes_.begin(), lanes_.end(),
                       [](const auto& lane) { return lane->found_ignored; });
  }
  std::size_t count = 0;
  for (const auto& contact : contacts_.held()) {
    if (count++ % pairs_between_stops == 0 && stop && stop()) return std::nullopt;
    const auto [a, b] = contact.pair;
    if (mesh_.component_of_triangle[at(a)] == mesh_.component_of_triangle[at(b)] &&
        !relation_->counts(mesh_, contact.pair)) {
      return true;
    }
  }
  return false;
}

bool FeatureContacts::take_counted(const std::vector<PairContact>& contacts,
                                   const StopFunction& stop, std::vector<PairContact>& counted) {
  if (relation_->is_of_features()) {
    counted = counted_.take();
    return true;
  }
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    if (i % pairs_between_stops == 0 && stop && stop()) return false;
    if (relation_->counts(mesh_, contacts[i].pair)) counted.push_back(contacts[i]);
  }
  return true;
}

// Lanes may hand over in any order: PairContacts keeps the contact of a pair that is first in
// time, not the one that came first.
bool FeatureContacts::hand_over(Lane& lane, const StopFunction& stop) {
  if (lane.found.empty()) return true;
  const std::lock_guard guard(handing_over_);
  return hand_over(lane.found, contacts_, stop) && hand_over(lane.found_counted, counted_, stop);
}

bool FeatureContacts::hand_over(std::vector<PairContact>& found, PairContacts& contacts,
                                const StopFunction& stop) {
  for (const PairContact& contact : found) {
    if (contacts.is_nearly_full() && !contacts.make_room(stop)) return false;
    contacts.add(contact);
  }
  found.clear();
  return true;
}

void FeatureContacts::settle_in_lanes(const QueryKernels& kernels, Lane& lane) const {
  const QueryInput input = query_input(motion_);
  const std::pair<FeatureKind, QueryKernel> kernel_of[] = {
      {FeatureKind::vertex_face, kernels.vertex_face},
      {FeatureKind::edge_edge, kernels.edge_edge},
      {FeatureKind::piercing, kernels.piercing}};
  lane.open.clear();
  for (const auto& [kind, kernel] : kernel_of) {
    lane.keys.clear();
    lane.queries.clear();
    for (const FeatureKey key : lane.untested) {
      if (kind_of(key) != kind) continue;
      lane.keys.push_back(key);
      lane.queries.push_back(vertices_of(key));
    }
    kernel(input, lane.queries.data(), lane.queries.size(), lane.rungs.data());
    ContactRungCounts settled;
    for (std::size_t i = 0; i < lane.keys.size(); ++i) {
      settled.axis += lane.rungs[i] == LaneRung::axis;
      settled.filter += lane.rungs[i] == LaneRung::filter;
      if (lane.rungs[i] == LaneRung::open) lane.open.push_back(lane.keys[i]);
    }
    if (kind == FeatureKind::piercing) continue;  // piercing tests are not counted
    lane.counts.rungs += settled;
    lane.counts.elementary_tests += settled.filter;
  }
  std::swap(lane.untested, lane.open);
}

template <class Lists>
void FeatureContacts::list(Lane& lane, Lists lists) {
  if (most_keys_ == 0 || listed_ > most_keys_) return;
  const std::size_t before = lane.listed.size();
  std::copy_if(lane.untested.begin(), lane.untested.end(), std::back_inserter(lane.listed),
               [&](FeatureKey key) { return lists(kind_of(key)); });
  listed_ += lane.listed.size() - before;
}

bool FeatureContacts::run(Lane& lane, const StopFunction& stop) {
  Stopwatch watch(lane.test_time);
  list(lane, [](FeatureKind kind) { return kind != FeatureKind::piercing; });
  if (const QueryKernels* kernels = elementary_.first_rungs()) settle_in_lanes(*kernels, lane);
  list(lane, [](FeatureKind kind) { return kind == FeatureKind::piercing; });
  constexpr std::size_t tests_between_stops = 256, found_at_once = 1024;
  for (std::size_t i = 0; i < lane.untested.size(); ++i) {
    if (i % tests_between_stops == 0 && stop && stop()) return false;
    const std::size_t found_before = lane.found.size();
    const std::size_t counted_before = lane.found_counted.size();
    test(lane.untested[i], lane);
    if (lane.found.size() > found_before) {
      if (relation_ && relation_->is_of_features())
        sort_features(lane.untested[i], found_before, lane);
      if (bound_) note_ends(found_before, counted_before, lane);
    }
    if (lane.found.size() >= found_at_once && !hand_over(lane, stop)) return false;
  }
  lane.untested.clear();
  return hand_over(lane, stop);
}

bool FeatureContacts::run(const StopFunction& stop, const PacedStop* pace) {
  std::atomic<bool> completed = true;
  const auto run_lanes = [&](const LoopPiece& piece) {
    for (std::size_t lane = piece.begin; lane < piece.end; ++lane) {
      if (!run(*lanes_[lane], stop)) completed = false;
    }
  };
  if (pace && pace->workers()) {
    pace->workers()->share_out(lanes_.size(), 1, run_lanes);
  } else {
    run_lanes({0, lanes_.size(), 0});
  }
  return completed;
}

bool FeatureContacts::run(std::span<const FeatureKey> keys, const StopFunction& stop,
                          const PacedStop* pace) {
  std::atomic<bool> completed = true;
  const auto add = [&](const LoopPiece& piece) {
    Lane& lane = *lanes_[piece.lane];
    for (std::size_t i = piece.begin; i < piece.end && completed; ++i) {
      lane.untested.push_back(keys[i]);
      if (lane.untested.size() >= tests_at_once && !run(lane, stop)) completed = false;
    }
  };
  if (pace && pace->workers()) {
    pace->workers()->share_out(keys.size(), tests_at_once, add);
  } else {
    add({0, keys.size(), 0});
  }
  return completed && run(stop, pace);
}

std::optional<std::vector<FeatureKey>> FeatureContacts::take_keys() {
  if (listed_ > most_keys_) return std::nullopt;
  std::vector<FeatureKey> keys = std::move(lanes_[0]->listed);
  for (std::size_t i = 1; i < lanes_.size(); ++i)
    keys.insert(keys.end(), lanes_[i]->listed.begin(), lanes_[i]->listed.end());
  return keys;
}

namespace {

bool is_before(const PairContact& x, const PairContact& y) {
  if (x.pair != y.pair) return x.pair < y.pair;
  if (x.time != y.time) return x.time < y.time;
  if (x.feature.kind != y.feature.kind) return x.feature.kind < y.feature.kind;
  return x.feature.vertices < y.feature.vertices;
}

// The contacts of a triangle pair come soon after each other, so an added pair is mostly held
// already.
constexpr std::size_t recent_places = 4096;

std::size_t place_of(TrianglePair pair) {
  const auto mixed =
      (static_cast<std::uint64_t>(pair.a) << 32 | static_cast<std::uint32_t>(pair.b)) *
      0x9e3779b97f4a7c15u;
  return static_cast<std::size_t>(mixed >> 52);
}

constexpr std::size_t least_room = 1024;

std::size_t with_room(std::size_t size) { return size + std::max(size / 4, least_room); }

}  // namespace

void PairContacts::add(const PairContact& contact) {
  if (recent_.empty()) recent_.resize(recent_places);
  auto& place = recent_[place_of(contact.pair)];
  if (place < all_.size() && all_[place].pair == contact.pair) {
    if (is_before(contact, all_[place])) all_[place] = contact;
    return;
  }
  if (all_.size() == all_.capacity()) make_room({});
  place = static_cast<std::uint32_t>(all_.size());
  all_.push_back(contact);
}

bool PairContacts::make_room(const StopFunction& stop) {
  settle();
  // The list grows if less than a fifth of it is free; otherwise it would be sorted too often.
  const std::size_t capacity = with_room(all_.size());
  if (all_.capacity() >= capacity) return true;
  constexpr std::size_t at_once = 16'384;  // 768 KB
  std::vector<PairContact> larger;
  larger.reserve(capacity);
  for (auto next = all_.begin(); next != all_.end();) {
    const auto end = next + std::min<std::ptrdiff_t>(at_once, all_.end() - next);
    larger.insert(larger.end(), next, end);
    next = end;
    if (stop && stop()) return false;
  }
  std::swap(all_, larger);
  return true;
}

// Sorts the late contacts. One whose pair is settled replaces the settled contact if it is
// earlier; the others are merged in as new pairs.
void PairContacts::settle() {
  const auto late = all_.begin() + static_cast<std::ptrdiff_t>(settled_);
  std::sort(late, all_.end(), is_before);
  auto new_end = late;
  auto place = all_.begin();
  for (auto next = late; next != all_.end(); ++next) {
    if (new_end != late && std::prev(new_end)->pair == next->pair) continue;
    place = std::lower_bound(place, late, next->pair,
                             [](const PairContact& x, TrianglePair pair) { return x.pair < pair; });
    if (place == late || place->pair != next->pair) {
      new_.push_back(next->pair);
      *new_end++ = *next;
    } else if (is_before(*next, *place)) {
      *place = *next;
    }
  }
  all_.erase(new_end, all_.end());
  merge_late(all_.size() - settled_);
  settled_ = all_.size();
}

// Merges the last `count` contacts into the settled ones. They are copied aside, and the merge
// fills the list from its end, so it needs no room but theirs.
void PairContacts::merge_late(std::size_t count) {
  if (late_.capacity() < count) {
    late_ = {};
    late_.reserve(with_room(count));
  }
  late_.assign(all_.end() - static_cast<std::ptrdiff_t>(count), all_.end());
  auto place = all_.end();
  auto settled = all_.begin() + static_cast<std::ptrdiff_t>(settled_);
  for (auto late = late_.end(); late != late_.begin();) {
    const bool is_later =
        settled != all_.begin() && is_before(*std::prev(late), *std::prev(settled));
    *--place = is_later ? *--settled : *--late;
  }
}

std::deque<TrianglePair> PairContacts::take_new_pairs() {
  settle();
  return std::exchange(new_, {});
}

std::vector<PairContact> PairContacts::take() {
  settle();
  settled_ = 0;
  new_ = {};
  late_ = {};
  return std::exchange(all_, {});
}

}  // namespace assay::detector
