#include "detector/state/start.h"

#include "detector/search/feature_contacts.h"
#include "detector/state/layers.h"
#include "detector/state/winding.h"

namespace assay::detector {

bool released_by_view(const Topology& mesh, const Component& component, const PositionsView& x,
                      const Point& q0, const Point& q1) {
  return all_positive_at(mesh, component.triangles, x, q0, q1) &&
         winding_number(mesh, component.triangles, x, q0) == 1;
}

bool verify_start(const Topology& mesh, BoundingVolumeTree& tree, const PositionsView& x,
                  const std::vector<std::int32_t>& components, const StopFunction& stop,
                  std::vector<std::uint8_t>& clean) {
  Marks marks;
  marks.triangle_flags.assign(mesh.triangles.size(), 0);
  for (const auto c : components) {
    for (const auto t : mesh.components[static_cast<std::size_t>(c)].triangles) {
      marks.triangle_flags[static_cast<std::size_t>(t)] = flag::full;
    }
  }
  tree.refit(mesh, x, x);
  mark_nodes(tree, mesh, marks);
  FeatureContacts contacts(mesh, x, x, Want::yes_no);
  SearchCounts counts;
  constexpr std::uint64_t pairs_between_stops = 4096;
  const bool searched = search_pairs(
      tree, marks, PairRule::within_component, counts, [&](std::int32_t a, std::int32_t b) {
        if (counts.candidate_pairs % pairs_between_stops == 0 && stop && stop()) return false;
        contacts.add_candidate(a, b, true);
        return true;
      });
  if (!searched || !contacts.run(stop)) return false;
  std::vector<std::uint8_t> touched(mesh.triangles.size(), 0);
  for (const auto& contact : contacts.contacts()) {
    for (const auto& pair : contact.pairs) {
      touched[static_cast<std::size_t>(pair.a)] = touched[static_cast<std::size_t>(pair.b)] = 1;
    }
  }
  std::vector<std::uint8_t> seen(mesh.triangles.size(), 0);
  for (const auto c : components) {
    if (stop && stop()) return false;
    mark_clean_by_layers(mesh, mesh.components[static_cast<std::size_t>(c)], x, touched, seen,
                         clean);
  }
  return true;
}

}  // namespace assay::detector
