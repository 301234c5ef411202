#include "fxsdk/assets/asset_resolver.h"
#include "fxsdk/presets/preset_loader.h"
#include "simulation/cloud/cloud_solver.h"
#include "simulation/cloud/moving_cloud.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

using namespace fx;

namespace {

sim::BallList twoBalls()
{
    sim::BallList list(2);
    list[0] = {{1, 2, 3}, 0.5f, 2.0f, 900.0f, {0.1f, 0.2f, 0.3f}, {4, 5, 6}};
    list[1] = {{-4, 0, 0}, 2.0f, 1.0f, 293.0f, {0.8f, 0.8f, 0.8f}, {0, 0, 0}};
    return list;
}

constexpr glm::vec3 kPlace{1, 2, 3}, kSpeed{4, -5, 6}, kAcceleration{-7, 8, 9.5f};

/// A ball with an even acceleration, at a time [s].
sim::MovingBall thrown(float time, uint64_t number)
{
    sim::MovingBall ball;
    ball.ball = twoBalls()[0];
    ball.ball.center = kPlace + time * kSpeed + 0.5f * time * time * kAcceleration;
    ball.velocity = kSpeed + time * kAcceleration;
    ball.streak = 0.1f * ball.velocity;
    ball.number = number;
    return ball;
}

/// Frames 0 and 1, 0.1 s apart. Ball 5 is in both, ball 2 in the first, ball 9 in the second.
sim::MovingCloudDef thrownBalls()
{
    sim::MovingCloudDef def;
    def.framesPerSecond = 10.0f;
    def.setFrames(
        {std::make_shared<const sim::MovingBalls>(sim::MovingBalls{thrown(0.0f, 2), thrown(0.0f, 5)}),
         std::make_shared<const sim::MovingBalls>(sim::MovingBalls{thrown(0.1f, 5), thrown(0.1f, 9)})});
    return def;
}

} // namespace

TEST(BallList, isReadAsItWasWritten)
{
    const std::string bytes = sim::writeBallList(twoBalls());
    const auto read = sim::parseBallList(bytes);
    ASSERT_TRUE(read.ok()) << read.status().message();
    EXPECT_EQ(sim::writeBallList(**read), bytes);
    EXPECT_EQ((**read)[0].emission, glm::vec3(4, 5, 6));
}

TEST(BallList, damagedFilesAreRefused)
{
    const std::string bytes = sim::writeBallList(twoBalls());
    for (size_t size = 0; size < bytes.size(); ++size)
        EXPECT_FALSE(sim::parseBallList(std::string_view(bytes).substr(0, size)).ok()) << size;
    EXPECT_FALSE(sim::parseBallList(bytes + "x").ok());
    EXPECT_FALSE(sim::parseBallList("fxballs 1\ncount 4000000000\ndata\n").ok());
    EXPECT_EQ(sim::parseBallList("fxballs 2\ncount 1\ndata\n").status().code(), base::Code::Version);
    for (size_t number = 0; number < 12; ++number) {
        std::string damaged = bytes;
        const size_t at = bytes.size() - 48 + 4 * number;
        damaged.replace(at, 4, "\xff\xff\xff\xff"); // no number
        const auto read = sim::parseBallList(damaged);
        EXPECT_FALSE(read.ok()) << number;
        EXPECT_NE(read.status().message().find("ball 1"), std::string::npos);
    }
}

TEST(Cloud, publishesTheBallsOfItsFilePlacedAndScaled)
{
    base::SnapshotSchema schema;
    schema.add(base::kBlobKind);
    sim::CloudDef def;
    def.balls = std::make_shared<sim::BallList>(twoBalls());
    def.position = {10, 20, 30};
    def.scale = 2.0f;
    def.density = 3.0f;
    const auto cloud = def.create(schema, {}, std::pmr::get_default_resource());
    base::FrameSnapshot snapshot(&schema, std::pmr::get_default_resource());
    cloud->publish({}, snapshot);
    const base::SnapshotGroup& group = snapshot.group(0);
    ASSERT_EQ(group.count(), 2u);
    namespace blob = base::blob_column;
    EXPECT_EQ(group.column(blob::PositionX)[0], 12.0f);
    EXPECT_EQ(group.column(blob::PositionY)[0], 24.0f);
    EXPECT_EQ(group.column(blob::Radius)[0], 1.0f);
    EXPECT_EQ(group.column(blob::CrossSection)[0], 3.0f * 4.0f * 2.0f); // optical depth is a / R^2
    EXPECT_EQ(group.column(blob::Temperature)[0], 900.0f);
    EXPECT_EQ(group.column(blob::AlbedoG)[0], 0.2f);
    EXPECT_EQ(group.column(blob::EmissionB)[0], 6.0f);
    EXPECT_FALSE(cloud->finished(base::toTicks(1e6)));
    const float reach = def.reach(9.8f, 1.0f, 5.0f);
    EXPECT_GE(reach, glm::length(glm::vec3(12, 24, 36)) + 1.0f);
    EXPECT_LE(reach, 1.01f * (glm::length(glm::vec3(12, 24, 36)) + 1.0f));
}

TEST(Clouds, presetsWithoutAFileOrWithAnotherOneAreErrors)
{
    const auto missing = preset::loadPresetText(R"({"version": 1, "clouds": [{}]})", "t");
    ASSERT_FALSE(missing.ok());
    EXPECT_NE(missing.status().message().find("fxballs"), std::string::npos) << missing.status().message();
}

TEST(MovingBalls, areReadAsTheyWereWritten)
{
    sim::MovingBalls balls{thrown(0.3f, 3), thrown(0.4f, uint64_t(1) << 63)};
    balls[1].age = 0.25f;
    balls[1].rate = -7.5f;
    const std::string bytes = sim::writeMovingBalls(balls);
    const auto read = sim::parseMovingBalls(bytes);
    ASSERT_TRUE(read.ok()) << read.status().message();
    EXPECT_EQ(sim::writeMovingBalls(**read), bytes);
    EXPECT_EQ((**read)[1].velocity, balls[1].velocity);
    EXPECT_EQ((**read)[1].streak, balls[1].streak);
    EXPECT_EQ((**read)[1].age, 0.25f);
    EXPECT_EQ((**read)[1].rate, -7.5f);
    EXPECT_EQ((**read)[1].number, balls[1].number);
    const auto none = sim::parseMovingBalls(sim::writeMovingBalls({}));
    ASSERT_TRUE(none.ok()) << none.status().message();
    EXPECT_TRUE((*none)->empty());
}

TEST(MovingBalls, damagedFilesAreRefused)
{
    const std::string bytes = sim::writeMovingBalls({thrown(0.3f, 3), thrown(0.4f, 4)});
    for (size_t size = 0; size < bytes.size(); ++size)
        EXPECT_FALSE(sim::parseMovingBalls(std::string_view(bytes).substr(0, size)).ok()) << size;
    EXPECT_EQ(sim::parseMovingBalls("fxballs 1\ncount 0\ndata\n").status().code(), base::Code::Version);
    EXPECT_FALSE(sim::parseMovingBalls(sim::writeMovingBalls({thrown(0.3f, 4), thrown(0.4f, 4)})).ok());
    for (size_t number = 0; number < 20; ++number) {
        std::string damaged = bytes;
        damaged.replace(bytes.size() - 88 + 4 * number, 4, "\xff\xff\xff\xff"); // no number
        const auto read = sim::parseMovingBalls(damaged);
        ASSERT_FALSE(read.ok()) << number;
        EXPECT_NE(read.status().message().find("ball 1"), std::string::npos);
    }
}

TEST(MovingCloud, aBallOfTwoFramesMovesWithItsVelocities)
{
    const sim::MovingCloudDef def = thrownBalls();
    EXPECT_EQ(def.capacity(), 3u);
    for (const float share : {0.0f, 0.25f, 0.5f, 0.9f}) {
        const sim::MovingBalls shown = def.at(double(share));
        const sim::MovingBall &own = shown[1], wanted = thrown(0.1f * share, 5);
        ASSERT_EQ(own.number, 5u);
        EXPECT_LT(glm::length(own.ball.center - wanted.ball.center), 1e-6f) << share; // an even acceleration
        EXPECT_LT(glm::length(own.streak - wanted.streak), 1e-6f) << share;
        EXPECT_NEAR(own.ball.crossSection, wanted.ball.crossSection, 1e-6f) << share;
        EXPECT_NEAR(own.ball.emission.x, 4.0f, 1e-5f) << share;
    }
}

TEST(MovingCloud, aBallOfOneFrameFadesAsItMoves)
{
    const sim::MovingBalls shown = thrownBalls().at(0.25);
    ASSERT_EQ(shown.size(), 3u);
    const sim::MovingBall first = thrown(0.0f, 2), second = thrown(0.1f, 9);
    EXPECT_NEAR(shown[0].ball.crossSection, 0.75f * first.ball.crossSection, 1e-6f);
    EXPECT_NEAR(shown[2].ball.crossSection, 0.25f * second.ball.crossSection, 1e-6f);
    EXPECT_LT(glm::length(shown[0].ball.center - first.ball.center - 0.025f * first.velocity), 1e-6f);
    EXPECT_LT(glm::length(shown[2].ball.center - second.ball.center + 0.075f * second.velocity), 1e-6f);
}

/// Luminance of a ball that flares up and cools: the 16th root is a cubic polynomial of the time [s].
float flare(float time)
{
    return 900.0f * std::pow(1.0f + 0.5f * time - 6.0f * time * time + 10.0f * time * time * time, 16.0f);
}

/// [1/s] Of its logarithm.
float flareRate(float time)
{
    return 16.0f * (0.5f - 12.0f * time + 30.0f * time * time) / std::pow(flare(time) / 900.0f, 1.0f / 16.0f);
}

TEST(MovingCloud, lightBetweenFramesFollowsItsRates)
{
    sim::MovingBall first = thrown(0.0f, 5), second = thrown(0.1f, 5);
    first.ball.emission = glm::vec3(flare(0.0f));
    first.rate = flareRate(0.0f);
    second.ball.emission = glm::vec3(flare(0.1f));
    second.rate = flareRate(0.1f);
    sim::MovingCloudDef def;
    def.framesPerSecond = 10.0f;
    const auto play = [&] {
        def.setFrames({std::make_shared<const sim::MovingBalls>(sim::MovingBalls{first}),
                       std::make_shared<const sim::MovingBalls>(sim::MovingBalls{second})});
    };
    play();
    for (const float share : {0.0f, 0.2f, 0.5f, 0.8f})
        EXPECT_NEAR(def.at(double(share))[0].ball.emission.x, flare(0.1f * share), 1e-3f * flare(0.0f));
    // A rate as of a spark that is lit within one step says nothing about the way to the next frame.
    first.rate = 1800.0f;
    second.ball.emission = first.ball.emission;
    second.rate = 0.0f;
    play();
    for (const float share : {0.2f, 0.5f, 0.8f})
        EXPECT_LT(def.at(double(share))[0].ball.emission.x, 1.4f * flare(0.0f)) << share;
}

TEST(MovingCloud, aBallIsWholeFromItsBirthOn)
{
    constexpr base::Ticks kStep = base::kTicksPerSecond / 60;
    sim::MovingBall ball = thrown(0.1f, 9);
    ball.age = 0.06f; // born at 0.04 s, at frame 0.4
    ball.rate = -20.0f;
    ball.ball.emission = glm::vec3(500.0f);
    sim::MovingCloudDef def;
    def.framesPerSecond = 10.0f;
    def.setFrames({std::make_shared<const sim::MovingBalls>(sim::MovingBalls{thrown(0.0f, 2)}),
                   std::make_shared<const sim::MovingBalls>(sim::MovingBalls{ball})});
    EXPECT_EQ(def.at(0.35).size(), 1u);
    ball.age = 0.02f; // born behind halfway: there is room for it in advance
    sim::MovingCloudDef late;
    late.framesPerSecond = 10.0f;
    late.setFrames({std::make_shared<const sim::MovingBalls>(sim::MovingBalls{thrown(0.0f, 2)}),
                    std::make_shared<const sim::MovingBalls>(sim::MovingBalls{ball})});
    EXPECT_EQ(late.at(0.5).size(), 1u);
    EXPECT_EQ(late.at(0.9).size(), 2u);
    EXPECT_GE(late.countAt(0.5), 2u);
    EXPECT_GE(late.capacity(), 2u);
    ball.age = 0.06f;
    const sim::MovingBalls shown = def.at(0.45);
    ASSERT_EQ(shown.size(), 2u);
    EXPECT_EQ(shown[1].ball.crossSection, ball.ball.crossSection);
    EXPECT_NEAR(shown[1].ball.emission.x, 500.0f * std::pow(1.0f + 20.0f * 0.055f / 16.0f, 16.0f), 1e-1f);
    EXPECT_NEAR(shown[1].age, 0.005f, 1e-6f);
    // What the first frame shows is there, whatever the second says.
    sim::MovingBall older = ball;
    older.age = sim::kUnknownAge;
    sim::MovingCloudDef both;
    both.framesPerSecond = 10.0f;
    both.setFrames({std::make_shared<const sim::MovingBalls>(sim::MovingBalls{older}),
                    std::make_shared<const sim::MovingBalls>(sim::MovingBalls{ball})});
    EXPECT_EQ(both.at(0.2).size(), 1u);
    // Views show it within the step of its birth as soon as it is born.
    base::SnapshotSchema schema;
    schema.add(base::kBlobKind);
    const auto cloud = def.create(schema, {}, std::pmr::get_default_resource());
    for (const int step : {2, 3}) { // 0.033 s and 0.05 s
        cloud->seekable()->seek({}, step * kStep);
        base::FrameSnapshot snapshot(&schema, std::pmr::get_default_resource());
        base::GroupInfo info;
        info.step = kStep;
        cloud->publish(info, snapshot);
        const base::SnapshotGroup& group = snapshot.group(0);
        ASSERT_EQ(group.count(), step == 2 ? 1u : 2u);
        if (step == 3) {
            EXPECT_NEAR(group.column(base::blob_column::Age)[1], 0.01f, 1e-5f);
        }
    }
}

TEST(MovingCloud, publishesStreaksAndTheSameIdsInAllFrames)
{
    base::SnapshotSchema schema;
    schema.add(base::kBlobKind);
    sim::MovingCloudDef def = thrownBalls();
    def.position = {10, 20, 30};
    def.scale = 2.0f;
    const auto cloud = def.create(schema, {}, std::pmr::get_default_resource());
    namespace blob = base::blob_column;
    for (const double frame : {0.0, 0.5, 1.0}) {
        cloud->seekable()->seek({}, base::toTicks(frame / 10.0));
        base::FrameSnapshot snapshot(&schema, std::pmr::get_default_resource());
        cloud->publish({}, snapshot);
        const base::SnapshotGroup& group = snapshot.group(0);
        const size_t own = frame < 1.0 ? 1 : 0;
        ASSERT_EQ(group.count(), frame == 0.5 ? 3u : 2u);
        EXPECT_EQ(group.ids()[own], 1u); // the second of the numbers 2, 5, 9
        EXPECT_EQ(group.ids()[group.count() - 1], frame > 0.0 ? 2u : 1u);
        EXPECT_EQ(group.ids()[0], frame < 1.0 ? 0u : 1u);
        EXPECT_EQ(def.countAt(frame), group.count());
        const sim::MovingBall wanted = thrown(float(frame) / 10.0f, 5);
        const float shutter = group.constants()[base::blob_constant::Shutter];
        for (size_t a = 0; a < 3; ++a) {
            const auto k = glm::length_t(a);
            EXPECT_NEAR(group.column(blob::PositionX + a)[own],
                        def.position[k] + 2.0f * wanted.ball.center[k], 1e-5f);
            EXPECT_NEAR(shutter * group.column(blob::VelocityX + a)[own], 2.0f * wanted.streak[k], 1e-5f);
            EXPECT_LE(glm::length(wanted.ball.center), def.reach(9.8f, 0.0f, 1.0f));
        }
    }
    EXPECT_EQ(cloud->seekable()->restsUntil(0), 0);
    EXPECT_GT(cloud->seekable()->restsUntil(base::toTicks(2.0)), base::toTicks(1e6)); // the last frame stays
}

/// [m2] Cross sections of the balls that views show at a moment of a step, by id: those of the newer
/// snapshot, mixed with the same ones of the older.
std::map<uint64_t, float> shownSections(const base::FrameSnapshot& older, const base::FrameSnapshot& newer,
                                        float t)
{
    const auto sections = [](const base::SnapshotGroup& group) {
        std::map<uint64_t, float> found;
        for (uint32_t i = 0; i < group.count(); ++i)
            found[group.ids()[i]] = group.column(base::blob_column::CrossSection)[i];
        return found;
    };
    const auto before = sections(older.group(0));
    auto shown = sections(newer.group(0));
    for (auto& [id, section] : shown)
        if (const auto found = before.find(id); found != before.end())
            section = found->second + t * (section - found->second);
    return shown;
}

TEST(MovingCloud, aBallOfOneFrameFadesInStepsThatPassAFrame)
{
    constexpr base::Ticks kStep = base::kTicksPerSecond / 60;
    base::SnapshotSchema schema;
    schema.add(base::kBlobKind);
    sim::MovingCloudDef def;
    def.framesPerSecond = 24.0f;
    std::vector<std::shared_ptr<const sim::MovingBalls>> frames;
    for (uint64_t i = 0; i < 5; ++i) // each with a ball of its own
        frames.push_back(std::make_shared<const sim::MovingBalls>(sim::MovingBalls{thrown(0.0f, i)}));
    def.setFrames(frames);
    const auto cloud = def.create(schema, {}, std::pmr::get_default_resource());
    const auto publish = [&](int step) {
        cloud->seekable()->seek({}, step * kStep);
        base::FrameSnapshot snapshot(&schema, std::pmr::get_default_resource());
        base::GroupInfo info;
        info.step = kStep;
        cloud->publish(info, snapshot);
        return snapshot;
    };
    const float whole = thrown(0.0f, 0).ball.crossSection;
    for (int step = 0; step < 10; ++step) {
        const base::FrameSnapshot older = publish(step), newer = publish(step + 1);
        ASSERT_LE(newer.group(0).count(), def.capacity());
        for (const float t : {0.0f, 0.25f, 0.75f, 1.0f}) {
            const float frame = (float(step) + t) * 0.4f;
            for (const auto& [id, section] : shownSections(older, newer, t))
                EXPECT_NEAR(section / whole, std::max(1.0f - std::abs(frame - float(id)), 0.0f),
                            t == 0.0f || t == 1.0f ? 1e-5f : 0.21f)
                    << "ball " << id << " at frame " << frame;
        }
    }
}

TEST(MovingCloud, publishesTheVelocitiesOfBallsWithoutStreaks)
{
    base::SnapshotSchema schema;
    schema.add(base::kBlobKind);
    sim::MovingBall ball = thrown(0.0f, 2);
    ball.streak = glm::vec3(0.0f);
    sim::MovingCloudDef def;
    def.scale = 2.0f;
    def.setFrames({std::make_shared<const sim::MovingBalls>(sim::MovingBalls{ball})});
    const auto cloud = def.create(schema, {}, std::pmr::get_default_resource());
    base::FrameSnapshot snapshot(&schema, std::pmr::get_default_resource());
    cloud->publish({}, snapshot);
    const base::SnapshotGroup& group = snapshot.group(0);
    EXPECT_EQ(group.constants()[base::blob_constant::Shutter], 0.0f);
    for (size_t a = 0; a < 3; ++a)
        EXPECT_EQ(group.column(base::blob_column::VelocityX + a)[0], 2.0f * kSpeed[glm::length_t(a)]);
}

TEST(MovingCloud, oneFrameInALoopStaysWhereItIs)
{
    base::SnapshotSchema schema;
    schema.add(base::kBlobKind);
    sim::MovingCloudDef def;
    def.framesPerSecond = 1.0f;
    def.end = sim::SequenceEnd::Loop;
    def.setFrames({std::make_shared<const sim::MovingBalls>(sim::MovingBalls{thrown(0.0f, 2)})});
    const auto cloud = def.create(schema, {}, std::pmr::get_default_resource());
    EXPECT_EQ(def.at(0.3)[0].ball.center, kPlace);
    EXPECT_GT(cloud->seekable()->restsUntil(0), base::toTicks(1e6));
    for (const double seconds : {0.0, 0.2, 0.7, 3.4}) {
        cloud->seekable()->seek({}, base::toTicks(seconds));
        base::FrameSnapshot snapshot(&schema, std::pmr::get_default_resource());
        cloud->publish({}, snapshot);
        ASSERT_EQ(snapshot.group(0).count(), 1u);
        for (size_t a = 0; a < 3; ++a)
            EXPECT_EQ(snapshot.group(0).column(base::blob_column::PositionX + a)[0], kPlace[glm::length_t(a)])
                << seconds;
    }
}

TEST(Clouds, aFrameThatIsMissingIsNamed)
{
    const asset::AssetResolver resolver(".", {});
    const auto missing = preset::loadPresetText(
        R"({"version": 1, "clouds": [{"file": "a.%04d.fxballs", "frames": 2, "firstFrame": 7}]})", "t",
        nullptr, &resolver);
    ASSERT_FALSE(missing.ok());
    EXPECT_NE(missing.status().message().find("a.0007.fxballs"), std::string::npos)
        << missing.status().message();
}
