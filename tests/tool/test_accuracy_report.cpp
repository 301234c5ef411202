#include "benchmarks/accuracy/accuracy_curve.h"
#include "benchmarks/accuracy/accuracy_measure.h"
#include "benchmarks/accuracy/accuracy_technique.h"
#include "benchmarks/measure/callgrind.h"
#include "benchmarks/report/label_places.h"
#include "benchmarks/report/provenance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace fx::cli {
namespace {

AccuracyPoint pointOf(const char* name, const char* tier, double p99, std::vector<double> seconds,
                      double instructions)
{
    AccuracyPoint point;
    point.setting = {name, tier, {{"tau", 10.0}}};
    point.sample.errorMean = 0.5 * p99;
    point.sample.errorP99 = p99;
    point.sample.items = 1e6;
    point.seconds = std::move(seconds);
    point.instructions = {instructions};
    return point;
}

AccuracyCurve someCurve()
{
    AccuracyCurve curve{"ray-integral", "tau-10", "ray", ShownError::P99, {}, "callgrind", 1};
    curve.points.push_back(pointOf("paper-1", "", 0.08, {0.010, 0.012}, 1000));
    curve.points.push_back(pointOf("gauss-5", "default", 1e-5, {0.016, 0.009}, 900));
    curve.points.push_back(pointOf("gauss-8", "high", 5e-7, {0.011, 0.011}, 1100));
    curve.points.push_back(pointOf("a<b", "", 0.02, {0.2, 0.3}, 9000));
    return curve;
}

size_t count(const std::string& text, const std::string& part)
{
    size_t found = 0;
    for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
        ++found;
    return found;
}

} // namespace

TEST(AccuracyErrors, areQuantilesOfTheirMagnitudesAndBiasOfTheirSigns)
{
    std::vector<double> errors;
    for (int i = -50; i <= 149; ++i)
        errors.push_back(i);
    AccuracySample sample;
    storeErrors(errors, sample);
    EXPECT_EQ(sample.errorMax, 149);
    EXPECT_EQ(sample.errorP50, 50); // 1..50 come twice
    EXPECT_EQ(sample.errorP99, 148);
    EXPECT_DOUBLE_EQ(sample.bias, 49.5);
    EXPECT_DOUBLE_EQ(sample.errorMean, (1275.0 + 11175.0) / 200.0);
}

TEST(AccuracyErrors, whatIsNotANumberIsTheWorstError)
{
    AccuracySample sample;
    storeErrors({0.0, std::numeric_limits<double>::quiet_NaN(), 0.1}, sample);
    EXPECT_TRUE(std::isinf(sample.errorMax));
    storeErrors({}, sample); // nothing to store
    EXPECT_TRUE(std::isinf(sample.errorMax));
}

TEST(AccuracyCurve, comparesTheFastestRoundsAndShowsTheRangeOfAll)
{
    const AccuracyCurve curve = someCurve();
    const TimeRatio ratio = timeRatio(curve, 1);
    EXPECT_DOUBLE_EQ(ratio.best, 0.9);
    EXPECT_DOUBLE_EQ(ratio.low, 0.75);
    EXPECT_DOUBLE_EQ(ratio.high, 1.6);
    EXPECT_DOUBLE_EQ(instructionRatio(curve, 1), 0.9);
    EXPECT_DOUBLE_EQ(nanosecondsPerItem(curve.points[1]), 9.0);
}

TEST(AccuracyCurve, theFrontHasWhatNothingBeatsInBothErrorAndTime)
{
    const AccuracyCurve curve = someCurve();
    EXPECT_FALSE(isOnFront(curve, 0)); // slower and worse than gauss-5
    EXPECT_TRUE(isOnFront(curve, 1));
    EXPECT_TRUE(isOnFront(curve, 2)); // slower, but better
    EXPECT_FALSE(isOnFront(curve, 3));
}

TEST(AccuracyCurve, settingsThatDoTheSameWorkAreBothOnTheFront)
{
    AccuracyCurve curve = someCurve();
    curve.points[3] = curve.points[1];
    curve.points[3].seconds = {0.0091, 0.0091};
    EXPECT_TRUE(isOnFront(curve, 3));
    EXPECT_TRUE(isOnFront(curve, 1));
    curve.points[3].sample.errorP99 *= 1.01;
    EXPECT_FALSE(isOnFront(curve, 3));
    curve.points[3] = curve.points[1];
    curve.points[3].seconds = {0.0095, 0.0095};
    EXPECT_FALSE(isOnFront(curve, 3));
}

TEST(AccuracyCurve, theFrontFollowsTheErrorThatIsShown)
{
    AccuracyCurve curve = someCurve();
    curve.points[0].sample.errorMean = 1e-9;
    EXPECT_FALSE(isOnFront(curve, 0));
    curve.shown = ShownError::Mean;
    EXPECT_TRUE(isOnFront(curve, 0));
}

TEST(AccuracyCurve, jsonHasTheFieldsThatScriptsRelyOn)
{
    const nlohmann::json line = curveJson(someCurve())[1];
    EXPECT_EQ(line["technique"], "ray-integral");
    EXPECT_EQ(line["setting"], "gauss-5");
    EXPECT_EQ(line["tier"], "default");
    EXPECT_EQ(line["baseline"], "paper-1");
    EXPECT_EQ(line["parameters"]["tau"], 10.0);
    EXPECT_EQ(line["instructions"], 900);
    AccuracyCurve uncounted = someCurve();
    for (AccuracyPoint& point : uncounted.points)
        point.instructions = {0.0};
    EXPECT_TRUE(curveJson(uncounted)[1]["instructions"].is_null());
    EXPECT_TRUE(curveJson(uncounted)[1]["instruction_ratio"].is_null());
}

TEST(AccuracyCurve, efficiencyIsOneOverVarianceTimesTimeAgainstTheBaselines)
{
    AccuracyCurve curve = someCurve();
    EXPECT_EQ(efficiencyRatio(curve, 1), 0.0); // no variance, no efficiency
    EXPECT_TRUE(curveJson(curve)[1]["efficiency_ratio"].is_null());
    curve.points[0].sample.variance = 0.6;
    curve.points[1].sample.variance = 0.2;
    EXPECT_DOUBLE_EQ(efficiencyRatio(curve, 0), 1.0);
    EXPECT_DOUBLE_EQ(efficiencyRatio(curve, 1), 3.0 / 0.9);
    EXPECT_DOUBLE_EQ(curveJson(curve)[1]["efficiency_ratio"], 3.0 / 0.9);
    EXPECT_NE(curveTable(curve).find("efficiency 3.33"), std::string::npos);
}

TEST(AccuracyReport, drawsEveryPointAndItsNameInsideOfThePicture)
{
    const std::string svg = curvesSvg({someCurve(), someCurve(), someCurve()}, provenance("a machine"));
    EXPECT_EQ(count(svg, "<circle"), 12u);
    EXPECT_EQ(count(svg, ">gauss-5 (default)<"), 3u);
    EXPECT_EQ(count(svg, "a&lt;b"), 3u);
    EXPECT_EQ(count(svg, "a<b"), 0u);
    EXPECT_EQ(count(svg, "<g "), count(svg, "</g>"));
    EXPECT_NE(svg.find("a machine"), std::string::npos);
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    EXPECT_EQ(svg.find("inf"), std::string::npos);
}

TEST(AccuracyReport, drawsErrorsOfZeroAndInfinityAtTheEdges)
{
    AccuracyCurve curve = someCurve();
    curve.points[1].sample.errorP99 = 0;
    curve.points[2].sample.errorP99 = std::numeric_limits<double>::infinity();
    const std::string svg = curvesSvg({curve}, "");
    EXPECT_EQ(count(svg, "<circle"), 4u);
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    EXPECT_NE(svg.find("gauss-5 (default): exact"), std::string::npos);
}

TEST(AccuracyReport, thePageNeedsNoOtherFileAndNamesMachineAndCommit)
{
    const std::string html = curvesHtml({someCurve()}, provenance("a machine"));
    EXPECT_NE(html.find("<svg"), std::string::npos);
    EXPECT_EQ(html.find("src="), std::string::npos);
    EXPECT_EQ(html.find("href="), std::string::npos);
    EXPECT_NE(html.find(" at "), std::string::npos);
    EXPECT_NE(html.find("a machine"), std::string::npos);
    EXPECT_EQ(count(html, "<tr class=\"front\">"), 2u);
}

TEST(AccuracyReport, theTableHasARowForEachPointOfEachCurve)
{
    const std::string csv = curvesCsv({someCurve(), someCurve()}, "a machine");
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 2 + 8);
    EXPECT_EQ(count(csv, ",\"gauss-5\",default,"), 2u);
}

TEST(LabelPlaces, labelsOfPointsThatAreCloseDoNotCoverEachOther)
{
    LabelPlaces places(0, 0, 400, 300);
    std::vector<LabelPlaces::Place> found;
    for (int i = 0; i < 4; ++i)
        places.avoid(200 + 3 * i, 150);
    for (int i = 0; i < 4; ++i)
        found.push_back(places.place(200 + 3 * i, 150, "setting-1"));
    for (size_t a = 0; a < found.size(); ++a)
        for (size_t b = 0; b < a; ++b)
            EXPECT_TRUE(std::abs(found[a].y - found[b].y) > 8 || std::abs(found[a].x - found[b].x) > 50);
}

TEST(LabelPlaces, labelsStayInTheFrame)
{
    LabelPlaces places(0, 0, 400, 300);
    EXPECT_LT(places.place(395, 150, "setting-1").x, 340);
    EXPECT_GT(places.place(3, 3, "setting-1").y, 0);
}

TEST(Callgrind, totalsAreReadFromItsFiles)
{
    EXPECT_EQ(callgrindTotals("events: Ir\nsummary: 12\ntotals: 204089409\n"),
              std::vector<double>{204089409});
    EXPECT_TRUE(callgrindTotals("").empty());
}

TEST(AccuracyTasks, allMeansTheUsualScenesOfEveryTechnique)
{
    const auto tasks = accuracyTasks("all", "");
    ASSERT_TRUE(tasks.ok());
    size_t usual = 0;
    for (const AccuracyTechniqueEntry& entry : accuracyTechniques())
        usual += entry.hasFrames ? 0 : entry.usualScenes; // sequences are asked for by name
    EXPECT_EQ(tasks->size(), usual);
    EXPECT_FALSE(accuracyTasks("all", "tau-1").ok());
    EXPECT_EQ(accuracyTasks("ray-integral", "tau-10")->size(), 1u);
    EXPECT_NE(accuracyTasks("ray-integral", "tau-11").status().message().find("tau-10"), std::string::npos);
}

} // namespace fx::cli
