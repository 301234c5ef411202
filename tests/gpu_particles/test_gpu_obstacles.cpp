// What the GPU does not compute.
#include "gpu_fixture.h"

#include "simulation/emitters/emitter_def.h"
#include "simulation/gpu_programs/gpu_program.h"

namespace fx::test {

namespace {

constexpr const char* kSprite = R"("appearance": {"kind": "sprite"})";

std::string effectText(const std::string& members, const char* compute, const char* more = "")
{
    return std::string(R"({"version": 1, "emitters": [{"name": "a", "compute": ")") + compute +
           R"(", "emission": {"rate": 100}, )" + members + "}" + more + "]}";
}

} // namespace

class GpuObstacles : public GpuParticleTest
{
protected:
    std::string_view obstacle(const std::string& text)
    {
        return sim::gpuObstacle(dynamic_cast<const sim::EmitterDef&>(*load(text)->solvers.at(0)));
    }
    /// It is published as rows, and nothing complains.
    void expectRows(const std::string& text)
    {
        OneEffect effect(schema_, load(text), true);
        effect.playTo(0.3);
        EXPECT_FALSE(base::hasGpuParticles(effect.publish())) << text;
    }
};

TEST_F(GpuObstacles, areNoneForBallisticSprites)
{
    EXPECT_EQ(obstacle(effectText(kSprite, "gpu")), "");
    EXPECT_EQ(obstacle(effectText(std::string(R"("maxParticles": 20000, )") + kSprite, "auto")), "");
    OneEffect effect(schema_, load(effectText(kSprite, "gpu")), true);
    effect.playTo(0.3);
    EXPECT_TRUE(base::hasGpuParticles(effect.publish()));
    OneEffect unwanted(schema_, load(effectText(kSprite, "gpu")), false);
    unwanted.playTo(0.3);
    EXPECT_FALSE(base::hasGpuParticles(unwanted.publish()));
}

TEST_F(GpuObstacles, areNamedAndLeaveTheEmitterToTheCpu)
{
    const std::string sprite = kSprite;
    const std::pair<std::string, const char*> cases[] = {
        {effectText(sprite, "cpu"), "does not ask"},
        {effectText(sprite, "auto"), "too few"},
        {effectText(R"("appearance": {"kind": "medium"})", "gpu"), "media"},
        {effectText(R"("appearance": {"kind": "none"})", "gpu"), "not drawn"},
        {effectText(sprite + R"(, "trail": {"lifetime": 0.5})", "gpu"), "trails"},
        {effectText(sprite + R"(, "light": {})", "gpu"), "lights"},
        {effectText(sprite + R"(, "shape": "mesh", "file": "library:debris-chunk.obj")", "gpu"), "shape"},
        {effectText(sprite + R"(, "collisions": [{"shape": "mesh", "file": "library:debris-chunk.obj"}])",
                    "gpu"),
         "meets a mesh"},
        {effectText(sprite + R"(, "forces": {"attractors": [{"strength": 1, "falloff": "spring"}]})", "gpu"),
         "how far"},
        {effectText(sprite + R"(, "lifetime": 60, "forces": {"curlStrength": 1})", "gpu"), "too many steps"},
        {effectText(sprite + R"(, "events": [{"on": "death", "emit": "b"}])", "gpu",
                    R"(, {"name": "b", "appearance": {"kind": "sprite"}})"),
         "events"},
    };
    for (const auto& [text, word] : cases) {
        EXPECT_NE(obstacle(text).find(word), std::string_view::npos) << obstacle(text) << "\n" << text;
        expectRows(text);
    }
    std::string curve = effectText(sprite, "gpu");
    curve.replace(curve.find(R"({"rate": 100})"), 13,
                  R"({"rate": 100, "duration": 2, "rateOverTime": {"keys": [[0, 0], [1, 1]]}})");
    EXPECT_NE(obstacle(curve).find("rate of births"), std::string_view::npos);
    expectRows(curve);
}

/// Of the drawn emitters of the library, all but those that others depend on, and those of worlds and curves.
TEST_F(GpuObstacles, keepOnlyWhatOthersDependOnFromTheGpu)
{
    size_t computed = 0, linked = 0;
    for (const std::string& name : libraryNames()) {
        const auto effect = load(libraryText(name, "gpu"));
        for (const auto& solver : effect->solvers) {
            const auto* emitter = dynamic_cast<const sim::EmitterDef*>(solver.get());
            if (!emitter || emitter->appearance.kind == sim::AppearanceKind::Medium)
                continue;
            const bool isLinked = emitter->fed || !emitter->events.empty() || emitter->light.given ||
                                  emitter->trail.lifetime > 0.0f;
            const std::string_view obstacle = sim::gpuObstacle(*emitter);
            const bool isElsewhere = emitter->inWorld || obstacle.find("spline") != std::string_view::npos;
            EXPECT_EQ(obstacle.empty(), !isLinked && !isElsewhere)
                << name << " " << emitter->name << ": " << obstacle;
            computed += obstacle.empty() ? 1 : 0;
            linked += isLinked ? 1 : 0;
        }
    }
    EXPECT_GT(computed, 10u); // the library has both sorts
    EXPECT_GT(linked, 10u);
}

TEST_F(GpuObstacles, cosmeticEmittersAreOutsideOfTheHashOfWhatIsSeen)
{
    const auto hashOf = [this](const char* compute, bool onGpu, double seconds) {
        OneEffect effect(schema_, load(effectText(kSprite, compute)), onGpu);
        effect.playTo(seconds);
        return effect.publish().hash();
    };
    EXPECT_EQ(hashOf("gpu", true, 0.5), hashOf("gpu", false, 0.5));
    EXPECT_NE(hashOf("gpu", false, 0.5), hashOf("cpu", false, 0.5));
    EXPECT_NE(hashOf("cpu", false, 0.5), hashOf("cpu", false, 0.6));
}

} // namespace fx::test
