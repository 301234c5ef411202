#include "simulation/ribbons/ribbon_store.h"
#include "tests/simulation/particles/events/linked.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <optional>

using namespace fx;
using namespace fx::sim;
using namespace fx::test;
using base::kTicksPerSecond;

namespace {

struct Strip
{
    std::vector<glm::vec3> points;
    std::vector<float> arcs;
    std::vector<float> halfWidths;
};

/// A stage whose snapshots know ribbons and lights.
class Pictures
{
public:
    explicit Pictures(std::unique_ptr<EmitterDef> def,
                      std::unique_ptr<base::TaskRunner> tasks = base::makeSerialRunner())
        : tasks_(std::move(tasks)), world_(&schema_, tasks_.get(), &memory_), snapshot_(&schema_, &memory_)
    {
        slot_ = world_.add(linkedEffect(std::move(def)), {});
    }
    void step(base::Ticks ticks = kStep)
    {
        world_.step(std::array{slot_}, now_, ticks);
        now_ += ticks;
    }
    const base::FrameSnapshot& look()
    {
        snapshot_.begin(now_, 1, before_.value_or(0));
        world_.publish(std::array{slot_}, snapshot_);
        return snapshot_;
    }
    /// From now on each picture has one before it, so many ticks earlier.
    void setBefore(base::Ticks ticks) { before_ = ticks; }
    const base::SnapshotGroup& groupOf(const base::KindDesc& kind)
    {
        look();
        for (size_t g = 0; g < snapshot_.groupCount(); ++g)
            if (snapshot_.group(g).info().kind == schema_.find(kind.name))
                return snapshot_.group(g);
        throw std::runtime_error("no such group");
    }
    std::map<uint64_t, Strip> strips()
    {
        namespace column = base::ribbon_column;
        const base::SnapshotGroup& group = groupOf(base::kRibbonKind);
        std::map<uint64_t, Strip> found;
        for (uint32_t i = 0; i < group.info().count; ++i) {
            Strip& strip = found[group.column64(column::Strip)[i]];
            strip.points.push_back({group.column(column::PositionX)[i], group.column(column::PositionY)[i],
                                    group.column(column::PositionZ)[i]});
            strip.arcs.push_back(group.column(column::Arc)[i]);
            strip.halfWidths.push_back(group.column(column::HalfWidth)[i]);
        }
        return found;
    }
    base::Ticks now() const { return now_; }
    uint64_t allocations() const { return memory_.allocationCount(); }

private:
    static base::SnapshotSchema kinds()
    {
        base::SnapshotSchema schema;
        for (const base::KindDesc* kind :
             {&base::kBlobKind, &base::kParticleKind, &base::kRibbonKind, &base::kLightKind})
            static_cast<void>(schema.add(*kind));
        return schema;
    }
    base::SnapshotSchema schema_ = kinds();
    base::HostMemory memory_;
    std::unique_ptr<base::TaskRunner> tasks_;
    World world_;
    base::FrameSnapshot snapshot_;
    Slot slot_ = 0;
    base::Ticks now_ = 0;
    std::optional<base::Ticks> before_;
};

/// One particle that moves along +Y with 3 m/s and leaves a trail of half a second.
std::unique_ptr<EmitterDef> comet()
{
    auto def = burstEmitter(1);
    def->appearance.kind = AppearanceKind::Sprite;
    def->shape = EmitterShape::Box; // heads along +Y
    def->forces.gravity = 0;
    def->speed = {3, 3};
    def->trail.lifetime = 0.5f;
    def->trail.maxPoints = 12;
    return def;
}

} // namespace

TEST(Trails, areAsLongAsTheWayOfTheirLifetime)
{
    for (const bool integrated : {false, true}) {
        auto def = comet();
        if (integrated)
            def->modules = {std::make_shared<Idle>()};
        Pictures pictures(std::move(def));
        for (int i = 0; i < 60; ++i)
            pictures.step();
        const Strip strip = pictures.strips().at(0);
        EXPECT_NEAR(strip.points.front().y, 3.0f, 1e-4f);
        EXPECT_NEAR(strip.points.back().y, 1.5f, 1e-4f); // clipped at exactly the lifetime
        EXPECT_NEAR(strip.arcs.front(), 3.0f, 1e-4f);    // counted from the birth
        EXPECT_NEAR(strip.arcs.back(), 1.5f, 1e-4f);
        for (size_t i = 1; i < strip.points.size(); ++i)
            EXPECT_LE(strip.points[i].y, strip.points[i - 1].y); // newest first
    }
}

/// Pictures between its birth and the first snapshot carry the head back along its velocity: to the end of
/// the trail.
TEST(Trails, haveTheVelocityOfTheirHead)
{
    namespace column = base::particle_column;
    Pictures pictures(comet());
    pictures.step();
    const float end = pictures.strips().at(0).points.back().y;
    const base::SnapshotGroup& heads = pictures.groupOf(base::kParticleKind);
    ASSERT_TRUE(heads.has(column::VelocityY));
    const float way = heads.column(column::VelocityY)[0] * heads.column(column::Age)[0];
    EXPECT_GT(way, 0.01f);
    EXPECT_NEAR(heads.column(column::PositionY)[0] - way, end, 1e-4f);
}

TEST(Trails, keepTheArcLengthOfEachPlace)
{
    auto def = comet();
    def->forces.gravity = 1;
    Pictures pictures(std::move(def));
    std::map<float, float> arcOf; // by height, on the way up
    for (int i = 0; i < 15; ++i) {
        pictures.step();
        const Strip strip = pictures.strips().at(0);
        for (size_t k = 1; k + 1 < strip.points.size(); ++k) { // neither head nor tail
            const auto [known, isNew] = arcOf.try_emplace(strip.points[k].y, strip.arcs[k]);
            EXPECT_EQ(known->second, strip.arcs[k]);
        }
    }
    EXPECT_GT(arcOf.size(), 3u);
}

TEST(Trails, doNotDependOnHowTimeIsCutWhereMotionHasAClosedForm)
{
    const auto playedBy = [](base::Ticks part) {
        auto def = spriteEmitter(30.0f, {0.3f, 0.6f});
        def->trail = comet()->trail;
        def->trail.minDistance = 0.1f;
        Pictures pictures(std::move(def));
        while (pictures.now() < kTicksPerSecond)
            pictures.step(std::min(part, kTicksPerSecond - pictures.now()));
        return pictures.look().hash();
    };
    const uint64_t want = playedBy(kTicksPerSecond / 60);
    EXPECT_EQ(playedBy(kTicksPerSecond / 30), want);
    EXPECT_EQ(playedBy(kTicksPerSecond / 144 + 1), want);
}

TEST(Trails, outliveTheirParticleAndThenEnd)
{
    auto def = comet();
    def->lifetime = {0.25f, 0.25f};
    Pictures pictures(std::move(def));
    for (int i = 0; i < 30; ++i) // 0.5 s: a quarter after the death
        pictures.step();
    const Strip strip = pictures.strips().at(0);
    EXPECT_NEAR(strip.points.front().y, 0.75f, 1e-4f);
    EXPECT_NEAR(strip.points.back().y, 0.0f, 1e-4f);
    for (int i = 0; i < 16; ++i)
        pictures.step();
    EXPECT_TRUE(pictures.strips().empty());
}

TEST(Trails, areAsWideAsTheCurveSays)
{
    auto def = comet();
    def->trail.width = 0.4f;
    const std::array<base::CurveKey<1>, 2> keys{{{0.0f, {1.0f}}, {1.0f, {0.0f}}}};
    def->trail.widthAlong = base::ScalarCurve(std::span<const base::CurveKey<1>>(keys));
    Pictures pictures(std::move(def));
    for (int i = 0; i < 60; ++i)
        pictures.step();
    const Strip strip = pictures.strips().at(0);
    for (size_t i = 0; i < strip.points.size(); ++i)
        EXPECT_NEAR(strip.halfWidths[i], 0.2f * (strip.points[i].y - 1.5f) / 1.5f, 1e-4f);
}

TEST(Trails, allocateNothingOnceTheyAreWarm)
{
    auto def = spriteEmitter(100.0f, {0.3f, 0.6f});
    def->trail = comet()->trail;
    Pictures pictures(std::move(def));
    const auto play = [&pictures] {
        for (int i = 0; i < 60; ++i) {
            pictures.step();
            pictures.look();
        }
    };
    play();
    const uint64_t before = pictures.allocations();
    play();
    EXPECT_EQ(pictures.allocations(), before);
}

TEST(Lights, aSpriteShinesWithItsLuminanceTimesItsArea)
{
    auto def = comet();
    def->radius = {0.1f, 0.1f};
    def->appearance.luminance = 1000.0f;
    def->appearance.colorOverLife = base::ColorCurve(std::array{1.0f, 0.5f, 0.25f});
    def->light.given = true;
    Pictures pictures(std::move(def));
    for (int i = 0; i < 60; ++i)
        pictures.step();
    const base::SnapshotGroup& group = pictures.groupOf(base::kLightKind);
    ASSERT_EQ(group.info().count, 1u);
    const double want = 1000.0 * 3.14159265 * 0.01;
    EXPECT_NEAR(group.column(base::light_column::IntensityR)[0], want, 1e-3);
    EXPECT_NEAR(group.column(base::light_column::IntensityB)[0], 0.25 * want, 1e-3);
    EXPECT_NEAR(group.column(base::light_column::PositionY)[0], 3.0, 1e-4);
}

TEST(Lights, theBrightestAreKeptAndMergingKeepsTheSum)
{
    const auto lights = [](uint32_t most, bool merged) {
        auto def = spriteEmitter(50.0f, {1.0f, 1.0f});
        def->opacityOverLife = base::ScalarCurve(std::array{1.0f});
        def->appearance.brightness = {0.1f, 10.0f};
        def->light.given = true;
        def->light.intensity = 2.0f;
        def->light.maxLights = most;
        def->light.merged = merged;
        Pictures pictures(std::move(def));
        for (int i = 0; i < 60; ++i)
            pictures.step();
        const base::SnapshotGroup& group = pictures.groupOf(base::kLightKind);
        const auto column = group.column(base::light_column::IntensityG);
        return std::vector<float>(column.begin(), column.begin() + group.info().count);
    };
    std::vector<float> all = lights(1000, false);
    ASSERT_GT(all.size(), 40u);
    double sum = 0;
    for (const float light : all)
        sum += double(light);
    std::vector<float> brightest = lights(5, false);
    ASSERT_EQ(brightest.size(), 5u);
    std::sort(all.rbegin(), all.rend());
    std::sort(brightest.rbegin(), brightest.rend());
    EXPECT_TRUE(std::equal(brightest.begin(), brightest.end(), all.begin()));
    const std::vector<float> merged = lights(5, true);
    ASSERT_EQ(merged.size(), 1u);
    EXPECT_NEAR(merged[0], sum, 1e-3 * sum);
}

namespace {

/// Rows of a ribbon group: arc, age and opacity.
struct RibbonRow
{
    float arc, age, opacity;
};

std::vector<RibbonRow> rowsOf(const base::SnapshotGroup& group)
{
    namespace column = base::ribbon_column;
    std::vector<RibbonRow> rows;
    for (uint32_t i = 0; i < group.info().count; ++i) {
        const uint32_t half = uint32_t(group.column64(column::Color)[i] >> 48);
        const float opacity =
            half == 0 ? 0.0f : std::ldexp(1.0f + float(half & 0x3FFu) / 1024.0f, int(half >> 10 & 31u) - 15);
        rows.push_back({group.column(column::Arc)[i], group.column(column::Age)[i], opacity});
    }
    return rows;
}

} // namespace

TEST(Trails, knowHowLongAgoTheirParticleWasThere)
{
    Pictures pictures(comet());
    for (int i = 0; i < 60; ++i)
        pictures.step();
    const auto rows = rowsOf(pictures.groupOf(base::kRibbonKind));
    ASSERT_GT(rows.size(), 3u);
    EXPECT_EQ(rows.front().age, 0.0f);
    EXPECT_NEAR(rows.back().age, 0.5f, 1e-6f);
    for (const RibbonRow& row : rows)
        EXPECT_NEAR(3.0f - row.arc, 3.0f * row.age, 1e-4f); // 3 m/s
}

TEST(Trails, goOnSoFarThatTheirTailIsKnownSinceTheSnapshotBefore)
{
    for (const bool isStretched : {false, true}) {
        auto def = comet();
        def->trail.softEnds = 0.5f;
        def->trail.arcPerTile = isStretched ? 0.0f : 1.0f;
        def->lifetime = {0.8f, 0.8f};
        Pictures pictures(std::move(def));
        for (int i = 0; i < 60; ++i) {
            pictures.step();
            if (i < 40 || i == 47) // at which it dies
                continue;
            pictures.setBefore(0);
            const auto without = rowsOf(pictures.groupOf(base::kRibbonKind));
            pictures.setBefore(kStep);
            const auto& group = pictures.groupOf(base::kRibbonKind);
            EXPECT_EQ(group.constants()[base::particle_constant::TailAge], 0.5f);
            const auto rows = rowsOf(group);
            ASSERT_GT(rows.size(), 1u);
            EXPECT_NEAR(without.back().age, 0.5f, 1e-6f) << i;
            EXPECT_NEAR(rows.back().age, 0.5f + 1.0f / 60.0f, 1e-6f) << i;
            EXPECT_EQ(rows.back().opacity, 0.0f); // the end that fades is that of now
            for (size_t k = 0; k + 1 < without.size(); ++k) {
                EXPECT_NEAR(rows[k].arc, without[k].arc, 1e-5f) << i; // so is the one that textures reach
                EXPECT_NEAR(rows[k].opacity, without[k].opacity, 2e-3f) << i;
            }
        }
    }
}

TEST(Trails, softEndsFadeOverTheirLength)
{
    auto def = comet();
    def->trail.softEnds = 0.5f;
    Pictures pictures(std::move(def));
    for (int i = 0; i < 60; ++i)
        pictures.step();
    for (const RibbonRow& row : rowsOf(pictures.groupOf(base::kRibbonKind))) {
        const float inside = std::min(3.0f - row.arc, row.arc - 1.5f);
        EXPECT_NEAR(row.opacity, std::min(inside / 0.5f, 1.0f), 2e-3f) << row.arc;
    }
}

TEST(Trails, aStretchedTextureRunsFromTheEndToTheHead)
{
    auto def = comet();
    def->trail.arcPerTile = 0.0f;
    Pictures pictures(std::move(def));
    for (int i = 0; i < 60; ++i)
        pictures.step();
    const auto rows = rowsOf(pictures.groupOf(base::kRibbonKind));
    EXPECT_EQ(rows.front().arc, 1.0f);
    EXPECT_EQ(rows.back().arc, 0.0f);
    for (const RibbonRow& row : rows)
        EXPECT_NEAR(row.arc, 1.0f - row.age / 0.5f, 1e-4f);
}

/// The trail of one particle that was born at tick 1000 and has come to its head a quarter of a second later,
/// as bytes in which the next point has the number `next`.
TEST(Trails, aNumberOfTheNextPointThatIsNotThatOfItsTickIsRefused)
{
    using base::Ticks;
    const std::unique_ptr<EmitterDef> def = comet();
    std::pmr::memory_resource* const memory = std::pmr::new_delete_resource();
    const std::shared_ptr<const ParticleProgram> program = def->program.of(*def);
    ParticleStore particles(*program, memory);
    particles.advance(1);
    particles.index[0] = 0;
    particles.born[0] = 1000;
    const Ticks head = 1000 + kTicksPerSecond / 4;
    const Ticks interval = kTicksPerSecond / 2 / (def->trail.maxPoints - 2) + 1;
    const uint64_t right = uint64_t((head - 1000) / interval) + 1;
    const auto isTaken = [&](uint64_t next) {
        StateBuffer bytes(memory);
        bytes.value(uint32_t(1)); // trails
        bytes.value(uint32_t(0)); // row
        bytes.value(uint64_t(0)); // index
        bytes.value(uint32_t(1)); // points
        bytes.value(next);
        bytes.flag(false);
        bytes.vector(glm::vec3(1.0f));
        for (const Ticks tick : {head, Ticks(1000)}) {
            bytes.vector(glm::vec3(0.0f));
            bytes.value(0.0f);
            bytes.value(tick);
        }
        RibbonStore trails(def->trail, def->maxParticles, memory);
        StateReader reader(bytes.bytes());
        trails.restore(reader, particles, head);
        return reader.ok() && reader.left() == 0;
    };
    EXPECT_TRUE(isTaken(right));
    for (const uint64_t next : {uint64_t(0), right - 1, right + 1, uint64_t(1) << 40, UINT64_MAX})
        EXPECT_FALSE(isTaken(next)) << next;
}
