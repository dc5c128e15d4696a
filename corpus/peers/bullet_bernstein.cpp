// Bullet: the continuous test of a vertex and a face of its deformable bodies.
//
// Version: 3.24, Debian libbullet-dev, floats (btScalar is float there). Function: bernsteinCCD of
// the internal header of its soft bodies, which the package installs. The peer calls the function
// as btSoftColliders::CollideCCD does: dt 1, margin SAFE_EPSILON, and normals and end positions as
// btDeformableMultiBodyDynamicsWorld::performGeometricCollisions sets them. Contract: float32;
// displacements, because Bullet knows velocities, and a difference of two positions may be no
// float; only vertex-face, no contact at the start (roots at 0 are skipped), coordinates of usual
// sizes, and no time, because the function tells no time. Claims: free-sound from the title of the
// change that added the function ("Add continuous collision detection for triangle vertex vs.
// face", pull request 2612 of bulletphysics/bullet3); total and deterministic, because it is a
// function of its arguments that returns a bool. The change states no tolerance for rounding, so
// contacts that the function misses by rounding are misses, too.
#include <BulletSoftBody/btSoftBody.h>
#include <BulletSoftBody/btSoftBodyInternals.h>

#include "corpus/peers/feature_pairs.h"

namespace assay::peers {
namespace {

struct BulletTests {
  static Time vertex_face(const FourPaths& paths) {
    const btScalar dt = 1, margin = SAFE_EPSILON;
    btSoftBody::Node nodes[4];
    for (int i = 0; i < 4; ++i) {
      auto& node = nodes[i];
      const double *x = paths.at[0][i], *end = paths.at[1][i];
      node.m_x = vector_of(x[0], x[1], x[2]);
      node.m_v = vector_of(end[0] - x[0], end[1] - x[1], end[2] - x[2]);  // without rounding
      node.m_q = node.m_x + dt * node.m_v;
    }
    const auto &a = nodes[1], &b = nodes[2], &c = nodes[3];
    btSoftBody::Face face;
    for (int i = 0; i < 3; ++i) face.m_n[i] = &nodes[i + 1];
    face.m_n0 = (b.m_x - a.m_x).cross(c.m_x - a.m_x);
    face.m_n1 = (b.m_q - a.m_q).cross(c.m_q - a.m_q);
    face.m_vn = (b.m_v - a.m_v).cross(c.m_v - a.m_v) * dt * dt;
    btVector3 barycentric;
    if (!bernsteinCCD(&face, &nodes[0], dt, margin, barycentric)) return std::nullopt;
    return plugin::Interval{{0, 1}};
  }
  // Returns nothing, because Bullet has no such test.
  static Time edge_edge(const FourPaths&) { return std::nullopt; }

 private:
  static btVector3 vector_of(double x, double y, double z) {
    return {static_cast<btScalar>(x), static_cast<btScalar>(y), static_cast<btScalar>(z)};
  }
};

struct BulletBernstein : FeaturePairs<BulletTests> {
  using FeaturePairs::FeaturePairs;
  plugin::Result evaluate(plugin::Positions x_t0, plugin::Positions ways) {
    const auto x_t1 = ends_of(x_t0, ways);
    return FeaturePairs::evaluate(x_t0, {x_t1.data(), x_t0.size()});
  }
  static plugin::Result query(std::int32_t kind, plugin::Positions x_t0, plugin::Positions ways) {
    const auto x_t1 = ends_of(x_t0, ways);
    return FeaturePairs::query(kind, x_t0, {x_t1.data(), x_t0.size()});
  }
  static plugin::Description describe() {
    auto d = usual_description("Bullet, bernsteinCCD", "3.24", ASSAY_CLAIM_FREE_SOUND);
    d.coordinates = ASSAY_COORDINATES_FLOAT32;
    d.features = ASSAY_FEATURES_VERTEX_FACE;
    d.motion = ASSAY_MOTION_DISPLACEMENT;
    return d;
  }

 private:
  // These sums are exact.
  static std::vector<double> ends_of(plugin::Positions x_t0, plugin::Positions ways) {
    std::vector<double> ends(x_t0.data(), x_t0.data() + 3 * x_t0.size());
    for (std::size_t i = 0; i < ends.size(); ++i) ends[i] += ways.data()[i];
    return ends;
  }
};

}  // namespace
}  // namespace assay::peers

ASSAY_EXPORT_DETECTOR(assay::peers::BulletBernstein);
