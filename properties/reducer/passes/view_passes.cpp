// Passes that make the view primitive simpler (passes.h).
#include "properties/reducer/passes/passes.h"

namespace assay::properties {
namespace {

using corpus::Case;
using corpus::CaseView;
using Places = std::vector<detector::Point>;

void offer_view(ReductionSearch& search, const std::optional<CaseView>& view) {
  Case simpler = search.best();
  simpler.view = view;
  search.offer(simpler);
}

Places fixed(const Places& places, std::size_t frame) {
  return places.empty() ? places : Places(places.size(), places[frame]);
}

// Moves everything so that `origin` comes to (0,0,0).
Case moved(const Case& c, const detector::Point& origin) {
  Case result = c;
  const auto move = [&](Places& places) {
    for (auto& place : places) {
      for (std::size_t k = 0; k < 3; ++k) place[k] -= origin[k];
    }
  };
  for (auto& frame : result.frames) {
    frame.rowwise() -= Eigen::RowVector3d(origin[0], origin[1], origin[2]);
  }
  move(result.view->q0);
  move(result.view->q1);
  if (result.ghosts) {
    for (auto& apexes : result.ghosts->apexes) move(apexes);
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
  search.offer(moved(search.best(), view().q0.front()));
}

void drop_view(ReductionSearch& search) {
  if (search.best().view) offer_view(search, std::nullopt);
}

}  // namespace assay::properties
