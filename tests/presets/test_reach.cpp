// How far an effect gets is told before it is played: for random presets with events, trails and meshes.
#include "foundation/memory/host_memory.h"
#include "foundation/random/philox.h"
#include "foundation/snapshot/blob_kind.h"
#include "foundation/snapshot/particle_kind.h"
#include "fxsdk/presets/preset_loader.h"
#include "simulation/world/world.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>

using namespace fx;
using Json = nlohmann::json;

namespace {

class Dice
{
public:
    explicit Dice(uint64_t trial) : trial_(trial) {}
    double unit() { return double(base::randomUnit4(trial_, 0, next_++, base::RandomPurpose::Position)[0]); }
    double between(double a, double b) { return a + (b - a) * unit(); }
    bool one(double share) { return unit() < share; }
    Json vector(double size) { return {between(-size, size), between(-size, size), between(-size, size)}; }
    Json range(double a, double b)
    {
        const double low = between(a, b);
        return {{"min", low}, {"max", between(low, b)}};
    }

private:
    uint64_t trial_;
    uint64_t next_ = 0;
};

Json appearanceOf(Dice& dice)
{
    if (dice.one(0.25))
        return {{"kind", "mesh"}, {"mesh", "library:debris-chunk.obj"}, {"spinDegrees", 100}};
    if (dice.one(0.25))
        return {{"kind", "none"}};
    Json look{{"kind", "sprite"}, {"aspect", dice.between(0.2, 3)}};
    if (dice.one(0.5)) {
        look["alignment"] = "velocity";
        look["stretch"] = dice.between(0, 0.2);
    }
    return look;
}

Json forcesOf(Dice& dice)
{
    Json forces{{"gravity", dice.between(-0.5, 1.5)}};
    if (dice.one(0.6))
        forces["drag"] = dice.between(0.1, 4);
    if (dice.one(0.4))
        forces["wind"] = dice.vector(3);
    if (dice.one(0.3))
        forces["quadraticDrag"] = dice.between(0.01, 1);
    if (dice.one(0.3))
        forces["gust"] = {1, 0.5, 1};
    if (dice.one(0.2)) {
        forces["curlStrength"] = dice.between(0.1, 2);
        forces["curlOctaves"] = 2;
    }
    if (dice.one(0.3))
        forces["vortices"] = {{{"radius", dice.between(0.2, 2)},
                               {"speed", dice.between(-5, 5)},
                               {"lift", dice.between(0, 3)},
                               {"hold", dice.unit()}}};
    if (dice.one(0.3))
        forces["attractors"] = {{{"position", dice.vector(2)},
                                 {"strength", dice.between(-8, 8)},
                                 {"radius", 1},
                                 {"softening", 0.5},
                                 {"falloff", dice.one(0.5) ? "constant" : "inverse-square"}}};
    return forces;
}

Json emitterOf(Dice& dice, int number)
{
    Json e{{"name", "e" + std::to_string(number)},
           {"maxParticles", 60},
           {"lifetime", dice.range(0.2, 1.2)},
           {"speed", dice.range(-2, 8)},
           {"radius", dice.range(0.02, 0.4)},
           {"position", dice.vector(1)},
           {"sizeOverLife", {{"keys", {{0, dice.between(0, 2)}, {1, dice.between(0, 2)}}}}},
           {"forces", forcesOf(dice)},
           {"appearance", appearanceOf(dice)}};
    const std::array<const char*, 4> shapes{"point", "sphere", "disc", "box"};
    e["shape"] = shapes[size_t(dice.unit() * 3.999)];
    e["size"] = dice.between(0.1, 1);
    e["axis"] = {0.3, 1, dice.between(-1, 1)};
    if (dice.one(0.5))
        e["trail"] = {{"lifetime", dice.between(0.1, 0.6)}, {"width", dice.between(0.02, 0.5)}};
    if (dice.one(0.3))
        e["collisions"] = {{{"shape", "ground"}, {"bounce", dice.unit()}}};
    return e;
}

/// A chain of one to three emitters.
Json presetOf(Dice& dice)
{
    const int count = 1 + int(dice.unit() * 2.999);
    Json emitters = Json::array();
    const std::array<const char*, 3> kinds{"birth", "death", "age"};
    for (int i = 0; i < count; ++i) {
        emitters.push_back(emitterOf(dice, i));
        if (i == 0)
            emitters[0]["emission"] = {{"rate", 25}};
        if (i + 1 == count)
            continue;
        Json rule{{"on", kinds[size_t(dice.unit() * 2.999)]},
                  {"emit", "e" + std::to_string(i + 1)},
                  {"count", 2},
                  {"inheritVelocity", dice.unit()}};
        if (rule["on"] == "age") {
            rule["age"] = 0.05;
            rule["every"] = 0.1;
        }
        emitters[size_t(i)]["events"] = Json::array({rule});
    }
    return {{"version", 1}, {"ground", dice.one(0.5)}, {"emitters", emitters}};
}

} // namespace

TEST(Reach, everythingThatIsDrawnOfRandomPresetsLiesWithin)
{
    base::SnapshotSchema schema;
    for (const base::KindDesc* kind :
         {&base::kBlobKind, &base::kParticleKind, &base::kRibbonKind, &base::kLightKind})
        schema.add(*kind);
    base::HostMemory memory;
    const auto tasks = base::makeSerialRunner();
    size_t bounded = 0, seen = 0;
    double fullest = 0;
    for (uint64_t trial = 1; trial <= 1000; ++trial) {
        Dice dice(trial);
        const Json preset = presetOf(dice);
        const auto loaded = preset::loadPresetText(preset.dump(), "random");
        ASSERT_TRUE(loaded.ok()) << loaded.status().message() << preset.dump();
        const auto& effect = loaded->effect;
        const double reach = double(effect->reach(9.80665f, glm::length(effect->wind)));
        bounded += std::isfinite(reach) ? 1 : 0;
        sim::World world(&schema, tasks.get(), &memory);
        sim::InstanceStart start;
        start.seed = trial;
        const std::array slots{world.add(effect, start)};
        const int steps = 10 + int(dice.unit() * 60);
        constexpr base::Ticks kStep = base::kTicksPerSecond / 30;
        for (int i = 0; i < steps; ++i)
            world.step(slots, i * kStep, kStep);
        base::FrameSnapshot snapshot(&schema, &memory);
        snapshot.begin(steps * kStep, 1);
        world.publish(slots, snapshot);
        for (size_t g = 0; g < snapshot.groupCount(); ++g) {
            const base::GroupInfo& info = snapshot.group(g).info();
            if (info.count == 0 || info.kind == schema.find(base::kLightKind.name))
                continue;
            namespace column = base::particle_column; // place and size are the first columns of all kinds
            const bool isRibbon = info.kind == schema.find(base::kRibbonKind.name);
            const base::SnapshotGroup& group = snapshot.group(g);
            const auto radius =
                group.column(isRibbon ? size_t(base::ribbon_column::HalfWidth) : size_t(column::Radius));
            for (uint32_t i = 0; i < info.count; ++i) {
                if (!(radius[i] > 0.0f))
                    continue;
                const glm::dvec3 place(group.column(0)[i], group.column(1)[i], group.column(2)[i]);
                const double far = glm::length(place) + double(radius[i]);
                ++seen;
                fullest = std::max(fullest, far / reach);
                ASSERT_LE(far, reach) << "trial " << trial << preset.dump(1);
            }
        }
    }
    EXPECT_EQ(bounded, 1000u);
    EXPECT_GT(seen, 20'000u);
    EXPECT_GT(fullest, 0.5) << "a bound that nobody comes near to is of little use";
}
