#include "properties/vectors/vectors.h"

#include <algorithm>
#include <array>

namespace assay::properties {
namespace {

using enum VectorFlag;

const std::array all_flag_texts = {
    FlagText{
        double_root,
        "two roots of the cubic coincide",
        "The cubic that is 0 where the four points are coplanar has a double root in the step. "
        "Rounding makes two roots of it, or none.",
        "A root finder that looks for changes of sign finds nothing, and the contact is missed.",
        {"https://arxiv.org/abs/2009.13349"}},
    FlagText{coplanar_throughout,
             "the four points lie in one plane all the time",
             "The cubic is 0 throughout, so it says nothing of when the features meet.",
             "A test by the cubic alone divides by 0, or takes the pair for free.",
             {"https://github.com/dartsim/dart/pull/2700"}},
    FlagText{parallel_edges,
             "the edges are parallel when they meet",
             "Two edges are parallel, or one has become a point, when they meet first.",
             "The parameters of the nearest points come from a system without a solution.",
             {"https://github.com/ipc-sim/ipc-toolkit/pull/225",
              "https://github.com/naver/anny/issues/24"}},
    FlagText{
        touch_at_end,
        "they meet at the end of a feature",
        "The vertex meets an edge or a corner of the face, or an edge the end of the other. The "
        "mesh goes on there, so who leaves the contact to a neighbour may lose it there, too.",
        "A test with strict inequalities, or with barycentric coordinates in doubles, answers "
        "free.",
        {}},
    FlagText{
        tangential,
        "two roots of the cubic nearly coincide",
        "The cubic comes nearly to a double root: within 2^-26 in doubles, 2^-10 in floats, of "
        "its size.",
        "A root finder in rounded numbers finds none of the two roots, or both where there is "
        "none.",
        {}},
    FlagText{
        near_miss,
        "they only just do not meet",
        "What is asked for does not come about, by less than 2^-26 of the extent (2^-10 in "
        "floats).",
        "A test with tolerances raises a false alarm; one without may still do so by rounding.",
        {}},
    FlagText{
        at_start,
        "it holds at the start already",
        "The first time is 0: the step begins in contact, or within the distance.",
        "The start of the step is left to the step before, or its time is told as later than 0.",
        {"https://github.com/ipc-sim/ipc-toolkit/issues/99",
         "https://github.com/Continuous-Collision-Detection/Tight-Inclusion/issues/1"}},
    FlagText{at_end,
             "it comes about at the very end",
             "The first time is 1: the features meet in the last instant of the step.",
             "The end is left to the next step, which then begins in contact.",
             {}},
    FlagText{at_rest,
             "nothing moves",
             "No point moves: the question is one of places alone.",
             "A direction of motion is normalised, which divides by 0.",
             {}},
    FlagText{no_area,
             "a triangle has no area",
             "A triangle has no area, or none when it is met: it is a segment or a point.",
             "Its normal is 0, so everything is on its plane or nothing is.",
             {"https://github.com/bulletphysics/bullet3/pull/4321"}},
    FlagText{denormal,
             "a coordinate is below the normal numbers",
             "Some coordinate is not 0 and smaller than the least normal number of its precision.",
             "Products underflow to 0, and processors that flush denormals lose the coordinate.",
             {}},
    FlagText{large_numbers,
             "coordinates are so large that products overflow",
             "Products of three coordinates are beyond the largest number of the precision.",
             "The cubic becomes infinite, or NaN, and comparisons with NaN are all false.",
             {}},
    FlagText{mixed_scales,
             "coordinates differ by more than a mantissa holds",
             "The largest coordinate has more than 2^53 times the size of the smallest (2^24 in "
             "floats).",
             "Differences lose the small coordinates, and a tolerance that fits one scale fits no "
             "other.",
             {}},
    FlagText{
        far_from_origin,
        "the features are small and far from the origin",
        "The features are far from the origin: 2^26 times their extent or more (2^12 in floats).",
        "Products of the coordinates themselves, in place of differences, lose all digits.",
        {"https://github.com/gkjohnson/three-mesh-bvh/issues/112"}},
    FlagText{huge_step,
             "a point moves by 1,000 times the extent",
             "Some point moves by 2^10 times the extent of the features or more.",
             "Tolerances in time become long ways; conservative advancement takes endless steps.",
             {}},
    FlagText{at_distance,
             "they come to the distance itself and not nearer",
             "The least distance during the step is exactly the one that is asked about.",
             "Rounding decides. Who states conservative answers says yes.",
             {}},
    FlagText{split_invariant,
             "the step stands here whole and in halves",
             "The step and its two halves are three cases. The middle of each way is exact, so the "
             "whole has a contact just if a half has one.",
             "Thresholds that go by the length of a step answer differently for whole and halves.",
             {}},
    FlagText{shared_vertex,
             "triangles meet that share a vertex",
             "Two triangles with a common vertex or edge meet elsewhere, too.",
             "Neighbours are left out of the test, so a fold that goes through itself is missed.",
             {}},
    FlagText{
        through_hole,
        "something goes through a hole",
        "The mesh has a boundary, something goes through its hole, and nothing meets.",
        "A test by volume, winding or views that takes the mesh for closed raises an alarm; one "
        "that forgets the passage misses what comes later.",
        {}},
    FlagText{many_contacts,
             "50 pairs or more meet",
             "Fifty pairs of triangles or more are in contact in one step.",
             "Buffers of a fixed size drop pairs.",
             {"https://github.com/newton-physics/newton/issues/3795",
              "https://github.com/newton-physics/newton/pull/1643"}},
    FlagText{duplicate,
             "two triangles lie in the same places",
             "Two triangles have the same three places in every frame.",
             "All is coplanar and parallel at once.",
             {}},
    FlagText{sequence,
             "several steps follow each other",
             "The case has several steps of one mesh, in order.",
             "What a detector keeps from step to step, such as boxes, caches and states, is stale.",
             {}},
};

}  // namespace

std::span<const FlagText> flag_texts() { return all_flag_texts; }

bool Vector::has(VectorFlag flag) const {
  return std::find(flags.begin(), flags.end(), flag) != flags.end();
}

VectorResult Vector::result() const {
  VectorResult greatest = VectorResult::free;
  for (const auto& step : steps) greatest = std::max(greatest, step.result);
  return greatest;
}

std::size_t VectorSet::size() const {
  std::size_t cases = 0;
  for (const auto& group : groups) cases += group.cases.size();
  return cases;
}

std::string VectorGroup::name() const {
  const std::string of_precision = std::string("-") + name_of(precision);
  if (features == VectorFeatures::mesh)
    return (question == VectorQuestion::limit ? "limits" : "steps") + of_precision;
  return std::string(name_of(features)) +
         (question == VectorQuestion::distance ? "-distance" : "") + of_precision;
}

}  // namespace assay::properties
