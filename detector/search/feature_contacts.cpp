#include "detector/search/feature_contacts.h"

#include <algorithm>

#include "detector/contact/contact_filter.h"

namespace assay::detector {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

// A feature pair as one number: kind, first index (vertex or edge), second (face or edge).
constexpr int index_bits = 31;
constexpr std::uint64_t index_mask = (std::uint64_t{1} << index_bits) - 1;

std::uint64_t key_of(FeatureKind kind, std::int32_t first, std::int32_t second) {
  return (static_cast<std::uint64_t>(kind) << (2 * index_bits)) |
         (static_cast<std::uint64_t>(first) << index_bits) | static_cast<std::uint64_t>(second);
}
FeatureKind kind_of(std::uint64_t key) { return static_cast<FeatureKind>(key >> (2 * index_bits)); }
std::int32_t first_of(std::uint64_t key) {
  return static_cast<std::int32_t>((key >> index_bits) & index_mask);
}
std::int32_t second_of(std::uint64_t key) { return static_cast<std::int32_t>(key & index_mask); }

bool contains(const std::array<std::int32_t, 3>& triangle, std::int32_t vertex) {
  return triangle[0] == vertex || triangle[1] == vertex || triangle[2] == vertex;
}

// Whether an edge and a face are strictly ordered along an axis at t=0.
bool apart_at_start(const PositionsView& x, const std::array<std::int32_t, 2>& e,
                    const std::array<std::int32_t, 3>& f) {
  for (Eigen::Index k = 0; k < 3; ++k) {
    const auto [e_lo, e_hi] = std::minmax({x(e[0], k), x(e[1], k)});
    const auto [f_lo, f_hi] = std::minmax({x(f[0], k), x(f[1], k), x(f[2], k)});
    if (e_hi < f_lo || f_hi < e_lo) return true;
  }
  return false;
}

constexpr std::size_t first_compaction = std::size_t{1} << 22;

}  // namespace

FeatureContacts::FeatureContacts(const Topology& mesh, const PositionsView& x_t0,
                                 const PositionsView& x_t1, const ElementaryTest& elementary,
                                 Want want)
    : mesh_(mesh),
      x_t0_(x_t0),
      x_t1_(x_t1),
      elementary_(elementary),
      want_(want),
      compact_at_(first_compaction) {}

FourPoints FeatureContacts::query(std::uint64_t key) const {
  const auto point = [&](std::int32_t v) { return moving_point(x_t0_, x_t1_, v); };
  if (kind_of(key) == FeatureKind::vertex_face) {
    const auto& f = mesh_.triangles[at(second_of(key))];
    return {{point(first_of(key)), point(f[0]), point(f[1]), point(f[2])}, 1};
  }
  const auto &a = mesh_.edges[at(first_of(key))], &b = mesh_.edges[at(second_of(key))];
  return {{point(a[0]), point(a[1]), point(b[0]), point(b[1])}, 2};
}

void FeatureContacts::note(std::uint64_t key) {
  if (separated_along_an_axis(query(key))) {
    counts_.rungs.add(ContactRung::axis);
    return;
  }
  noted_.push_back(key);
}

void FeatureContacts::compact() {
  std::sort(noted_.begin(), noted_.end());
  noted_.erase(std::unique(noted_.begin(), noted_.end()), noted_.end());
  compact_at_ = std::max(first_compaction, 2 * noted_.size());
}

void FeatureContacts::add_candidate(std::int32_t a, std::int32_t b, bool may_pierce) {
  if (noted_.size() >= compact_at_) compact();
  const auto &ta = mesh_.triangles[at(a)], &tb = mesh_.triangles[at(b)];
  for (const auto v : ta) {
    if (!contains(tb, v)) note(key_of(FeatureKind::vertex_face, v, b));
  }
  for (const auto v : tb) {
    if (!contains(ta, v)) note(key_of(FeatureKind::vertex_face, v, a));
  }
  for (const auto ea : mesh_.triangle_edges[at(a)]) {
    const auto& u = mesh_.edges[at(ea)];
    for (const auto eb : mesh_.triangle_edges[at(b)]) {
      const auto& v = mesh_.edges[at(eb)];
      if (u[0] == v[0] || u[0] == v[1] || u[1] == v[0] || u[1] == v[1]) continue;
      note(key_of(FeatureKind::edge_edge, std::min(ea, eb), std::max(ea, eb)));
    }
  }
  if (!may_pierce) return;
  const auto add_piercing = [&](std::int32_t edges_of, std::int32_t face) {
    const auto& f = mesh_.triangles[at(face)];
    for (const auto e : mesh_.triangle_edges[at(edges_of)]) {
      const auto& ends = mesh_.edges[at(e)];
      if (contains(f, ends[0]) || contains(f, ends[1])) continue;
      if (apart_at_start(x_t0_, ends, f)) continue;
      noted_.push_back(key_of(FeatureKind::piercing, e, face));
    }
  };
  add_piercing(a, b);
  add_piercing(b, a);
}

void FeatureContacts::test(std::uint64_t key) {
  FeatureContact contact;
  const auto first = first_of(key), second = second_of(key);
  const auto& face = mesh_.triangles[at(second)];
  if (kind_of(key) == FeatureKind::piercing) {
    const auto& e = mesh_.edges[at(first)];
    if (!elementary_.pierces(
            point_of(x_t0_, e[0]), point_of(x_t0_, e[1]),
            {point_of(x_t0_, face[0]), point_of(x_t0_, face[1]), point_of(x_t0_, face[2])})) {
      return;
    }
    contact.feature = {FeatureKind::piercing, {e[0], e[1], face[0], face[1], face[2]}};
    for (const auto t : mesh_.edge_triangles.row(first)) {
      contact.pairs.push_back({std::min(t, second), std::max(t, second)});
    }
  } else {
    ++counts_.elementary_tests;
    const ContactResult result = elementary_.test(query(key), want_);
    counts_.rungs.add(result.rung);
    if (!result.contact) return;
    contact.time = result.time;
    if (kind_of(key) == FeatureKind::vertex_face) {
      contact.feature = {FeatureKind::vertex_face, {first, face[0], face[1], face[2], -1}};
      for (const auto t : mesh_.vertex_triangles.row(first)) {
        contact.pairs.push_back({std::min(t, second), std::max(t, second)});
      }
    } else {
      const auto &a = mesh_.edges[at(first)], &b = mesh_.edges[at(second)];
      contact.feature = {FeatureKind::edge_edge, {a[0], a[1], b[0], b[1], -1}};
      for (const auto t : mesh_.edge_triangles.row(first)) {
        for (const auto s : mesh_.edge_triangles.row(second)) {
          contact.pairs.push_back({std::min(t, s), std::max(t, s)});
        }
      }
    }
  }
  contacts_.push_back(std::move(contact));
}

bool FeatureContacts::run(const StopFunction& stop) {
  compact();
  std::vector<std::uint64_t> fresh;
  std::set_difference(noted_.begin(), noted_.end(), tested_.begin(), tested_.end(),
                      std::back_inserter(fresh));
  noted_.clear();
  constexpr std::size_t tests_between_stops = 256;
  for (std::size_t i = 0; i < fresh.size(); ++i) {
    if (i % tests_between_stops == 0 && stop && stop()) return false;
    test(fresh[i]);
  }
  const auto middle = static_cast<std::ptrdiff_t>(tested_.size());
  tested_.insert(tested_.end(), fresh.begin(), fresh.end());
  std::inplace_merge(tested_.begin(), tested_.begin() + middle, tested_.end());
  return true;
}

std::vector<PairContact> FeatureContacts::pair_contacts() const {
  std::vector<PairContact> out;
  for (const auto& contact : contacts_) {
    for (const auto& pair : contact.pairs) out.push_back({pair, contact.time, contact.feature});
  }
  std::sort(out.begin(), out.end(), [](const PairContact& x, const PairContact& y) {
    if (x.pair != y.pair) return x.pair < y.pair;
    if (x.time != y.time) return x.time < y.time;
    if (x.feature.kind != y.feature.kind) return x.feature.kind < y.feature.kind;
    return x.feature.vertices < y.feature.vertices;
  });
  out.erase(
      std::unique(out.begin(), out.end(),
                  [](const PairContact& x, const PairContact& y) { return x.pair == y.pair; }),
      out.end());
  return out;
}

}  // namespace assay::detector
