// Passes that drop steps, make the view primitive and the relation simpler, and let vertices rest
// (reducer/search.h).

#include "properties/changes/changes.h"
#include "properties/reducer/case_edits.h"
#include "properties/reducer/search.h"

namespace assay::properties {

void drop_later_steps(ReductionSearch& search) {
  auto steps = steps_of(search.best());
  if (search.finding().step + 1 >= steps.size()) return;
  steps.resize(search.finding().step + 1);
  search.offer(with_steps(search.best(), steps));
}

void drop_steps(ReductionSearch& search) {
  const auto size = [&] { return steps_of(search.best()).size(); };
  if (size() < 2) return;
  try_halves(search, size, [&](std::size_t begin, std::size_t end) {
    auto steps = steps_of(search.best());
    if (end - begin == steps.size()) return false;
    steps.erase(steps.begin() + static_cast<std::ptrdiff_t>(begin),
                steps.begin() + static_cast<std::ptrdiff_t>(end));
    return search.offer(with_steps(search.best(), steps));
  });
}

void merge_steps(ReductionSearch& search) {
  for (std::size_t s = 0; s + 1 < steps_of(search.best()).size() && !search.has_ended();) {
    auto steps = steps_of(search.best());
    steps[s].to = steps[s + 1].to;
    steps[s].commit = steps[s + 1].commit;
    steps.erase(steps.begin() + static_cast<std::ptrdiff_t>(s) + 1);
    if (!search.offer(with_steps(search.best(), steps))) ++s;
  }
}

namespace {
using Places = std::vector<Point>;

void offer_view(ReductionSearch& search, const std::optional<CaseView>& view) {
  Case simpler = search.best();
  simpler.view = view;
  search.offer(simpler);
}

Places fixed(const Places& places, std::size_t frame) {
  return places.empty() ? places : Places(places.size(), places[frame]);
}

// Moves everything so that `origin` comes to (0,0,0).
Case with_origin(const Case& c, const Point& origin) {
  Case result = c;
  for (int axis = 0; axis < 3; ++axis) {
    for (double* x : numbers_along(result, axis)) *x -= origin[at(axis)];
  }
  return result;
}

}  // namespace

void simplify_view(ReductionSearch& search) {
  if (!search.best().view) return;
  const auto view = [&] { return *search.best().view; };
  for (const Places& end : {view().q0, view().q1}) {
    if (!view().q1.empty()) offer_view(search, CaseView{end, {}});
  }
  for (std::size_t f = 0; f < search.best().frames.size(); ++f) {
    offer_view(search, CaseView{fixed(view().q0, f), fixed(view().q1, f)});
  }
  const Places at_origin(search.best().frames.size(), {0, 0, 0});
  offer_view(search, CaseView{at_origin, view().q1});
  if (!view().q1.empty()) offer_view(search, CaseView{view().q0, at_origin});
  search.offer(with_origin(search.best(), view().q0.front()));
}

void drop_view(ReductionSearch& search) {
  if (search.best().view) offer_view(search, std::nullopt);
}

namespace {

// Returns the vertices that move between any two frames, far ones first.
std::vector<std::int32_t> moving_vertices(const ReductionSearch& search) {
  const auto& frames = search.best().frames;
  std::vector<std::int32_t> moving;
  for (const auto v : rings_of(search).far_first) {
    for (const auto& frame : frames) {
      if (frame.row(v) == frames.front().row(v)) continue;
      moving.push_back(v);
      break;
    }
  }
  return moving;
}

}  // namespace

void freeze_vertices(ReductionSearch& search) {
  const auto size = [&] { return moving_vertices(search).size(); };
  // Each vertex is tried at rest throughout, at its place in one frame.
  for (std::size_t f = 0; f < search.best().frames.size(); ++f) {
    if (size() == 0) return;
    try_halves(search, size, [&](std::size_t begin, std::size_t end) {
      const auto moving = moving_vertices(search);
      Case still = search.best();
      for (std::size_t i = begin; i < end; ++i) {
        for (auto& frame : still.frames)
          frame.row(moving[i]) = search.best().frames[f].row(moving[i]);
      }
      return search.offer(still);
    });
  }
  // Then it is tried at rest from one frame to the next, at either place.
  for (std::size_t f = 0; search.best().frames.size() > 2 && f + 1 < search.best().frames.size();
       ++f) {
    for (const auto v : moving_vertices(search)) {
      for (const std::size_t at : {f, f + 1}) {
        Case still = search.best();
        still.frames[2 * f + 1 - at].row(v) = still.frames[at].row(v);
        if (search.offer(still)) break;
      }
    }
  }
}

namespace {

// Offers the case with this change of its relation.
template <class Change>
bool offer_relation(ReductionSearch& search, const Change& change) {
  Case simpler = search.best();
  change(simpler.counted->pairs);
  return search.offer(simpler);
}

template <class List>
void shorten(ReductionSearch& search, List CountedPairs::*list) {
  const auto size = [&] { return (search.best().counted->pairs.*list).size(); };
  if (size() == 0) return;
  try_halves(search, size, [&](std::size_t begin, std::size_t end) {
    return offer_relation(search, [&](CountedPairs& pairs) {
      const auto first = (pairs.*list).begin();
      (pairs.*list)
          .erase(first + static_cast<std::ptrdiff_t>(begin),
                 first + static_cast<std::ptrdiff_t>(end));
    });
  });
}

}  // namespace

void simplify_relation(ReductionSearch& search) {
  if (!search.best().counted) return;
  Case without = search.best();
  without.counted.reset();
  if (search.offer(without)) return;
  shorten(search, &CountedPairs::apart);
  shorten(search, &CountedPairs::triangle_pairs);
  shorten(search, &CountedPairs::vertex_faces);
  shorten(search, &CountedPairs::edge_pairs);
  while (search.best().counted->pairs.rings > 0 &&
         offer_relation(search, [](CountedPairs& pairs) { --pairs.rings; })) {
  }
  offer_relation(search, [](CountedPairs& pairs) { pairs.rest_distance = 0, pairs.rest.clear(); });
  const auto& best = search.best();
  if (best.counted->pairs.rest_distance > 0)
    offer_relation(search, [first = corpus::points_of(best.frames.front())](CountedPairs& pairs) {
      pairs.rest = first;
    });
}

}  // namespace assay::properties
