// At a time r at which the four points are coplanar, the hulls of the two groups meet if and only
// if the points have a non-zero affine dependency that is >= 0 on the first group and <= 0 on the
// second. If the lam of one axis (contact_pieces.h) are not all zero, these lam span all
// dependencies. If all 12 lam vanish, the points are collinear, and their signed distances along an
// axis decide. If the distances vanish too, the points coincide. So parallel edges, slivers,
// zero-length edges and points at rest are no special cases.
#include "detector/contact/rungs.h"
#include "detector/exact/real_root.h"

namespace assay::detector {
namespace {

class ExactContact {
 public:
  explicit ExactContact(const FourPoints& query) : query_(query) {
    // Multiplies each axis by a power of two of its own: an affine map, as in contact_pieces.h.
    for (std::size_t k = 0; k < 3; ++k) {
      std::array<double, 8> values;
      for (std::size_t i = 0; i < 4; ++i) {
        values[2 * i] = query.points[i].t0[k];
        values[2 * i + 1] = query.points[i].t1[k];
      }
      std::array<Integer, 8> scaled;
      to_common_integers(values, scaled);
      for (std::size_t i = 0; i < 4; ++i) {
        x_[i][k] = Polynomial::linear(scaled[2 * i], scaled[2 * i + 1]);
      }
    }
    for (std::size_t j = 0; j < 3; ++j) {
      for (std::size_t k = 0; k < 3; ++k) u_[j][k] = x_[j + 1][k] - x_[0][k];
    }
    for (std::size_t k = 0; k < 3; ++k) lam1_[k] = minor(1, 2, k);
  }

  Polynomial coplanarity() const {
    return u_[0][0] * lam1_[0] + u_[0][1] * lam1_[1] + u_[0][2] * lam1_[2];
  }

  std::optional<TimeEnclosure> first_contact() {
    const Polynomial f = coplanarity();
    if (!f.is_zero()) {
      for (const auto& root : roots_in_unit_interval(f)) {
        if (contact_at(root)) return root.enclosure();
      }
      return std::nullopt;
    }
    return first_contact_of_coplanar();
  }

 private:
  Polynomial minor(std::size_t i, std::size_t j, std::size_t axis) const {
    const std::size_t p = (axis + 1) % 3, q = (axis + 2) % 3;
    return u_[i][p] * u_[j][q] - u_[i][q] * u_[j][p];
  }

  // Returns L_k,0..3 of the axis: the affine dependency with the signs of the second group turned.
  // It is computed only when it is asked for, because most queries end at the first axis.
  const std::array<Polynomial, 4>& dependency(std::size_t axis) {
    auto& l = dependencies_[axis];
    if (!l) {
      l.emplace();
      (*l)[1] = lam1_[axis];
      (*l)[2] = minor(2, 0, axis);
      (*l)[3] = minor(0, 1, axis);
      (*l)[0] = -((*l)[1] + (*l)[2] + (*l)[3]);
      for (int i = query_.first_group; i < 4; ++i) {
        auto& turned = (*l)[static_cast<std::size_t>(i)];
        turned = -turned;
      }
    }
    return *l;
  }

  template <class Visit>
  void for_each_difference(std::size_t axis, Visit visit) const {
    for (int i = 0; i < query_.first_group; ++i) {
      for (int j = query_.first_group; j < 4; ++j) {
        visit(x_[static_cast<std::size_t>(i)][axis] - x_[static_cast<std::size_t>(j)][axis]);
      }
    }
  }

  bool contact_at(const RealRoot& time) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      bool positive = false, negative = false;
      for (const auto& l : dependency(axis)) {
        const int sign = time.sign_of(l);
        positive |= sign > 0;
        negative |= sign < 0;
      }
      if (positive && negative) return false;
      if (positive || negative) return true;
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      bool positive = false, negative = false, zero = false;
      for_each_difference(axis, [&](const Polynomial& d) {
        const int sign = time.sign_of(d);
        positive |= sign > 0;
        negative |= sign < 0;
        zero |= sign == 0;
      });
      if (positive || negative) return zero || (positive && negative);
    }
    return true;
  }

  // Returns the first contact time of points that are coplanar throughout. A contact can begin only
  // at t=0 or at a root of a dependency; it is enough to look at one axis with a dependency that is
  // not identically zero. If the points are collinear throughout, a contact can begin only at t=0
  // or at a root of a difference along an axis.
  std::optional<TimeEnclosure> first_contact_of_coplanar() {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::vector<Polynomial> changing;
      for (const auto& l : dependency(axis)) {
        if (!l.is_zero()) changing.push_back(l);
      }
      if (!changing.empty()) return first_contact_among(changing);
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::vector<Polynomial> changing;
      for_each_difference(axis, [&](const Polynomial& d) {
        if (!d.is_zero()) changing.push_back(d);
      });
      if (!changing.empty()) return first_contact_among(changing);
    }
    return TimeEnclosure{0, 0};
  }

  std::optional<TimeEnclosure> first_contact_among(const std::vector<Polynomial>& changing) {
    if (contact_at(RealRoot(Dyadic::of(0)))) return TimeEnclosure{0, 0};
    std::optional<TimeEnclosure> first;
    for (const auto& polynomial : changing) {
      for (const auto& root : roots_in_unit_interval(polynomial)) {
        if (first && *first <= root.enclosure()) break;
        if (contact_at(root)) first = root.enclosure();
      }
    }
    return first;
  }

  const FourPoints& query_;
  std::array<std::array<Polynomial, 3>, 4> x_;
  std::array<std::array<Polynomial, 3>, 3> u_;
  std::array<Polynomial, 3> lam1_;
  std::array<std::optional<std::array<Polynomial, 4>>, 3> dependencies_;
};

}  // namespace

std::optional<TimeEnclosure> general_first_contact(const FourPoints& query) {
  return ExactContact(query).first_contact();
}

ContactResult exact_contact(const FourPoints& query, Want want) {
  const FixedResult fixed = fixed_contact(query, want);
  if (fixed.decision != Decision::open)
    return {fixed.decision == Decision::yes, fixed.time, ContactRung::fixed};
  const auto first = general_first_contact(query);
  return {first.has_value(), first.value_or(TimeEnclosure{}), ContactRung::unbounded};
}

TimeEnclosure general_bracketed_time(const FourPoints& query, double lo, double hi, double guess) {
  return enclose_single_root(ExactContact(query).coplanarity(), lo, hi, guess);
}

TimeEnclosure exact_bracketed_time(const FourPoints& query, double lo, double hi, double guess) {
  const auto time = fixed_bracketed_time(query, lo, hi, guess);
  return time ? *time : general_bracketed_time(query, lo, hi, guess);
}

bool coplanar_throughout(const FourPoints& query) {
  return ExactContact(query).coplanarity().is_zero();
}

}  // namespace assay::detector
