#include "properties/generators/draft.h"

#include <algorithm>
#include <set>
#include <utility>

#include "oracle/mesh/mesh_features.h"
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
  return oracle::closes(as_rows<Triangles>(faces), Triangles(0, 3));
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
  c.triangles = as_rows<Triangles>(draft.faces);
  for (const auto& x : draft.frames) c.frames.push_back(as_rows<Positions>(x));
  if (!draft.q0.empty()) c.view = CaseView{std::move(draft.q0), std::move(draft.q1)};
  std::ranges::sort(draft.tags);
  draft.tags.erase(std::unique(draft.tags.begin(), draft.tags.end()), draft.tags.end());
  random_case.tags = std::move(draft.tags);
  for (const auto& tag : random_case.tags) c.about += (c.about.empty() ? "" : ", ") + tag;
  c.source = "random";
  return random_case;
}

}  // namespace assay::properties
