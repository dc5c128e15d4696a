#include "properties/reducer/reducer.h"

#include <span>

#include "properties/reducer/passes/passes.h"
#include "properties/reducer/search.h"

namespace assay::properties {
namespace {

struct Pass {
  const char* name;
  void (*run)(ReductionSearch& search);
};

// The lists of passes, in the order in which they run: those that make the mesh and the sequence
// shorter, those that make the whole case simpler, those that make single numbers simpler, and the
// last resort. Passes that reduce much at little cost come first.
constexpr Pass shortening_passes[] = {
    {"drop later steps", drop_later_steps},
    {"drop steps", drop_steps},
    {"merge steps", merge_steps},
    {"drop unused vertices", drop_unused_vertices},
    {"drop ghosts", drop_ghosts},
    {"drop components", drop_components},
    {"spheres of the pair", try_spheres_of_pair},
    {"keep rings", keep_rings},
    {"cone outside", cone_outside},
    {"cut and close", cut_and_close},
    {"merge balls", merge_balls},
    {"collapse to parents", collapse_to_parents},
    {"drop faces", drop_faces},
    {"collapse edges", collapse_edges},
    {"remove and close", remove_and_close},
    {"merge twice", merge_twice},
    {"small spheres", try_small_spheres},
};

constexpr Pass simplifying_passes[] = {
    {"freeze vertices", freeze_vertices},
    {"view", simplify_view},
    {"relation", simplify_relation},
    {"round all", round_all},
    {"translate", translate},
};

constexpr Pass number_passes[] = {
    {"round vertices", round_vertices},
    {"simplify numbers", simplify_numbers},
    {"simplify together", simplify_together},
};

constexpr Pass escaping_passes[] = {{"escape", escape}};

// Runs each pass of a list once. Returns whether anything became smaller.
bool run(std::span<const Pass> passes, ReductionSearch& search) {
  const MeshSize before = search.size();
  for (const Pass& pass : passes) {
    if (search.ended()) break;
    search.begin_pass(pass.name);
    pass.run(search);
  }
  return search.size() < before;
}

// Whether a case has few numbers. If it does, simple numbers help the passes that shorten. If it
// has many, the mesh is stuck at a large size, and simplifying the numbers would take all the
// time.
bool has_few_numbers(const ReductionSearch& search) {
  constexpr std::size_t few = 300;
  return 3 * search.size().vertices * search.size().frames <= few;
}

// If a pass of a later list made the case smaller, the earlier lists may succeed again, so they
// are run from the start.
void run_all(ReductionSearch& search) {
  bool smaller = true;
  while (smaller) {
    while (run(shortening_passes, search)) {
    }
    smaller = run(simplifying_passes, search);
    if (!smaller && has_few_numbers(search)) smaller = run(number_passes, search);
    if (!smaller) smaller = run(escaping_passes, search);
    if (!smaller && !has_few_numbers(search)) smaller = run(number_passes, search);
  }
}

}  // namespace

std::string fails_from_text(std::size_t triangles) {
  return "fails from " + std::to_string(triangles) + " triangles on";
}

Reduction reduce(const corpus::Case& failing, const Judge& judge, const ReduceLimits& limits,
                 const OnBetter& on_better, const MakeViewExplicit& make_view_explicit) {
  ReductionSearch search(failing, judge, limits, on_better);
  Reduction reduction;
  if (search.found()) {
    // Steps are dropped first, because a view is made explicit for each step that remains.
    search.begin_pass("drop later steps");
    drop_later_steps(search);
    if (make_view_explicit && !search.best().view) {
      search.begin_pass("make view explicit");
      if (const auto with_view = make_view_explicit(search.best())) search.replace(*with_view);
    }
    search.begin_pass("large mesh");
    reduction.fails_from = cut_large_mesh(search);
    if (reduction.fails_from == 0) {
      run_all(search);
      const MeshSize before = search.size();
      search.begin_pass("drop view");
      drop_view(search);
      if (search.size() < before) run_all(search);
      search.begin_pass("canonical order");
      canonical_order(search);
    }
  }
  search.begin_pass("end");
  reduction.fixed_point = search.found() && !search.ended();
  reduction.smallest = search.best();
  reduction.finding = search.finding();
  reduction.calls = search.calls();
  reduction.seconds = search.seconds();
  for (const auto& pass : search.statistics()) {
    if (pass.tried + pass.accepted > 0) reduction.passes.push_back(pass);
  }
  return reduction;
}

}  // namespace assay::properties
