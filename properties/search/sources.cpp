#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>

#include "corpus/hard/hard_families.h"
#include "properties/changes/changes.h"
#include "properties/generators/draft.h"
#include "properties/generators/families.h"
#include "properties/queries/query_families.h"
#include "properties/random.h"
#include "properties/search/degeneracy.h"
#include "properties/search/search.h"
#include "properties/worker/plugin/query_case.h"

namespace assay::properties {
namespace {

// The sources of one kind together, however many they are, have a fixed weight against those of
// another kind. Small cases of the strata's families have the greatest weight, because they are
// cheap and find failures that are not degenerate.
constexpr int weight_of_a_kind = 400;

int weight_of_queries(std::string_view queries) {
  return is_dear_query_family(queries) ? 2 : weight_of_a_kind / 8;
}

// Returns the weight of a family. Far meshes take the oracle four times as long as others.
int weight_of_family(std::string_view family) {
  return family.find("far") == std::string_view::npos ? weight_of_a_kind / 2
                                                      : weight_of_a_kind / 10;
}

// Draws until a case is small enough, which most are.
template <class Make>
Case small_case(const Make& make, Eigen::Index most_triangles) {
  constexpr int most_tries = 40;
  Case c = make(0);
  for (int i = 1; i < most_tries && c.triangles.rows() > most_triangles; ++i) c = make(i);
  return c;
}

CaseSource source_of(const Family& family) {
  return {std::string(family.name), weight_of_family(family.name),
          [&family](Random&, const std::string& id, Eigen::Index most_triangles) {
            return small_case(
                [&](int i) { return make_case(family, fmt::format("{}~{}", id, i)).c; },
                most_triangles);
          }};
}

CaseSource meshes_of(const Family& queries) {
  return {fmt::format("mesh of {}", queries.name), weight_of_queries(queries.name),
          [&queries](Random& random, const std::string& id, Eigen::Index) {
            const auto query = query_of(make_case(queries, id).c);
            return random.one_in(2) ? tetrahedron(*query, id) : two_triangles(*query, random, id);
          }};
}

CaseSource source_of(const corpus::HardFamily& family) {
  return {fmt::format("hard {}", family.name), weight_of_a_kind / 50,
          [&family](Random& random, const std::string& id, Eigen::Index most_triangles) {
            Case c = small_case(
                [&](int) {
                  const int strength = random.between(0, family.last_strength());
                  return corpus::hard_case(family, strength, random.below(1 << 20));
                },
                most_triangles);
            c.id = id;
            c.options.clear();
            c.expected = {};
            c.ghosts.reset();
            return c;
          }};
}

class CuratedCases {
 public:
  explicit CuratedCases(const SourceChoice& choice) : leaves_out_(choice.leaves_out) {
    if (const auto files = corpus::case_files(choice.curated)) files_ = files.value();
  }
  bool empty() const { return files_.empty(); }

  Case draw(Random& random, const std::string& id, Eigen::Index most_triangles) {
    Case c = small_case(
        [&](int) {
          return at(static_cast<std::size_t>(random.below(static_cast<int>(files_.size()))));
        },
        most_triangles);
    c.id = id;
    return c;
  }

 private:
  // Returns a case; one without frames is not taken.
  Case at(std::size_t i) {
    const std::lock_guard lock(mutex_);
    const auto [place, is_new] = cases_.try_emplace(i);
    if (is_new) {
      auto c = corpus::read_case(files_[i]);
      const bool is_refused = c && c.value().expected.answer == Answer::error;
      if (c && !is_refused && !says_query(c.value()) && !(leaves_out_ && leaves_out_(c.value()))) {
        place->second = std::move(c.value());
        place->second.options.clear();
        place->second.expected = {};
        place->second.ghosts.reset();
        place->second.pending = "{}";
      }
    }
    return place->second;
  }

  std::function<bool(const Case&)> leaves_out_;
  std::vector<std::filesystem::path> files_;
  std::mutex mutex_;
  std::map<std::size_t, Case> cases_;
};

}  // namespace

std::vector<CaseSource> case_sources(const SourceChoice& choice) {
  std::vector<CaseSource> sources;
  if (choice.meshes) {
    for (const auto& family : families()) sources.push_back(source_of(family));
    for (const auto& queries : query_families()) sources.push_back(meshes_of(queries));
    for (const auto& hard : corpus::hard_families()) sources.push_back(source_of(hard));
    const auto curated = std::make_shared<CuratedCases>(choice);
    if (!choice.curated.empty() && !curated->empty()) {
      sources.push_back(
          {"curated", weight_of_a_kind / 2,
           [curated](Random& random, const std::string& id, Eigen::Index most_triangles) {
             return curated->draw(random, id, most_triangles);
           }});
    }
  }
  if (choice.queries) {
    for (const auto& queries : query_families()) sources.push_back(source_of(queries));
  }
  return sources;
}

Case tetrahedron(const FourPoints& query, std::string id) {
  Case c = case_of_query(query, std::move(id));
  c.options.clear();
  c.triangles.resize(4, 3);
  c.triangles << 0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3;
  // Outward at the start, where it has a volume.
  if (coplanarity_at(query, 0) < 0) c.triangles.col(1).swap(c.triangles.col(2));
  return c;
}

Case two_triangles(const FourPoints& query, Random& random, std::string id) {
  const bool is_vertex_face = query.first_group == 1;
  const auto first_group = static_cast<std::size_t>(query.first_group);
  const std::size_t vertices = 6;
  Case c;
  c.id = std::move(id);
  c.triangles.resize(2, 3);
  if (is_vertex_face) {
    c.triangles << 0, 4, 5, 1, 2, 3;
  } else {
    c.triangles << 0, 1, 4, 2, 3, 5;
  }
  Point first{}, second{};  // the means of the two features at the start
  double size = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double x = query.points[i].t0[k];
      i < first_group ? first[k] += x / static_cast<double>(first_group)
                      : second[k] += x / static_cast<double>(4 - first_group);
      size = std::max({size, std::abs(x - query.points[0].t0[k]),
                       std::abs(query.points[i].t1[k] - query.points[0].t0[k])});
    }
  }
  if (!(size > 0)) size = 1;
  const double unit = std::ldexp(1.0, std::clamp(std::ilogb(size), -1000, 1000));
  c.frames.assign(2, Positions(vertices, 3));
  const auto set_point = [&](int v, const MovingPoint& p) { set_path(c, {}, v, p); };
  for (int v = 0; v < 4; ++v) set_point(v, query.points[static_cast<std::size_t>(v)]);
  // A corner beside a point of its own feature, on the side away from the other feature.
  const auto corner = [&](std::size_t beside, double away) {
    MovingPoint p = query.points[beside];
    for (std::size_t k = 0; k < 3; ++k) {
      const double outward = away * (first[k] - second[k]) + unit * random.between(-2, 2);
      p.t0[k] += outward;
      p.t1[k] += outward;
    }
    return p;
  };
  const auto four = corner(is_vertex_face ? 0 : 1, 1);
  set_point(4, four);
  const auto five = corner(is_vertex_face ? 0 : 3, is_vertex_face ? 1 : -1);
  set_point(5, five);
  return c;
}

}  // namespace assay::properties
