// A search that aims: it looks for cases on which a detector fails, and does not draw them blindly.
//
// It keeps the best case of each cause in an archive, and makes new cases of these by moves
// (moves.h), or draws fresh ones. A case is the better the nearer the oracle's polynomials are to a
// degeneracy (degeneracy.h), and the farther off the detector's own answers are. Cases are small,
// because there the oracle takes microseconds.
//
// What it finds are defects. Its cases are no trials: they were chosen, so no bound rests on them.
#pragma once

#include <filesystem>
#include <functional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "properties/judging/exam.h"
#include "properties/search/moves.h"

namespace assay::properties {

// Examines some cases, each as the contract has it.
using ExamineCases = std::function<std::vector<CaseResults>(std::vector<corpus::Case>)>;

// Where fresh cases come from. A case of at most so many triangles is wanted; a larger one is not
// taken.
struct CaseSource {
  std::string name;
  int weight = 1;  // it is drawn from as often as this, in comparison
  std::function<corpus::Case(Random&, const std::string& id, Eigen::Index most_triangles)> draw;
};

struct SearchSpace {
  const Contract& contract;
  std::vector<CaseSource> sources;
  // Brings a case into a range of the contract; applied to fresh cases.
  std::function<corpus::Case(corpus::Case)> bring;
  // The detector is given the view primitives of cases; if not, none is moved.
  bool gives_views = true;
};

// A part of a search that depends on nothing but its name: it begins with an empty archive. For
// some cases at a time it has a theme (Swarm), with meshes of a size of their own, because what
// helps to find one fault keeps others away. Some themes are fresh cases alone. Others move small
// meshes onto degeneracies, or, for a detector that is given views, seek what is found by no view:
// contacts within a sheet or between nested shells that are seen from one side, and other pasts of
// such steps.
struct SearchLane {
  std::string id;           // what the ids of its cases begin with
  std::uint64_t cases = 0;  // so many are asked
};

struct SearchDefect {
  corpus::Case c;  // its id is that of the lane and the number of the case
  std::size_t configuration = 0;
  Failure failure;
  CaseRun run;              // that failed
  std::uint64_t after = 0;  // so many cases were asked in the lane, this one included
};

struct LaneResult {
  bool complete = false;            // it was not stopped
  std::uint64_t cases = 0;          // asked
  std::uint64_t defects = 0;        // cases on which some configuration fails
  std::uint64_t open = 0;           // cases on which some configuration has no verdict
  std::vector<SearchDefect> finds;  // the first of each signature and configuration
  std::set<std::string> causes;     // of the cases that the archive holds
};

// A lane of which the contract takes no case ends early. `stop` is asked between batches of cases.
// The same lane gives the same result wherever it runs.
LaneResult search(const SearchLane& lane, const SearchSpace& space, const ExamineCases& examine,
                  const std::function<bool()>& stop);

// What a lane of the search does for a while: which moves it makes, where its cases come from, how
// large they are. What helps to find one fault keeps others away, so each swarm has a theme, and
// within it about half of the sources are switched off, as its name draws; in themes of many moves
// about half of these, too.

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
// component; those of them in which it is of one sign (seen_alike).
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

// The sources of fresh cases: the families of the strata, their queries as meshes of few
// triangles and as queries, hard cases by construction, and the curated cases.

struct SourceChoice {
  bool meshes = true, queries = false;
  std::filesystem::path curated{};  // folder of the curated cases; empty: none
  // Leaves a curated case out. A fault that a case was made for is found by it without any search.
  std::function<bool(const corpus::Case&)> leaves_out{};
};

// They may be drawn from in several threads. A curated case is read when it is first drawn.
std::vector<CaseSource> case_sources(const SourceChoice& choice);

// The four points of a query as a closed mesh: a corner and the face across it, or two edges across
// each other, are its only features that do not share a vertex.
corpus::Case tetrahedron(const detector::FourPoints& query, std::string id);

// The two features of a query as a mesh of two triangles, whose other corners lie away from the
// features.
corpus::Case two_triangles(const detector::FourPoints& query, Random& random, std::string id);

}  // namespace assay::properties
