// The view test as a stage of the detector: the signs of triangles over a step.
#pragma once

#include "detector/view/view_signs.h"

namespace assay::detector {

class ViewClassifier {
 public:
  explicit ViewClassifier(Arithmetic arithmetic = Arithmetic::exact) : arithmetic_(arithmetic) {}
  virtual ~ViewClassifier() = default;
  // Writes the signs over the step (L1, L2) of the triangles of a component of `surface`, ghosts
  // included, to signs[triangle]. REQUIRES of overriding functions that no triangle is wrongly
  // called positive or negative. It may be wrongly called zero, which only costs time. False if
  // stopped: then the signs are of no use.
  virtual bool classify(const Topology& surface, const Component& component,
                        const SteppedMesh& motion, const ViewPrimitive& primitive,
                        std::vector<ViewSign>& signs, ViewCounts& counts, PacedStop& pace) const {
    return detector::classify(surface, component, motion, primitive, signs, counts,
                              best_instruction_set(), arithmetic_, &pace);
  }

 private:
  Arithmetic arithmetic_;
};

}  // namespace assay::detector
