#include "properties/search/swarm.h"

#include <fmt/format.h>

namespace assay::properties {
namespace {

Theme drawn_theme(Random& random, const SearchSpace& space) {
  using enum Theme;
  constexpr Theme without_views[] = {fresh, degeneracies},
                  with_views[] = {fresh,        fresh, fresh, degeneracies, degeneracies,
                                  degeneracies, pasts, views, views,        sheets};
  return space.gives_views ? one_of(random, with_views) : one_of(random, without_views);
}

bool is_move_of(Theme theme, const Move& move) {
  if (theme == Theme::pasts) return move.kind == MoveKind::past;
  if (theme == Theme::views) return move.kind == MoveKind::view;
  if (theme == Theme::sheets) return move.kind != MoveKind::features;
  return true;
}

void choose_moves(Random& random, const SearchSpace& space, Swarm& swarm) {
  const bool by_halves = swarm.theme == Theme::degeneracies || swarm.theme == Theme::sheets;
  const std::size_t least = by_halves ? 4 : 1;
  while (swarm.moves.size() < least) {
    swarm.moves.clear();
    for (const Move& move : moves()) {
      if (!is_move_of(swarm.theme, move) || (by_halves && random.one_in(2))) continue;
      if (space.gives_views || move.kind != MoveKind::view)
        swarm.moves.insert(swarm.moves.end(), static_cast<std::size_t>(move.weight), &move);
    }
  }
}

void choose_sizes(Random& random, const SearchSpace& space, Swarm& swarm) {
  constexpr std::size_t any_frames = 9;
  if (swarm.theme == Theme::fresh) {
    // Larger cases take three quarters of the time of trials, and find least in it. Without views
    // a pair of triangles shows most of what a mesh shows.
    constexpr Eigen::Index sizes[] = {12, 24, 24, 40}, of_features[] = {4, 4, 8, 12, 24, 40};
    swarm.most_triangles = space.gives_views ? one_of(random, sizes) : one_of(random, of_features);
    swarm.most_frames = any_frames;
  } else if (swarm.theme == Theme::everything && space.gives_views) {
    swarm.most_triangles = 24;
    swarm.most_frames = any_frames;
    swarm.fresh_one_in = 2;
  } else if (is_of_culling(swarm.theme)) {
    constexpr Eigen::Index sizes[] = {8, 12, 24};
    swarm.most_triangles = one_of(random, sizes);
    swarm.most_frames = static_cast<std::size_t>(random.between(2, 5));
    swarm.fresh_one_in = random.between(2, 4);
    swarm.parents = swarm.theme == Theme::pasts ? Parents::alike : Parents::within_a_component;
  } else {
    constexpr Eigen::Index sizes[] = {4, 4, 8, 12, 24};
    swarm.most_triangles = one_of(random, sizes);
    swarm.most_frames = static_cast<std::size_t>(random.between(2, 5));
    swarm.fresh_one_in = random.between(2, 6);
  }
}

}  // namespace

Swarm::Swarm(const std::string& lane, const SearchSpace& space, std::uint64_t begin) {
  Random random(fmt::format("{}:swarm:{}", lane, begin));
  if (begin > 0) theme = drawn_theme(random, space);
  choose_moves(random, space, *this);
  while (sources.empty()) {
    for (const auto& source : space.sources) {
      if (theme == Theme::everything || random.one_in(2))
        sources.insert(sources.end(), static_cast<std::size_t>(source.weight), &source);
    }
  }
  choose_sizes(random, space, *this);
}

}  // namespace assay::properties
