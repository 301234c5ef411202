// Every hard case, swept at a fifth of its steps: it keeps its limit, and plain code in the same places does
// not.
#include "benchmarks/stability/stability_picture.h"
#include "benchmarks/stability/stability_run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace {

using namespace fx;
using namespace fx::cli;

const RunWatch kToTheEnd{[] { return false; }, [](uint64_t, uint64_t) {}};

/// x 1, 2, 3; y 10, 20; error x times y / 10.
StabilityRow rowWithLimit(double limit)
{
    static double theLimit;
    theLimit = limit;
    return {"T-01", "a test", "nothing", [](bool) {
                StabilitySweep sweep{"plain, sweep",
                                     values("x", {1, 2, 3}),
                                     values("y [m]", {10, 20}),
                                     theLimit,
                                     false,
                                     [](double x, double y) { return x * y / 10.0; }};
                return std::vector<StabilitySweep>{
                    sweep, controlOf(sweep, "control", [](double x, double) { return 10.0 * x; })};
            }};
}

class EveryStabilityRow : public testing::TestWithParam<size_t>
{};

TEST_P(EveryStabilityRow, keepsItsLimitAndItsControlDoesNot)
{
    const base::Result<StabilityResult> result = runStability(stabilityRows()[GetParam()], true, kToTheEnd);
    ASSERT_TRUE(result.ok());
    size_t controls = 0;
    for (const StabilityMap& map : result->maps) {
        EXPECT_EQ(map.exceedsLimit(), map.sweep.isControl)
            << map.sweep.name << ": " << map.largest << " of " << map.sweep.limit;
        EXPECT_EQ(map.errors.size(), map.sweep.x.values.size() * map.sweep.y.values.size());
        controls += map.sweep.isControl ? 1 : 0;
    }
    EXPECT_GE(controls, 1u);
    EXPECT_GT(result->maps.size(), controls);
}

INSTANTIATE_TEST_SUITE_P(StabilityRows, EveryStabilityRow, testing::Range(size_t(0), stabilityRows().size()),
                         [](const auto& row) {
                             std::string id(stabilityRows()[row.param].id);
                             id.erase(std::remove(id.begin(), id.end(), '-'), id.end());
                             return id;
                         });

TEST(StabilityRows, haveNamesOfTheirOwn)
{
    std::set<std::string_view> ids;
    for (const StabilityRow& row : stabilityRows()) {
        EXPECT_TRUE(ids.insert(row.id).second) << row.id;
        std::set<std::string> names;
        for (const StabilitySweep& sweep : row.sweeps(true))
            EXPECT_TRUE(names.insert(sweep.name).second) << row.id << ' ' << sweep.name;
    }
    EXPECT_EQ(ids.size(), 79u);
}

TEST(StabilityRun, findsTheLargestErrorAndItsPlace)
{
    const base::Result<StabilityResult> result = runStability(rowWithLimit(7.0), true, kToTheEnd);
    ASSERT_TRUE(result.ok());
    const StabilityMap& map = result->tightest();
    EXPECT_EQ(map.largest, 6.0);
    EXPECT_EQ(map.atX, 3.0);
    EXPECT_EQ(map.atY, 20.0);
    EXPECT_TRUE(result->isAsItMust());
    EXPECT_EQ(toText(*result),
              "T-01 ok      6 of 7, plain, sweep, at x = 3, y [m] = 20; control breaks: control 30");
}

TEST(StabilityRun, tellsOfEverySweep)
{
    const base::Result<StabilityResult> result = runStability(rowWithLimit(7.0), true, kToTheEnd);
    EXPECT_EQ(sweepsText(*result), "  plain, sweep: 6 of 7 at x = 3, y [m] = 20\n"
                                   "  control (control): 30 of 7 at x = 3, y [m] = 10\n");
}

TEST(StabilityRun, saysWhatIsBroken)
{
    const base::Result<StabilityResult> product = runStability(rowWithLimit(5.0), true, kToTheEnd);
    EXPECT_FALSE(product->isAsItMust());
    EXPECT_NE(toText(*product).find("BROKEN"), std::string::npos);
    const base::Result<StabilityResult> control = runStability(rowWithLimit(30.0), true, kToTheEnd);
    EXPECT_FALSE(control->isAsItMust());
    EXPECT_NE(toText(*control).find("CONTROL HOLDS"), std::string::npos);
}

TEST(StabilityRun, whatIsNotANumberIsAnInfiniteError)
{
    const StabilityRow row{"T-02", "", "", [](bool) {
                               return std::vector<StabilitySweep>{
                                   {"one", values("x", {0, 1, 2}), values("y", {0}), 1e300, false,
                                    [](double x, double) { return x == 1.0 ? std::nan("") : 0.0; }}};
                           }};
    const base::Result<StabilityResult> result = runStability(row, true, kToTheEnd);
    EXPECT_FALSE(result->isAsItMust());
    EXPECT_EQ(result->maps[0].atX, 1.0);
    EXPECT_TRUE(std::isinf(result->maps[0].largest));
}

TEST(StabilityRun, stopsBetweenPlaces)
{
    uint64_t places = 0;
    const RunWatch watch{[&] { return places == 4; },
                         [&](uint64_t done, uint64_t all) {
                             places = done;
                             EXPECT_EQ(all, 12u);
                         }};
    EXPECT_EQ(runStability(rowWithLimit(7.0), true, watch).status().code(), base::Code::Interrupted);
    EXPECT_EQ(places, 4u);
}

TEST(StabilityMaps, haveALineAPlace)
{
    const base::Result<StabilityResult> result = runStability(rowWithLimit(7.0), true, kToTheEnd);
    const std::string csv = mapCsv(*result, result->maps[0], "here");
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 3 + 1 + 6);
    EXPECT_NE(csv.find("\"x\",\"y [m]\",\"error\"\n1,10,1\n"), std::string::npos);
    EXPECT_NE(csv.find("\n3,20,6\n"), std::string::npos);
    EXPECT_EQ(fileStem(*result, result->maps[0]), "T-01-plain-sweep");
}

/// Whether any pixel is more red than green by this much.
size_t redPixels(const image::Image& picture)
{
    size_t count = 0;
    for (size_t i = 0; i + 2 < picture.pixels.size(); i += 3)
        count += picture.pixels[i] > picture.pixels[i + 1] + 0.4f ? 1 : 0;
    return count;
}

TEST(StabilityMaps, areRedWhereTheLimitIsBroken)
{
    const base::Result<StabilityResult> result = runStability(rowWithLimit(7.0), true, kToTheEnd);
    const size_t ofScale = redPixels(mapPicture(*result, result->maps[0])); // the color scale has red too
    const size_t ofControl = redPixels(mapPicture(*result, result->maps[1]));
    EXPECT_GT(ofControl, ofScale + 100000); // errors of 10, 20, 30 everywhere: 540 by 270 pixels
    EXPECT_LT(ofScale, 2000u);
}

TEST(StabilityMaps, areRedWhereverWhatHasToBeExactIsNot)
{
    const StabilityRow row{"T-03", "", "", [](bool) {
                               return std::vector<StabilitySweep>{{"exact", values("x", {1e-9, 1e-3, 1}),
                                                                   values("y", {0}), 0.0, false,
                                                                   [](double x, double) { return x; }}};
                           }};
    const base::Result<StabilityResult> result = runStability(row, true, kToTheEnd);
    EXPECT_GT(redPixels(mapPicture(*result, result->maps[0])), 140000u); // of 540 by 270, less the frame
}

TEST(StabilityMaps, haveWordsInThePicture)
{
    image::Image across{40, 20, 3, std::vector<float>(2400, 1.0f)};
    image::Image upwards = across, outside = across;
    drawText(across, 2, 2, "e1");
    drawText(upwards, 2, 17, "e1", true);
    drawText(outside, -500, 900, "e1");
    const auto dark = [](const image::Image& picture) {
        return std::count_if(picture.pixels.begin(), picture.pixels.end(), [](float v) { return v < 0.5f; }) /
               3;
    };
    EXPECT_EQ(dark(across), dark(upwards));
    EXPECT_GT(dark(across), 15);
    EXPECT_EQ(dark(outside), 0);
    EXPECT_LT(across.at(7 + 2 + 1, 2 + 6)[0], 0.5f); // foot of the 1
}

} // namespace
