// Searches for cases on which a detector fails, by aiming rather than drawing blindly.
//
// The search keeps the best case of each cause in an archive, and makes new cases from these by
// moves (moves.h), or draws fresh ones. A case is better if the oracle's polynomials are nearer to
// a degeneracy (degeneracy.h), and if the detector's answers are farther off. Cases are small, so
// that the oracle takes only microseconds.
//
// The search finds defects. Its cases are no trials: they were chosen, so no bound rests on them.
#pragma once

#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "properties/judging/exam.h"
#include "properties/search/moves.h"

namespace assay::properties {

// Examines cases, each in the form that the contract asks for.
using ExamineCases = std::function<std::vector<CaseResults>(std::vector<Case>)>;

// A source of fresh cases. `draw` should make a case of at most most_triangles; a larger case is
// dropped.
struct CaseSource {
  std::string name;
  int weight = 1;  // the relative frequency of draws from this source
  std::function<Case(Random&, const std::string& id, Eigen::Index most_triangles)> draw;
};

struct SearchSpace {
  const Contract& contract;
  std::vector<CaseSource> sources;
  // Brings a case into a range of the contract; applied to fresh cases.
  std::function<Case(Case)> bring;
  // Whether the detector is given the view primitives of cases; if not, no primitive is moved.
  bool gives_views = true;
};

// A lane is a part of a search. Its cases depend only on its id, because a lane begins with an
// empty archive. Each series of its cases has a theme (Swarm), with its own size of meshes, because
// a theme that finds one fault hides others. Some themes only draw fresh cases. Others move small
// meshes onto degeneracies. If the detector is given views, further themes look for contacts that
// no view finds: contacts within a sheet or between nested shells that are seen from one side, and
// contacts after other past steps.
struct SearchLane {
  std::string id;           // the ids of its cases begin with it
  std::uint64_t cases = 0;  // the number of cases to examine
};

struct SearchDefect {
  Case c;  // its id is the lane's id and the number of the case
  std::size_t configuration = 0;
  Failure failure;
  CaseRun run;              // the run that failed
  std::uint64_t after = 0;  // cases examined in the lane so far, this one included
};

struct LaneResult {
  bool complete = false;            // the lane was not stopped
  std::uint64_t cases = 0;          // the number of cases that were examined
  std::uint64_t defects = 0;        // cases on which some configuration fails
  std::uint64_t open = 0;           // cases on which some configuration has no verdict
  std::vector<SearchDefect> finds;  // the first defect of each signature and configuration
  std::set<std::string> causes;     // the causes of the cases that the archive holds
};

// Searches in a lane. A lane ends early if none of its cases satisfies the contract. `stop` is
// called between batches of cases. The same lane gives the same result wherever it runs.
LaneResult search(const SearchLane& lane, const SearchSpace& space, const ExamineCases& examine,
                  const std::function<bool()>& stop);

// A swarm says what a lane does for a while: its moves, the sources of its cases, and their sizes.
// A choice of moves and sources that finds one fault hides others. So each swarm has a theme, and
// in it about half of the sources are switched off at random; in themes of many moves, about half
// of the moves are switched off too.

enum class Theme : std::uint8_t {
  everything,    // the first theme of a lane: fresh cases and all moves
  fresh,         // no moves: finds frequent failures
  degeneracies,  // moves of small meshes: finds rare failures
  pasts,         // other past steps before contacts of one sign: state (L8, L9)
  views,         // other views of contacts within a component (L1, L2, L10)
  sheets,        // meshes with contacts of one sign: ghosts and layers (L5, L11)
};
constexpr bool is_of_culling(Theme theme) { return theme >= Theme::pasts; }

// Which cases of the archive are moved. `any`: all cases. `within_a_component`: cases whose first
// contact is within a component. `alike`: of these, the cases whose first contact is between
// triangles of one sign (seen_alike).
enum class Parents : std::uint8_t { any, within_a_component, alike };

struct Swarm {
  Theme theme = Theme::everything;
  Parents parents = Parents::any;
  std::vector<const Move*> moves;          // drawn by their weights
  std::vector<const CaseSource*> sources;  // drawn by their weights
  Eigen::Index most_triangles = 0;
  std::size_t most_frames = 0;
  int fresh_one_in = 1;

  // Draws a swarm by the id of the lane and the number of the case with which the swarm begins. If
  // the detector is given no views, no theme of culling is drawn.
  Swarm(const std::string& lane, const SearchSpace& space, std::uint64_t begin);
};

// Chooses the sources of fresh cases: the families of the strata (families of queries give queries,
// or meshes of few triangles), hard cases by construction, and the curated cases.

struct SourceChoice {
  bool meshes = true, queries = false;
  std::filesystem::path curated{};  // folder of the curated cases; empty: none
  // Returns whether a curated case is left out. For example, the case that was made for a planted
  // fault shows the fault without any search.
  std::function<bool(const Case&)> leaves_out{};
};

// Returns the sources, for several threads. A curated case is read when it is first drawn.
std::vector<CaseSource> case_sources(const SourceChoice& choice);

// Returns the four points of a query as a closed mesh. Its only features without a shared vertex
// are a corner and the face opposite, or two opposite edges.
Case tetrahedron(const FourPoints& query, std::string id);

// Returns the two features of a query as a mesh of two triangles, whose other corners are far from
// both features.
Case two_triangles(const FourPoints& query, Random& random, std::string id);

}  // namespace assay::properties
