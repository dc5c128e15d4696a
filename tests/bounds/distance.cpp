// Claims about the filter of a distance: gaps along a vector, and places of the features.
#include "detector/distance/near_filter.cpp"
#include "tests/bounds/claims.h"

namespace assay::bounds {
namespace {

using namespace detector;

// More than the square root of 3. A vector's |n|_1 is at most that times |n|, and a vector is at
// most that times its largest component.
constexpr double root_of_3 = 1.7320508075688774;

using Place = std::array<double, 3>;

// The bounds of this filter are in units of the largest coordinate of all axes, so all are of one
// group.
FourPoints seen(int first_group, const Place& b, const Place& c, const Place& e) {
  FourPoints query;
  query.first_group = first_group;
  const Place places[] = {{0, 0, 0}, b, c, e};
  for (int i = 0; i < 4; ++i) {
    for (int k = 0; k < 3; ++k) {
      const auto at_k = static_cast<std::size_t>(k);
      auto& p = query.points[static_cast<std::size_t>(i)];
      p.t0[at_k] = coordinate("x", 6 * i + k, 0, places[i][at_k]);
      p.t1[at_k] = coordinate("x", 6 * i + 3 + k, 0, places[i][at_k]);
    }
  }
  return query;
}

// A vector that is what it is.
Vector given_vector(const std::string& name) {
  record.errors[name + name + "0"] = 0;
  record.errors[name + name + "1"] = 0;
  record.errors[name + name + "2"] = 0;
  Vector n;
  for (int k = 0; k < 3; ++k)
    n[static_cast<std::size_t>(k)] = coordinate(name, 0, k, k + 1) - coordinate(name, 1, k, 0);
  return n;
}

Recorded sum_of_sizes(const Vector& n) { return abs(n[0]) + abs(n[1]) + abs(n[2]); }

// Along a vector n a gap is off by less than gap_error times M |n|.
template <int FirstGroup>
void claim_gaps(Claims& claims) {
  const NearFilter<FirstGroup> filter(seen(FirstGroup, {-1, -2, -3}, {2, 3, 5}, {4, 1, 6}), 1);
  const Recorded time = free_number("time", 0, 1, 0.5), size = filter.gap_bound_ / root_of_3;
  typename NearFilter<FirstGroup>::Instant from, to;
  from.n = given_vector("n");
  to.n = given_vector("m");
  from.time = 0;
  to.time = 1;
  for (auto* instant : {&from, &to}) {
    instant->x = filter.at(time);
    instant->level = free_number("level", -100, -99, -100, Kind::bound);
  }
  filter.keeps_apart(from, to);
  // Of a gap at an instant, and of one in the middle. What it is compared with is proved below.
  const auto compared = record.obligations;
  record.obligations.clear();
  if (compared.size() != 2) throw std::runtime_error("two gaps are compared");
  for (const auto& [node, level] : compared) {
    const bool is_middle = at(level).op == Op::divide;
    const Recorded bound = is_middle ? size * (sum_of_sizes(from.n) + sum_of_sizes(to.n)) / 2
                                     : size * sum_of_sizes(to.n);
    record.obligations.insert({node, bound.node});
  }
  claims.write_obligations("distance-gap");
}

// A place of a feature is off by less than place_error times M, if its shares are not.
void claim_places(Claims& claims) {
  // So that each case of detector/distance/near_filter.cpp is met.
  struct Query {
    int first_group;
    Place b, c, e;
  };
  const Query queries[] = {
      {1, {1, 1, 1}, {2, 3, 1}, {3, 2, 1}},       {1, {2, 3, 1}, {1, 1, 1}, {3, 2, 1}},
      {1, {3, 2, 1}, {2, 3, 1}, {1, 1, 1}},       {1, {-1, 1, 1}, {1, 1, 1.5}, {0.5, 3, 2}},
      {1, {-1, 1, 1}, {0.5, 3, 2}, {1, 1, 1.5}},  {1, {0.5, 3, 2}, {-1, 1, 1}, {1, 1, 1.5}},
      {1, {-1, -1, 1}, {2, -1, 1.5}, {-1, 2, 2}}, {2, {1, 0.5, 1}, {2, 3, 1}, {3, 4, 2}},
      {2, {1, 0.5, 1}, {3, 4, 2}, {2, 3, 1}},     {2, {2, 0.5, 0.25}, {1, -1, 1}, {0.5, 1, 1.5}}};
  for (const auto& [group, b, c, e] : queries) {
    const NearFilter<1> filter(seen(group, b, c, e), 1);
    const Vector n = between_nearest(filter.at(free_number("time", 0, 1, 0.5)), group);
    // The shares of a face add up to at most 1 + 4 u, and its sides are at most 2 M long.
    constexpr double of_shares = 8 * 0x1p-53;
    const Recorded bound = filter.place_bound_ * (1 / root_of_3 - of_shares / place_error.value);
    record.obligations.clear();
    for (const Recorded& component : n) believe(component, bound);
    claims.write_obligations("distance-place");
  }
}

// Lengths and levels are not too small: the factor length_slack covers their roundings.
void claim_lengths(Claims& claims) {
  const Vector n = given_vector("n");
  record.errors["dd0"] = record.errors["gg0"] = 0;
  NearFilter<1> filter(seen(1, {1, 1, 1}, {2, 3, 1}, {3, 2, 1}), 1);
  filter.d_ = coordinate("d", 0, 0, 1) - coordinate("d", 1, 0, 0);
  filter.gap_bound_ = filter.place_bound_ = coordinate("g", 0, 0, 1) - coordinate("g", 1, 0, 0);
  Script level = Script::of_factors();
  level.want_factor((length(n) * (length_slack * filter.d_ + filter.gap_bound_)).node, "6b-53",
                    length_slack.value);
  claims.write("distance-level", level);
  record.obligations.clear();
}

void claim_distance(Claims& claims) {
  claim_gaps<1>(claims);
  claim_gaps<2>(claims);
  claim_places(claims);
  claim_lengths(claims);
}

const Filter filter("distance", claim_distance);

}  // namespace
}  // namespace assay::bounds
