// The textbook method (cubic.h) in doubles, with the roots by Eigen's PolynomialSolver.
//
// Version: the version of the Eigen library that it is compiled with. Functions:
// Eigen::PolynomialSolver of the unsupported module Polynomials, compute and realRoots. Settings:
// the defaults (a root is real if its imaginary part is below the dummy precision of doubles,
// 1e-12), and the tolerance of cubic_closed.cpp. The solver divides by the leading coefficient, so
// the peer leaves out leading coefficients that are 0, as users of the solver do. Contract and
// claims: as in cubic_closed.cpp and from the same paper, because they belong to the method. Eigen
// promises less: its solver is "guaranteed to provide a correct result only when the complex roots
// have distinct moduli". So it is no fault of Eigen if a contact is missed because two roots have
// the same modulus.
#include <Eigen/Core>
#include <unsupported/Eigen/Polynomials>

#include "corpus/peers/cubic.h"

namespace assay::peers {
namespace {

struct EigenSolver {
  using Number = double;
  static constexpr double tolerance = 1e-6;

  static Roots<double> roots_of(double a, double b, double c, double d) {
    Roots<double> roots;
    if (a != 0) {
      keep<3>({d, c, b, a}, roots);
    } else if (b != 0) {
      keep<2>({d, c, b}, roots);
    } else if (c != 0) {
      roots.add(-d / c);
    }
    return roots;
  }

 private:
  // REQUIRES the constant coefficient first.
  template <int degree>
  static void keep(const double (&coefficients)[degree + 1], Roots<double>& roots) {
    const Eigen::Map<const Eigen::Matrix<double, degree + 1, 1>> polynomial(coefficients);
    const Eigen::PolynomialSolver<double, degree> solver(polynomial);
    std::vector<double> real;
    solver.realRoots(real);
    for (const double t : real) roots.add(t);
  }
};

constexpr const char version[] = {'0' + EIGEN_WORLD_VERSION, '.', '0' + EIGEN_MAJOR_VERSION, '.',
                                  '0' + EIGEN_MINOR_VERSION, 0};

struct CubicEigen : FeaturePairs<CubicTests<EigenSolver>> {
  using FeaturePairs::FeaturePairs;
  static plugin::Description describe() {
    plugin::Description d = cubic_description();
    d.name = "cubic by Eigen's PolynomialSolver";
    d.version = version;
    d.time_tolerance = EigenSolver::tolerance;
    return d;
  }
};

}  // namespace
}  // namespace assay::peers

ASSAY_EXPORT_DETECTOR(assay::peers::CubicEigen);
