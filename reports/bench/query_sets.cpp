#include "reports/bench/query_sets.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "corpus/queries/query_csv.h"
#include "detector/search/feature_pairs.h"
#include "detector/search/pair_search.h"
#include "properties/numbering.h"

namespace assay::reports {
namespace {

using namespace detector;
using properties::at;

// Enumerates the feature pairs of two triangles, as keys.
class Enumeration {
 public:
  Enumeration(const Topology& mesh, const RoundedPositions& points)
      : mesh_(mesh), points_(points) {}

  void append(std::int32_t a, std::int32_t b, std::vector<FeatureKey>& keys) const {
    vertices_on_face(a, b, keys);
    vertices_on_face(b, a, keys);
    for (const auto e : mesh_.triangle_edges[at(a)]) {
      const auto& u = mesh_.edges[at(e)];
      const MovingBox box = box_of(points_[u[0]], points_[u[1]]);
      for (const auto f : mesh_.triangle_edges[at(b)]) {
        const auto& v = mesh_.edges[at(f)];
        if (u[0] == v[0] || u[0] == v[1] || u[1] == v[0] || u[1] == v[1]) continue;
        if (apart(box, box_of(points_[v[0]], points_[v[1]]))) continue;
        keys.push_back(key_of(FeatureKind::edge_edge, std::min(e, f), std::max(e, f)));
      }
    }
  }

 private:
  void vertices_on_face(std::int32_t a, std::int32_t b, std::vector<FeatureKey>& keys) const {
    const auto& face = mesh_.triangles[at(b)];
    const MovingBox box = points_.box(face);
    for (const auto v : mesh_.triangles[at(a)]) {
      if (v == face[0] || v == face[1] || v == face[2]) continue;
      if (!apart(box_of(points_[v]), box)) {
        keys.push_back(key_of(FeatureKind::vertex_face, v, b));
      }
    }
  }

  const Topology& mesh_;
  const RoundedPositions& points_;
};

// Mixes all bits, one to one, so that keys in this order are as good as shuffled. This is the last
// part of SplitMix64.
FeatureKey mixed(FeatureKey key) {
  key = (key ^ (key >> 30)) * 0xbf58476d1ce4e5b9u;
  key = (key ^ (key >> 27)) * 0x94d049bb133111ebu;
  return key ^ (key >> 31);
}

FourPoints query_of(FeatureKey key, const Topology& mesh, const SteppedMesh& motion) {
  const auto point = [&](std::int32_t v) { return motion.path(v); };
  if (kind_of(key) == FeatureKind::vertex_face) {
    const auto& f = mesh.triangles[at(second_of(key))];
    return {{point(first_of(key)), point(f[0]), point(f[1]), point(f[2])}, 1};
  }
  const auto &a = mesh.edges[at(first_of(key))], &b = mesh.edges[at(second_of(key))];
  return {{point(a[0]), point(a[1]), point(b[0]), point(b[1])}, 2};
}

// Returns false if a file is not there.
bool append_file(const std::string& csv, const std::string& truth, LabelledSet& set) {
  namespace fs = std::filesystem;
  std::error_code ignored;
  if (!fs::exists(csv, ignored) || (!truth.empty() && !fs::exists(truth, ignored))) return false;
  std::optional<fs::path> truths;
  if (!truth.empty()) truths = truth;
  const auto queries = corpus::read_queries(csv, truths);
  if (!queries) throw UnusableData(queries.error().message);
  for (const auto& q : queries.value()) {
    if (!q.truth || q.separation) continue;
    set.queries.push_back(q.query);
    set.truths.push_back(*q.truth);
  }
  return true;
}

}  // namespace

MeshCandidates mesh_candidates(const corpus::Sequence& step, std::size_t most) {
  const SteppedMesh motion = {step.frames[0], step.frames[1]};
  const Topology mesh = make_topology(step.triangles, motion.size());
  BoundingVolumeTree tree(mesh, motion.vertices_t0);
  tree.refit(mesh, motion);
  const RoundedPositions points(motion);
  const Enumeration features(mesh, points);
  std::vector<FeatureKey> keys;
  SearchCounts counts;
  const PairTables everything = EveryPair().candidates();
  TreeSearch().search({mesh, tree, Marks(tree), everything}, counts,
                      [&](std::int32_t a, std::int32_t b) {
                        features.append(a, b, keys);
                        return true;
                      });
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  MeshCandidates out;
  out.all = keys.size();
  most = std::min(most, keys.size());
  const auto before = [](FeatureKey a, FeatureKey b) { return mixed(a) < mixed(b); };
  std::partial_sort(keys.begin(), keys.begin() + static_cast<std::ptrdiff_t>(most), keys.end(),
                    before);
  for (std::size_t i = 0; i < most; ++i) {
    out.queries.push_back(query_of(keys[i], mesh, motion));
  }
  return out;
}

std::optional<LabelledSet> simulation_queries(const BenchSettings& settings) {
  LabelledSet set;
  const std::string folder = settings.file("scalable-ccd/rod-twist/");
  for (const char* name : {"3036ee", "3036vf"}) {
    if (!append_file(folder + "queries/" + name + ".csv",
                     folder + "mma_bool/" + name + "_mma_bool.json", set)) {
      return std::nullopt;
    }
  }
  return set;
}

std::optional<LabelledSet> hand_made_queries(const BenchSettings& settings) {
  namespace fs = std::filesystem;
  std::vector<std::string> files;
  std::error_code missing;
  for (fs::recursive_directory_iterator entry(settings.file("sample-queries"), missing), end;
       !missing && entry != end; entry.increment(missing)) {
    if (entry->path().extension() == ".csv") files.push_back(entry->path().string());
  }
  std::sort(files.begin(), files.end());
  LabelledSet set;
  for (const auto& file : files) append_file(file, {}, set);
  if (set.queries.empty()) return std::nullopt;
  return set;
}

std::vector<FourPoints> random_exponents(std::size_t count, int least, int most) {
  std::vector<FourPoints> out;
  for (std::size_t i = 0; i < count; ++i) {
    properties::Random random(20111, i);
    FourPoints q{};
    q.first_group = i % 2 == 0 ? 1 : 2;
    constexpr int spread = 2;
    const bool narrow = i % 4 >= 2;
    const int centre = random.between(least + spread, most - spread);
    const auto coordinate = [&] {
      const double mantissa = std::ldexp(static_cast<double>(random.next() >> 11), -53);
      const int exponent =
          narrow ? random.between(centre - spread, centre + spread) : random.between(least, most);
      return std::ldexp(random.one_in(2) ? 1 + mantissa : -1 - mantissa, exponent);
    };
    for (auto& p : q.points) {
      for (double& c : p.t0) c = coordinate();
      for (double& c : p.t1) c = coordinate();
    }
    out.push_back(q);
  }
  return out;
}

}  // namespace assay::reports
