#include <vector>

#include <doctest/doctest.h>

#include "logging/study/statistics/compare.hpp"
#include "logging/study/statistics/survival.hpp"
#include "tests/relative.hpp"

namespace septet::logging {
namespace {

auto nearly(double value) { return relative(value, 1e-9); }
const std::vector longer{29.0, 30.0, 30.0, 27.0, 29.5}, shorter{23.0, 18.0, 25.0, 30.0, 21.0, 24.5, 22.0, 12.0};

}  // namespace

TEST_CASE("Hedges' g and its interval equal those of the worked example") {
  // 10 ± 2 of 12 and 8 ± 2 of 10: J = 1 − 3/79.
  const auto effect = hedges_g(MeanAndSpread{12, 10.0, 2.0}, MeanAndSpread{10, 8.0, 2.0});
  REQUIRE(effect.has_value());
  CHECK(effect->g == nearly(1.0 - 3.0 / 79.0));
  CHECK(effect->low == relative(0.076, 0.01));
  CHECK(effect->high == relative(1.848, 0.001));
  CHECK_FALSE(hedges_g(std::vector{1.0, 1.0}, std::vector{1.0, 1.0}).has_value());
  CHECK_FALSE(hedges_g(std::vector{1.0}, std::vector{1.0, 2.0}).has_value());
}

TEST_CASE("Welch's test equals SciPy's") {
  // scipy 1.17.1, stats.ttest_ind(…, equal_var=False) and its confidence_interval().
  const auto test = welch_test(longer, shorter);
  REQUIRE(test.has_value());
  CHECK(test->t == nearly(3.6590242937994795));
  CHECK(test->degrees == nearly(8.175716893326793));
  CHECK(test->p == nearly(0.0061753527699824505));
  CHECK(test->low == relative(2.6653536046206243, 1e-8));
  CHECK(test->high == relative(11.65964639537938, 1e-8));
  // scipy.stats.t.sf.
  CHECK(t_test_p(2.0, 5.0) == nearly(0.10193947882985835));
  CHECK(t_test_p(0.7, 17.3) == nearly(0.49323392394304955));
  CHECK(t_test_p(-3.3, 2.0) == nearly(0.08084769380366799));
}

TEST_CASE("Mann and Whitney's test equals SciPy's with ties and continuity") {
  const auto test = mann_whitney_test(longer, shorter);
  REQUIRE(test.has_value());
  CHECK(test->u == 36.0);
  CHECK(test->p == nearly(0.022516617529685354));
  CHECK(mann_whitney_test(std::vector{1.0}, std::vector{1.0})->p == 1.0);
}

TEST_CASE("the survival curve of 3 5 5+ 8 10+ is 0.8 0.6 0.3") {
  const std::vector<ObservedTime> seen{{10, false}, {5, false}, {3, true}, {8, true}, {5, true}};
  const auto curve = survival_curve(seen);
  REQUIRE(curve.size() == 3);
  CHECK(curve[0].share == nearly(0.8));
  CHECK(curve[1].share == nearly(0.6));
  CHECK(curve[2].share == nearly(0.3));
  CHECK(curve[2].at_risk == 2);
  CHECK(median_survival_s(curve).value() == 8.0);
  CHECK_FALSE(median_survival_s(survival_curve(std::vector<ObservedTime>{{4, false}})).has_value());
}

TEST_CASE("the log-rank test equals SciPy's") {
  std::vector<ObservedTime> first, second;
  for (const int t : {6, 13, 21, 30, 31, 37, 38, 47, 49, 50, 63, 79, 80, 82, 82, 86, 98, 149})
    first.push_back({static_cast<double>(t), true});
  for (const int t : {202, 219, 10}) first.push_back({static_cast<double>(t), false});
  for (const int t : {10, 10, 12, 13, 14, 15, 16, 17, 18, 20, 24, 24, 25, 28, 30, 33, 34})
    second.push_back({static_cast<double>(t), true});
  for (const int t : {34, 40}) second.push_back({static_cast<double>(t), false});
  // scipy 1.17.1, stats.logrank.
  const auto test = log_rank_test(first, second);
  REQUIRE(test.has_value());
  CHECK(test->chi_square == nearly(16.494011320386342));
  CHECK(test->p == relative(4.880398158605818e-05, 1e-8));
}

}  // namespace septet::logging
