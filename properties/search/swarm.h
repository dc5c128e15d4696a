// What a lane of the search does for a while: which moves it makes, where its cases come from, how
// large they are. What helps to find one fault keeps others away, so each swarm has a theme, and
// within it about half of the sources are switched off, as its name draws; in themes of many moves
// about half of these, too.
#pragma once

#include <string>
#include <vector>

#include "properties/search/moves.h"
#include "properties/search/search.h"

namespace assay::properties {

enum class Theme : std::uint8_t {
  everything,    // a lane begins so: fresh cases and all moves
  fresh,         // no moves: finds what is frequent
  degeneracies,  // moves of small meshes: finds what is rare
  pasts,         // other pasts of steps in which what meets is of one sign: state (L8, L9)
  views,         // other views of what meets within a component (L1, L2, L10)
  sheets,        // meshes in which what meets is of one sign: ghosts and layers (L5, L11)
};
constexpr bool is_of_culling(Theme theme) { return theme >= Theme::pasts; }

// Which cases of the archive are moved: any; those in which what meets first meets within a
// component; those of them in which it is of one sign (focus.h).
enum class Parents : std::uint8_t { any, within_a_component, alike };

struct Swarm {
  Theme theme = Theme::everything;
  Parents parents = Parents::any;
  std::vector<const Move*> moves;          // each as often as its weight
  std::vector<const CaseSource*> sources;  // the same
  Eigen::Index most_triangles = 0;
  std::size_t most_frames = 0;
  int fresh_one_in = 1;

  // Drawn by the name of the lane and the number of its case with which the swarm begins. A
  // detector that is given no views has no themes of culling.
  Swarm(const std::string& lane, const SearchSpace& space, std::uint64_t begin);
};

}  // namespace assay::properties
