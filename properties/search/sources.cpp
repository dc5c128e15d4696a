#include "properties/search/sources.h"

#include <fmt/format.h>

#include <map>
#include <mutex>

#include "corpus/hard/hard_families.h"
#include "properties/generators/families.h"
#include "properties/queries/query_families.h"
#include "properties/search/moves.h"
#include "properties/worker/plugin/query_case.h"

namespace assay::properties {
namespace {

// All sources of a kind together, however many they are, are drawn from in a fixed proportion to
// those of another kind: small cases of the strata's families most often, for they are cheap and
// find what is not degenerate.
constexpr int weight_of_a_kind = 400;

// Exponents over all doubles take the oracle a hundred times as long as others.
int weight_of_queries(std::string_view queries) {
  const bool is_dear = queries.ends_with("exponents") || queries.ends_with("extreme") ||
                       queries.ends_with("denormals");
  return is_dear ? 2 : weight_of_a_kind / 8;
}

// Draws until a case is small enough, which most are.
template <class Make>
corpus::Case small_case(const Make& make, Eigen::Index most_triangles) {
  constexpr int most_tries = 40;
  corpus::Case c = make(0);
  for (int i = 1; i < most_tries && c.triangles.rows() > most_triangles; ++i) c = make(i);
  return c;
}

CaseSource source_of(const Family& family) {
  return {std::string(family.name), weight_of_a_kind / 2,
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
            corpus::Case c = small_case(
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
  explicit CuratedCases(const SourcesAsked& asked) : leaves_out_(asked.leaves_out) {
    if (const auto files = corpus::case_files(asked.curated)) files_ = files.value();
  }
  bool empty() const { return files_.empty(); }

  corpus::Case draw(Random& random, const std::string& id, Eigen::Index most_triangles) {
    corpus::Case c = small_case(
        [&](int) {
          return at(static_cast<std::size_t>(random.below(static_cast<int>(files_.size()))));
        },
        most_triangles);
    c.id = id;
    return c;
  }

 private:
  // A case without frames is none that is taken.
  corpus::Case at(std::size_t i) {
    const std::lock_guard lock(mutex_);
    const auto [place, is_new] = read_.try_emplace(i);
    if (is_new) {
      auto c = corpus::read_case(files_[i]);
      const bool is_refused = c && c.value().expected.answer == detector::Answer::error;
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

  std::function<bool(const corpus::Case&)> leaves_out_;
  std::vector<std::filesystem::path> files_;
  std::mutex mutex_;
  std::map<std::size_t, corpus::Case> read_;
};

}  // namespace

std::vector<CaseSource> case_sources(const SourcesAsked& asked) {
  std::vector<CaseSource> sources;
  if (asked.meshes) {
    for (const auto& family : families()) sources.push_back(source_of(family));
    for (const auto& queries : query_families()) sources.push_back(meshes_of(queries));
    for (const auto& hard : corpus::hard_families()) sources.push_back(source_of(hard));
    const auto curated = std::make_shared<CuratedCases>(asked);
    if (!asked.curated.empty() && !curated->empty()) {
      sources.push_back(
          {"curated", weight_of_a_kind / 2,
           [curated](Random& random, const std::string& id, Eigen::Index most_triangles) {
             return curated->draw(random, id, most_triangles);
           }});
    }
  }
  if (asked.queries) {
    for (const auto& queries : query_families()) sources.push_back(source_of(queries));
  }
  return sources;
}

}  // namespace assay::properties
