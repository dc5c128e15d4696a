#include "properties/generators/draft.h"

#include <algorithm>
#include <set>
#include <utility>

#include "properties/random.h"

namespace assay::properties {

Point any_vector(Random& random) {
  return {random.signed_unit(), random.signed_unit(), random.signed_unit()};
}

Point integer_point(Random& random, int reach) {
  Point p;
  for (double& c : p) c = random.between(-reach, reach);
  return p;
}

void drop_unused_vertices(Draft& draft) {
  std::vector<std::int32_t> number(draft.rest().size(), -1);
  for (const auto& face : draft.faces) {
    for (const auto v : face) number[at(v)] = 0;
  }
  std::int32_t count = 0, second = 0;
  for (std::size_t v = 0; v < number.size(); ++v) {
    if (static_cast<std::int32_t>(v) == draft.second_piece) second = count;
    if (number[v] == 0) number[v] = count++;
  }
  draft.second_piece = second;
  for (auto& face : draft.faces) {
    for (auto& v : face) v = number[at(v)];
  }
  for (auto& x : draft.frames) {
    Points points;
    for (std::size_t v = 0; v < number.size(); ++v) {
      if (number[v] >= 0) points.push_back(x[v]);
    }
    x = std::move(points);
  }
}

void drop_invalid_faces(Draft& draft) {
  std::set<Face> faces;
  std::erase_if(draft.faces, [&](Face face) {
    std::ranges::sort(face);
    const bool repeats = face[0] == face[1] || face[1] == face[2];
    return repeats || !faces.insert(face).second;
  });
}

bool is_cycle(const std::vector<Face>& faces) {
  // An edge and its reverse are sorted to the same place, where they cancel.
  std::vector<std::array<std::int32_t, 3>> edges;
  for (const auto& f : faces) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t u = f[k], v = f[(k + 1) % 3];
      edges.push_back({std::min(u, v), std::max(u, v), u < v ? 1 : -1});
    }
  }
  std::ranges::sort(edges);
  for (std::size_t i = 0; i < edges.size();) {
    int sum = 0;
    std::size_t j = i;
    for (; j < edges.size() && edges[j][0] == edges[i][0] && edges[j][1] == edges[i][1]; ++j) {
      sum += edges[j][2];
    }
    if (sum != 0) return false;
    i = j;
  }
  return true;
}

Draft joined(Draft a, const Draft& b) {
  const auto offset = a.vertices();
  a.second_piece = offset;
  a.star_shaped = false;
  a.rest().insert(a.rest().end(), b.rest().begin(), b.rest().end());
  for (const auto& f : b.faces) a.faces.push_back({f[0] + offset, f[1] + offset, f[2] + offset});
  a.tags.insert(a.tags.end(), b.tags.begin(), b.tags.end());
  return a;
}

double greatest_of(const Case& c) {
  double greatest = 0;
  for (const auto& frame : c.frames) {
    if (frame.size() > 0) greatest = std::max(greatest, frame.cwiseAbs().maxCoeff());
  }
  return greatest;
}

RandomCase finished(Draft draft, std::string id) {
  RandomCase random_case;
  Case& c = random_case.c;
  c.id = std::move(id);
  c.triangles.resize(static_cast<Eigen::Index>(draft.faces.size()), 3);
  for (std::size_t t = 0; t < draft.faces.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      c.triangles(static_cast<Eigen::Index>(t), static_cast<Eigen::Index>(k)) = draft.faces[t][k];
    }
  }
  for (const auto& x : draft.frames) {
    Positions frame(static_cast<Eigen::Index>(x.size()), 3);
    for (std::size_t v = 0; v < x.size(); ++v) {
      for (std::size_t k = 0; k < 3; ++k) {
        frame(static_cast<Eigen::Index>(v), static_cast<Eigen::Index>(k)) = x[v][k];
      }
    }
    c.frames.push_back(std::move(frame));
  }
  if (!draft.q0.empty()) c.view = CaseView{std::move(draft.q0), std::move(draft.q1)};
  std::ranges::sort(draft.tags);
  draft.tags.erase(std::unique(draft.tags.begin(), draft.tags.end()), draft.tags.end());
  random_case.tags = std::move(draft.tags);
  for (const auto& tag : random_case.tags) c.about += (c.about.empty() ? "" : ", ") + tag;
  c.source = "random";
  return random_case;
}

}  // namespace assay::properties
