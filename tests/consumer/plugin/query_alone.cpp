// A plug-in library with one elementary query, and without a detector of whole steps.
#include "detector/plugin/assay_detector.hpp"

struct QueryAlone {
  static assay::plugin::Description describe() {
    assay::plugin::Description d;
    d.name = "query alone";
    d.claims = ASSAY_CLAIM_FREE_SOUND;
    return d;
  }
  static assay::plugin::Result query(std::int32_t kind, assay::plugin::Positions,
                                     assay::plugin::Positions x_t1) {
    if (kind != ASSAY_QUERY_VERTEX_FACE) return assay::plugin::Result::undecided();
    return assay::plugin::Result::collision(x_t1[3][2], 1);
  }
};

ASSAY_EXPORT_DETECTOR(QueryAlone);
