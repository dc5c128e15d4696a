#include "detector/contact/elementary.h"

#include "detector/contact/contact_doubles.h"
#include "detector/contact/contact_exact.h"
#include "detector/contact/contact_filter.h"
#include "detector/contact/contact_until.h"

namespace assay::detector {

ContactResult test_contact(const FourPoints& query, Want want) {
  if (separated_along_an_axis(query)) return {false, {}, ContactRung::axis};
  return test_contact_past_axis(query, want);
}

ContactResult test_contact_past_axis(const FourPoints& query, Want want) {
  const FilterResult filtered = filter_contact(query, want);
  if (filtered.decision == Decision::no) return {false, {}, ContactRung::filter};
  if (filtered.decision == Decision::yes) {
    if (want == Want::yes_no) return {true, {}, ContactRung::filter};
    if (filtered.time_bracketed) {
      return {true, exact_bracketed_time(query, filtered.lo, filtered.hi, filtered.time_guess),
              ContactRung::filter};
    }
  }
  ContactResult result = exact_contact(query, want);
  // The filter knew that there is a contact, and only its time was left to the integers.
  if (filtered.decision != Decision::open) result.rung = ContactRung::filter;
  return result;
}

bool ElementaryTest::is_apart_along_an_axis(const FourPoints& query) const {
  return separated_along_an_axis(query);
}

ContactResult ElementaryTest::test_until(const FourPoints& query, Want want, double until) const {
  if (separation() > 0) return test(query, want);
  switch (surely_later(query, until)) {
    case Later::by_doubles:
      return {false, {}, ContactRung::filter};
    case Later::by_integers:
      return {false, {}, ContactRung::fixed};
    case Later::no:
      break;
  }
  return test(query, want);
}

namespace {

class ExactTest : public ElementaryTest {
 public:
  const QueryKernels* first_rungs() const override { return &query_kernels(); }
};

class BoundedTest : public ElementaryTest {
 public:
  ContactResult test(const FourPoints& query, Want want) const override {
    return bounded_contact(query, want);
  }
  bool pierces(const Point& e0, const Point& e1, const std::array<Point, 3>& face) const override {
    return bounded_piercing(e0, e1, face) != Decision::no;
  }
  TimeEnclosure piercing_time(const Point& e0, const Point& e1,
                              const std::array<Point, 3>& face) const override {
    return {0, bounded_piercing(e0, e1, face) == Decision::yes ? 0.0 : 1.0};
  }
};

template <class Number>
class PlainTest : public ElementaryTest {
 public:
  ContactResult test(const FourPoints& query, Want want) const override {
    return plain_contact<Number>(query, want);
  }
  bool pierces(const Point& e0, const Point& e1, const std::array<Point, 3>& face) const override {
    return plain_piercing<Number>(e0, e1, face);
  }
};

}  // namespace

std::shared_ptr<const ElementaryTest> make_elementary_test(Arithmetic arithmetic) {
  switch (arithmetic) {
    case Arithmetic::bounded:
      return std::make_shared<BoundedTest>();
    case Arithmetic::double_precision:
      return std::make_shared<PlainTest<double>>();
    case Arithmetic::single_precision:
      return std::make_shared<PlainTest<float>>();
    case Arithmetic::exact:
      break;
  }
  return std::make_shared<ExactTest>();
}

ContactResult test_contact(const FourPoints& query, Want want, Arithmetic arithmetic) {
  if (separated_along_an_axis(query)) return {false, {}, ContactRung::axis};
  switch (arithmetic) {
    case Arithmetic::bounded:
      return bounded_contact(query, want);
    case Arithmetic::double_precision:
      return plain_contact<double>(query, want);
    case Arithmetic::single_precision:
      return plain_contact<float>(query, want);
    case Arithmetic::exact:
      break;
  }
  return test_contact_past_axis(query, want);
}

}  // namespace assay::detector
