#include "corpus/formats/text_lines.h"
#include "corpus/queries/query_csv.h"
#include "tests/test.h"

namespace assay::corpus {
namespace {

TEST(Numbers, NearestDoubleTiesToEven) {
  EXPECT_EQ(parse_double("0.1"), 0.1);
  EXPECT_EQ(parse_double("+1.5E+1"), 15);
  EXPECT_EQ(parse_double("-.5"), -0.5);
  EXPECT_EQ(parse_double("5."), 5);
  // 2^53 + 1 lies between two doubles; a digit far behind breaks the tie.
  EXPECT_EQ(parse_double("9007199254740993"), 9007199254740992.0);
  EXPECT_EQ(parse_double("9007199254740993." + std::string(900, '0') + "1"), 9007199254740994.0);
  EXPECT_EQ(parse_double("1.00000000000000011102230246251565404236316680908203125"), 1.0);
  EXPECT_EQ(parse_double("1.00000000000000011102230246251565404236316680908203126"),
            std::nextafter(1.0, 2.0));
}

TEST(Numbers, EndsOfTheDoubles) {
  using Limits = std::numeric_limits<double>;
  EXPECT_EQ(parse_double("5e-324"), Limits::denorm_min());
  EXPECT_EQ(parse_double("2.5e-324"), Limits::denorm_min());
  EXPECT_EQ(parse_double("2.4e-324"), 0.0);
  EXPECT_EQ(parse_double("1e-99999999999999999999"), 0.0);
  EXPECT_TRUE(std::signbit(*parse_double("-1e-999")));
  EXPECT_EQ(parse_double("0." + std::string(400, '0') + "1"), 0.0);
  EXPECT_EQ(parse_double("0e999"), 0.0);
  EXPECT_EQ(parse_double("1.7976931348623157e308"), Limits::max());
  EXPECT_EQ(parse_double("1.7976931348623159e308"), Limits::infinity());
  EXPECT_EQ(parse_double("-1e999"), -Limits::infinity());
  EXPECT_EQ(parse_double("1" + std::string(400, '0')), Limits::infinity());
  EXPECT_EQ(parse_double("1" + std::string(400, '0') + "e-400"), 1.0);
  EXPECT_EQ(parse_double("0." + std::string(400, '0') + "1e401"), 1.0);
  EXPECT_EQ(parse_double("1e99999999999999999999"), Limits::infinity());
}

TEST(Numbers, WholeWordsOnly) {
  for (const char* word :
       {"", "+", "-", ".", "1x", "1 ", " 1", "0x10", "1e", "+-1", "++1", "1,5"}) {
    EXPECT_FALSE(parse_double(word)) << word;
  }
  EXPECT_EQ(parse_integer("+7"), 7);
  EXPECT_EQ(parse_integer("-9223372036854775808"), std::numeric_limits<std::int64_t>::min());
  for (const char* word : {"", "1.0", "9223372036854775808", "+-1", "a", "1a"})
    EXPECT_FALSE(parse_integer(word)) << word;
}

TEST(TextLines, NumbersAndContinuations) {
  Lines lines("a\n\n b \\\r\n c # x\n# y\nd\\\n", '#', true);
  EXPECT_EQ(lines.next(), "a");
  EXPECT_EQ(lines.number(), 1U);
  EXPECT_EQ(lines.next(), "b  c");
  EXPECT_EQ(lines.number(), 3U);
  EXPECT_EQ(lines.next(), "d");
  EXPECT_EQ(lines.number(), 6U);
  EXPECT_EQ(lines.next(), std::nullopt);
}

TEST(Rational, ExactOrNamed) {
  const auto exact = [](std::string_view n, std::string_view d) {
    const RationalValue value = exact_double(n, d);
    EXPECT_EQ(value.state, RationalState::exact) << n << "/" << d;
    return value.value;
  };
  EXPECT_EQ(exact("1", "1"), 1);
  EXPECT_EQ(exact("-3", "4"), -0.75);
  EXPECT_EQ(exact("3", "-4"), -0.75);
  EXPECT_EQ(exact("0", "17"), 0);
  EXPECT_EQ(exact("0012", "+3"), 4);
  EXPECT_EQ(exact("7522380695832763", "18014398509481984"), std::ldexp(7522380695832763.0, -54));
  // 10^22 is the last power of ten that is a double.
  EXPECT_EQ(exact("1" + std::string(22, '0'), "1"), 1e22);
  EXPECT_EQ(exact("1" + std::string(300, '0'), "1" + std::string(278, '0')), 1e22);
  const auto state = [](std::string_view n, std::string_view d) {
    return exact_double(n, d).state;
  };
  EXPECT_EQ(state("1", "3"), RationalState::not_a_double);
  EXPECT_EQ(state("1", "10"), RationalState::not_a_double);
  EXPECT_EQ(state("1" + std::string(23, '0'), "1"), RationalState::not_a_double);
  EXPECT_EQ(state("9007199254740993", "1"), RationalState::not_a_double);
  EXPECT_EQ(state("1" + std::string(400, '0'), "1"), RationalState::not_a_double);
  EXPECT_EQ(state("1", "0"), RationalState::zero_denominator);
  for (const char* word : {"", "-", "x", "0x1", "1.5", " 1", "1 2", "--1", "1e3"}) {
    EXPECT_EQ(state(word, "1"), RationalState::not_a_number) << word;
    EXPECT_EQ(state("1", word), RationalState::not_a_number) << word;
  }
  EXPECT_EQ(state(std::string(30000, '1'), "1"), RationalState::not_a_number);
}

TEST(Rational, EndsOfTheDoubles) {
  // Long doubles reach further, and are written to their last digit.
  const auto power_of_two = [](int exponent) {
    const auto digits = std::to_string(std::ldexp(1.0L, exponent));
    return digits.substr(0, digits.find('.'));
  };
  using Limits = std::numeric_limits<double>;
  EXPECT_EQ(exact_double("1", power_of_two(1074)).value, Limits::denorm_min());
  EXPECT_EQ(exact_double("3", power_of_two(1074)).value, 3 * Limits::denorm_min());
  EXPECT_EQ(exact_double("1", power_of_two(1075)).state, RationalState::not_a_double);
  EXPECT_EQ(exact_double(power_of_two(1023), "1").value, std::ldexp(1.0, 1023));
  EXPECT_EQ(exact_double(power_of_two(1024), "1").state, RationalState::not_a_double);
}

}  // namespace
}  // namespace assay::corpus
