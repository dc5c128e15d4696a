#include "detector/distance/nearness.h"

#include "detector/contact/contact_filter.h"
#include "detector/distance/near_exact.h"
#include "detector/distance/near_filter.h"

namespace assay::detector {
namespace {

ContactResult test_past_axis(const FourPoints& query, double d, Want want) {
  const NearResult filtered = filter_near(query, d);
  if (filtered.decision == Decision::no) return {false, {}, ContactRung::filter};
  if (filtered.decision == Decision::yes) {
    if (filtered.hi == 0 || want == Want::yes_no) return {true, {0, 0}, ContactRung::filter};
    return {true, exact_near_time_between(query, d, filtered.lo, filtered.hi, filtered.time_guess),
            ContactRung::filter};
  }
  const auto first = exact_near_time(query, d);
  return {first.has_value(), first.value_or(TimeEnclosure{}), ContactRung::unbounded};
}

class NearTest : public ElementaryTest {
 public:
  explicit NearTest(double d) : d_(d) {}
  double separation() const override { return d_; }
  bool is_apart_along_an_axis(const FourPoints& query) const override {
    return separated_along_an_axis(query, d_);
  }
  ContactResult test(const FourPoints& query, Want want) const override {
    return test_past_axis(query, d_, want);
  }

 private:
  double d_;
};

}  // namespace

ContactResult test_near(const FourPoints& query, double d, Want want) {
  if (separated_along_an_axis(query, d)) return {false, {}, ContactRung::axis};
  return test_past_axis(query, d, want);
}

std::shared_ptr<const ElementaryTest> make_near_test(double d) {
  return std::make_shared<NearTest>(d);
}

}  // namespace assay::detector
