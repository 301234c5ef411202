// Presets made at random, at any moment and from anywhere: what is drawn lies inside of the bounds that their
// snapshots tell, and inside of the sphere that decides whether they are visible. Bounds that lack one of
// their parts are found out.
#include "tests/api/bounds_trial.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>

namespace {

using fx::test::nameOf;
using fx::test::TrialResult;
using fx::test::Without;
using Json = nlohmann::json;

/// FX_BOUNDS_TRIALS and FX_BOUNDS_FIRST ask for others than a run of the tests has time for.
uint64_t number(const char* variable, uint64_t usual)
{
    const char* text = std::getenv(variable);
    return text ? std::strtoull(text, nullptr, 10) : usual;
}

/// What all trials came to.
struct Totals
{
    int drawn = 0;    ///< trials that changed a pixel
    int cut = 0;      ///< trials whose bounds reach behind the near plane
    int reaching = 0; ///< trials whose reach is known
    int onGpu = 0, thinned = 0, pictures = 0;
    std::array<int, size_t(Without::Count)> outside{};      ///< trials with a pixel outside of those bounds
    std::map<std::string, std::vector<double>> tight, room; ///< by kind

    void add(const TrialResult& trial)
    {
        drawn += trial.drawn > 0;
        cut += trial.isCut;
        reaching += std::isfinite(trial.reach);
        onGpu += trial.onGpu > 0;
        thinned += trial.thinned > 0;
        pictures += trial.pictures > 0;
        for (size_t what = 0; what < outside.size(); ++what)
            outside[what] += trial.by[what] > trial.slack;
        if (trial.tightness > 0)
            tight[trial.preset.kind].push_back(trial.tightness);
        if (trial.drawn > 0)
            room[trial.preset.kind].push_back(trial.room);
    }
};

/// Sorts.
double quantile(std::vector<double>& io, double share)
{
    std::sort(io.begin(), io.end());
    return io.empty() ? 0.0 : io[std::min(size_t(share * double(io.size())), io.size() - 1)];
}

void print(const char* what, std::map<std::string, std::vector<double>>& io)
{
    std::printf("%-34s trials  median  90 %%  most\n", what);
    for (auto& [kind, values] : io)
        std::printf("  %-32s %6zu  %6.2f  %4.2f  %4.2f\n", kind.c_str(), values.size(), quantile(values, 0.5),
                    quantile(values, 0.9), quantile(values, 1.0));
}

void print(const Totals& totals)
{
    for (size_t what = 0; what < totals.outside.size(); ++what)
        std::printf("without %-12s %4d of %d trials have pixels outside\n", nameOf(Without(what)),
                    totals.outside[what], totals.drawn);
    std::printf("reaching behind the near plane %d, with a known reach %d, on the GPU %d, thinned out %d, "
                "drawn as pictures %d\n",
                totals.cut, totals.reaching, totals.onGpu, totals.thinned, totals.pictures);
}

/// The preset with another member in its first emitter.
std::string withMember(const std::string& text, const char* member, const Json& value)
{
    Json preset = Json::parse(text);
    preset["emitters"][0][member] = value;
    return preset.dump();
}

class RandomBounds : public fx::test::BoundsTrialTest
{
protected:
    void expectInside(const TrialResult& trial, uint64_t seed) const
    {
        for (const Without what : {Without::Nothing, Without::Rows})
            EXPECT_LE(trial.by[size_t(what)], trial.slack)
                << "[pixel] from the groups' bounds without " << nameOf(what) << ", seed " << seed << "\n"
                << trial.preset.text;
        EXPECT_LE(trial.beyond, 0.0) << "[m] beyond the reach, seed " << seed << "\n" << trial.preset.text;
    }
};

} // namespace

TEST_F(RandomBounds, holdEveryPixelThatIsDrawn)
{
    const uint64_t trials = number("FX_BOUNDS_TRIALS", 300), first = number("FX_BOUNDS_FIRST", 0);
    Totals totals;
    for (uint64_t seed = first; seed < first + trials; ++seed) {
        const TrialResult trial = tryOne(seed);
        totals.add(trial);
        expectInside(trial, seed);
    }
    print("size of bounds over what is drawn", totals.tight);
    print("reach over bounds of the moment", totals.room);
    print(totals);
    if (trials < 100)
        return;
    const int hundreds = int(trials) / 100;
    EXPECT_GT(totals.drawn, int(trials) / 2);
    EXPECT_GT(totals.cut, 3 * hundreds);
    EXPECT_GT(totals.reaching, int(trials) / 2);
    EXPECT_GE(totals.onGpu, FXSDK_WITH_GPU_PARTICLES ? 2 * hundreds : 0);
    EXPECT_GE(totals.thinned, 1);
    for (const Without what : {Without::Size, Without::Children, Without::Trails}) // the control
        EXPECT_GE(totals.outside[size_t(what)], 2 * hundreds) << nameOf(what);
    for (auto& [kind, ratios] : totals.tight)
        EXPECT_LT(quantile(ratios, 0.5), 5.0) << kind; // bounds of the whole world would be useless
}

TEST_F(RandomBounds, thatLackAPartAreFoundOut) // of few solid particles one can see where they end
{
    const uint64_t trials = number("FX_BOUNDS_TRIALS", 200), first = number("FX_BOUNDS_FIRST", 0);
    Totals totals;
    int withoutSpeed = 0;
    for (uint64_t seed = first; seed < first + trials; ++seed) {
        const TrialResult trial = tryOne(seed, true);
        totals.add(trial);
        expectInside(trial, seed);
        withoutSpeed += beyondReachOf(withMember(trial.preset.text, "speed", 0)) > 0.0;
    }
    print("size of bounds over what is drawn", totals.tight);
    print(totals);
    std::printf("beyond a reach without speed %d\n", withoutSpeed);
    if (trials < 100)
        return;
    for (const Without what : {Without::Tenth, Without::Births})
        EXPECT_GE(totals.outside[size_t(what)], 2) << nameOf(what);
    for (const Without what : {Without::Size, Without::Stretch, Without::Shutter, Without::OlderPlace})
        EXPECT_GE(totals.outside[size_t(what)], 5) << nameOf(what);
    EXPECT_GE(withoutSpeed, 5);
}
