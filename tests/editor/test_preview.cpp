// The picture of the editor: it depends on text and time alone, not on what was shown before.
#include "fxsdk/editor/preview/preview.h"
#include "fxsdk/editor/preview/reference_error.h"
#include "fxsdk/editor/preview/why_invisible.h"
#include "rendering/gl/gl_read_texture.h"
#include "rendering/platform/gl_context.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>

namespace fx::editor {
namespace {

constexpr int kSide = 96; // [pixel]

const std::string kPreset =
    R"({"version": 1, "emitters": [{"maxParticles": 60, "emission": {"rate": 40}, "lifetime": 2,
    "radius": 0.2, "speed": 1.5, "opticalDepth": 2}]})";

class PreviewTest : public testing::Test
{
protected:
    void SetUp() override
    {
        auto context = render::createEglContext({});
        ASSERT_TRUE(context.ok()) << context.status().message();
        context_ = std::move(*context);
        preview_ = make();
    }
    std::unique_ptr<Preview> make()
    {
        auto preview = Preview::create(context_->loader());
        EXPECT_TRUE(preview.ok()) << preview.status().message();
        return std::move(*preview);
    }
    static PreviewFrame frame()
    {
        PreviewFrame frame;
        frame.pose.position = {0.0, 1.0, 6.0};
        frame.pose.target = {0.0, 1.0, 0.0};
        frame.width = frame.height = kSide;
        return frame;
    }
    std::vector<float> picture(Preview& preview)
    {
        const base::Status status = preview.render(frame());
        EXPECT_TRUE(status.ok()) << status.message();
        return render::readTexture(preview.device(), preview.texture(), kSide, kSide, 3);
    }
    static void show(Preview& preview, const std::string& text)
    {
        const base::Status status = preview.show(text, "a.fx.json", DocumentKind::Preset);
        ASSERT_TRUE(status.ok()) << status.message();
    }

    std::unique_ptr<render::GlContext> context_;
    std::unique_ptr<Preview> preview_;
};

TEST_F(PreviewTest, aTimeShowsThePictureOfPlayingToIt)
{
    show(*preview_, kPreset);
    const std::vector<float> start = picture(*preview_);
    for (int step = 1; step <= 60; ++step)
        ASSERT_TRUE(preview_->seek(step / 60.0).ok());
    const std::vector<float> played = picture(*preview_);
    EXPECT_GT(preview_->particles(), 20u);
    EXPECT_NE(played, start);
    ASSERT_TRUE(preview_->seek(1.5).ok());
    EXPECT_NE(picture(*preview_), played);
    ASSERT_TRUE(preview_->seek(1.0).ok()); // backwards
    EXPECT_EQ(picture(*preview_), played);
    const auto other = make();
    ASSERT_TRUE(other->seek(1.0).ok());
    show(*other, kPreset);
    EXPECT_EQ(picture(*other), played);
}

TEST_F(PreviewTest, aTextThatIsWrongLeavesThePicture)
{
    show(*preview_, kPreset);
    ASSERT_TRUE(preview_->seek(1.0).ok());
    const std::vector<float> before = picture(*preview_);
    const base::Status status = preview_->show(R"({"version": 1, "emitters": [{"maxParticles": -1}]})",
                                               "a.fx.json", DocumentKind::Preset);
    EXPECT_FALSE(status.ok());
    EXPECT_NE(status.message().find("maxParticles"), std::string::npos) << status.message();
    EXPECT_EQ(picture(*preview_), before);
    EXPECT_NE(status.message().find("a.fx.json"), std::string::npos) << status.message();
    for (const char* internal : {"edited-text", "fxLoadPresetFile"})
        EXPECT_EQ(status.message().find(internal), std::string::npos) << status.message();
}

TEST_F(PreviewTest, aSceneWhosePresetCannotBeLoadedLeavesTheSceneBefore)
{
    const std::filesystem::path folder(testing::TempDir() + "preview-scenes");
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "good.fx.json") << kPreset;
    std::ofstream(folder / "broken.png") << "no picture";
    std::ofstream(folder / "bad.fx.json")
        << R"({"version": 1, "emitters": [{"emission": {"rate": 40}, "appearance": {"kind": "sprite", "texture": "broken.png"}}]})";
    const std::string name = (folder / "a.scene.json").string();
    const auto showScene = [&](const std::string& instances) {
        return preview_->show(
            R"({"version": 1, "camera": {"position": [0, 1, 6], "target": [0, 1, 0]}, "instances": [)" +
                instances + "]}",
            name, DocumentKind::Scene);
    };
    const std::string good = R"({"preset": "good.fx.json"})";
    ASSERT_TRUE(showScene(good + ", " + good + ", " + good).ok());
    ASSERT_TRUE(preview_->seek(1.0).ok());
    const std::vector<float> before = picture(*preview_);
    const uint32_t particles = preview_->particles();
    EXPECT_GT(particles, 60u);
    const base::Status status = showScene(R"({"preset": "bad.fx.json"})");
    ASSERT_FALSE(status.ok());
    EXPECT_NE(status.message().find("broken.png"), std::string::npos) << status.message();
    EXPECT_EQ(preview_->scene().instances.size(), 3u);
    ASSERT_TRUE(preview_->seek(0.5).ok());
    ASSERT_TRUE(preview_->seek(1.0).ok());
    EXPECT_EQ(preview_->particles(), particles);
    EXPECT_EQ(picture(*preview_), before);
    EXPECT_TRUE(showScene(good).ok());
    EXPECT_EQ(preview_->particles(), particles / 3);
}

TEST_F(PreviewTest, anEffectBeginsAfterItsPrewarm)
{
    show(*preview_, kPreset);
    ASSERT_TRUE(preview_->seek(2.0).ok());
    const std::vector<float> later = picture(*preview_);
    const uint32_t particles = preview_->particles();
    std::string warm = kPreset;
    warm.insert(1, R"("prewarm": 1.5, )");
    show(*preview_, warm);
    ASSERT_TRUE(preview_->seek(0.5).ok());
    EXPECT_EQ(preview_->particles(), particles);
    EXPECT_EQ(picture(*preview_), later);
    ASSERT_TRUE(preview_->seek(0.0).ok());
    EXPECT_GT(preview_->particles(), 40u);
}

TEST_F(PreviewTest, anEffectMovesAsItsPreviewStates)
{
    const std::string moving = R"({"version": 1, "emitters": [{"maxParticles": 400, "emission": {"rate": 90},
        "space": "world", "lifetime": 4, "radius": 0.05, "speed": 0, "size": 0, "forces": {"gravity": 0}}],
        "preview": {"time": 1.5, "instance": {"keys": [{"time": 0, "position": [-2, 1, 0]},
        {"time": 2, "position": [2, 1, 0]},
        {"time": 3, "position": [2, 2, 0]}], "triggers": []}}})";
    const auto bounds = [&] {
        OverlayChoice choice;
        choice.bounds = true;
        std::pair<glm::dvec3, glm::dvec3> ends{glm::dvec3(1e9), glm::dvec3(-1e9)};
        for (const WireLine& line : preview_->overlays(choice, frame()).lines)
            for (const glm::dvec3& p : {line.from, line.to})
                ends = {glm::min(ends.first, p), glm::max(ends.second, p)};
        return ends;
    };
    show(*preview_, moving);
    std::map<double, std::vector<float>> pictures;
    for (const double time : {0.0, 1.0, 3.0, 1.0, 0.0}) { // forwards and backwards
        ASSERT_TRUE(preview_->seek(time).ok());
        std::vector<float> now = picture(*preview_);
        const glm::dvec3 place = preview_->placement().position;
        EXPECT_NEAR(place.x, time == 0.0 ? -2.0 : time == 1.0 ? 0.0 : 2.0, time == 1.0 ? 0.6 : 1e-9) << time;
        EXPECT_NEAR(place.y, time == 3.0 ? 2.0 : 1.0, time == 1.0 ? 0.3 : 1e-9) << time;
        if (time > 0.0) { // particles stay where the effect was when they were born
            EXPECT_NEAR(bounds().first.x, -2.05, 0.1) << time;
            EXPECT_GT(bounds().second.x, place.x - 0.15) << time;
            EXPECT_NEAR(bounds().second.y, place.y, 0.15) << time;
        }
        if (pictures.contains(time)) {
            EXPECT_EQ(now, pictures[time]) << time;
        }
        pictures[time] = std::move(now);
    }
    EXPECT_NE(pictures[0.0], pictures[1.0]);
    ASSERT_TRUE(preview_->seek(1.0).ok()); // an edit is shown at the same time
    show(*preview_, moving + " ");
    EXPECT_EQ(picture(*preview_), pictures[1.0]);
}

TEST_F(PreviewTest, motionIsPlayedExactlyInBothDirections)
{
    const std::string dust = R"({"version": 1, "emitters": [{"maxParticles": 60, "emission": {"rate": 40},
        "lifetime": 1, "radius": 0.2, "speed": 0.1, "space": "world", "opticalDepth": 3, "forces": {"gravity": 0}}]})";
    preview_->setMotion({MotionKind::Circle, 1.5, 3.0});
    show(*preview_, dust);
    const double turn = 2.0 * 3.14159265358979 * 1.5 / 3.0; // [s]
    ASSERT_TRUE(preview_->seek(std::round(0.25 * turn * 60.0) / 60.0).ok());
    const glm::dvec3 quarter = preview_->placement().position;
    EXPECT_NEAR(quarter.x, 0.0, 0.05);
    EXPECT_NEAR(quarter.z, -1.5, 0.05);
    const std::vector<float> before = picture(*preview_);
    EXPECT_GT(preview_->particles(), 10u);
    ASSERT_TRUE(preview_->seek(1.5).ok());
    EXPECT_NE(picture(*preview_), before);
    ASSERT_TRUE(preview_->seek(std::round(0.25 * turn * 60.0) / 60.0).ok()); // from the beginning
    EXPECT_EQ(picture(*preview_), before);
    preview_->setMotion({MotionKind::Throw, 1.0, 9.81});
    show(*preview_, dust);
    ASSERT_TRUE(preview_->seek(0.5).ok());
    EXPECT_NEAR(preview_->placement().position.x, 0.5 * 9.81 * std::sqrt(0.5), 0.01);
    EXPECT_NEAR(preview_->placement().position.y, 0.5 * 9.81 * std::sqrt(0.5) - 0.125 * 9.81, 0.01);
    preview_->setMotion({});
    show(*preview_, dust);
    EXPECT_EQ(preview_->placement().position, glm::dvec3(0.0));
}

TEST_F(PreviewTest, triggersOfTheDocumentArePlayed)
{
    const std::string sparks =
        R"({"version": 1, "emitters": [{"name": "hit", "maxParticles": 50, "lifetime": 3,
        "radius": 0.1, "speed": 1, "opticalDepth": 1}, {"maxParticles": 4, "emission": {"rate": 1}, "lifetime": 1,
        "radius": 0.1, "events": [{"on": "host", "name": "bang", "emit": "hit", "count": 20}]}],
        "preview": {"instance": {"triggers": [{"time": 1, "name": "bang"}]}}})";
    preview_->setMotion({MotionKind::Document});
    show(*preview_, sparks);
    ASSERT_TRUE(preview_->seek(0.9).ok());
    EXPECT_LT(preview_->particles(), 5u);
    ASSERT_TRUE(preview_->seek(1.2).ok());
    EXPECT_GE(preview_->particles(), 20u);
    ASSERT_TRUE(preview_->seek(0.9).ok());
    EXPECT_LT(preview_->particles(), 5u);
    ASSERT_TRUE(preview_->seek(1.2).ok());
    const std::vector<float> before = picture(*preview_);
    std::string renamed = sparks;
    renamed.replace(renamed.find(R"("bang", "emit")"), 6, R"("boom")"); // the trigger names none now
    EXPECT_FALSE(preview_->show(renamed, "a.fx.json", DocumentKind::Preset).ok());
    EXPECT_EQ(picture(*preview_), before);
    ASSERT_TRUE(preview_->seek(0.9).ok());
    EXPECT_LT(preview_->particles(), 5u);
}

TEST_F(PreviewTest, elementsAreCountedByTheirPointers)
{
    show(
        *preview_,
        R"({"version": 1, "emitters": [{"maxParticles": 60, "emission": {"bursts": [{"time": 0, "count": 7}]},
        "lifetime": 2, "radius": 0.2}, {"maxParticles": 60, "emission": {"bursts": [{"time": 0, "count": 12}]},
        "lifetime": 2, "radius": 0.2, "light": {"intensity": 1}}]})");
    ASSERT_TRUE(preview_->seek(0.5).ok());
    EXPECT_EQ(preview_->elementCounts(),
              (std::map<std::string, uint32_t>{{"/emitters/0", 7u}, {"/emitters/1", 12u}}));
}

TEST_F(PreviewTest, firesLightTheGroundAndSmokeDarkensIt)
{
    const auto groundOf = [&](const std::string& emitter, const std::string& preview, int row) {
        show(*preview_, R"({"version": 1, "emitters": [{"maxParticles": 60, "emission": {"rate": 60},
            "lifetime": 5, "speed": 0, "forces": {"gravity": 0}, "size": 0.2, "position": [0, 1.2, 0], )" +
                            emitter + R"(}], "preview": {)" + preview + "}}");
        std::vector<double> means; // of red at the times 0 and 1 s, in the middle third of the row
        for (const double time : {0.0, 1.0}) {
            EXPECT_TRUE(preview_->seek(time).ok());
            const std::vector<float> pixels = picture(*preview_);
            double sum = 0.0;
            for (int x = kSide / 3; x < 2 * kSide / 3; ++x)
                sum += double(pixels[size_t(3 * (row * kSide + x))]);
            means.push_back(sum / (kSide / 3));
        }
        return means;
    };
    const std::vector<double> lit = groundOf(
        R"("layer": "fire", "radius": 0.2, "opticalDepth": 1, "temperature": 1700)",
        R"("exposureEv100": 8, "lighting": {"sunIlluminance": [0, 0, 0], "skyLuminance": [5, 5, 5]})", 2);
    EXPECT_GT(lit[1], 2.0 * lit[0]); // 4 m in front of the fire
    const std::vector<double> shaded =
        groundOf(R"("radius": 0.5, "opticalDepth": 10)",
                 R"("lighting": {"sunDirection": [0, 0.6, -0.8], "sunIlluminance": [50000, 50000, 50000],
                    "skyLuminance": [500, 500, 500]})",
                 25); // between smoke and camera, where its shadow falls
    EXPECT_LT(shaded[1], 0.7 * shaded[0]);
}

TEST_F(PreviewTest, saysWhyNothingIsSeen)
{
    show(*preview_, kPreset);
    ASSERT_TRUE(preview_->seek(1.0).ok());
    PreviewFrame away = frame();
    EXPECT_NE(preview_->causes(away).at(0).find("in view"), std::string::npos);
    away.pose.target = {0.0, 1.0, 100.0};
    EXPECT_NE(preview_->causes(away).at(0).find("behind the camera"), std::string::npos);

    const auto document = Document::fromText(
        R"({"version": 1, "emitters": [{"emission": {"rate": 1, "start": 3}, "opticalDepth": 0}]})",
        "a.fx.json");
    ASSERT_TRUE(document.ok());
    SoloMute choice;
    choice.setMuted("/emitters/0", true);
    std::string all;
    for (const std::string& reason : whyInvisible(*document, choice, 1.0))
        all += reason + "\n";
    for (const char* part : {"/emitters/0: it is muted", "/emitters/0/emission/start: it begins at 3 s",
                             "/emitters/0/opticalDepth: it is 0"})
        EXPECT_NE(all.find(part), std::string::npos) << all;
}

TEST_F(PreviewTest, overlaysShowBoundsAndVelocitiesOfTheParticles)
{
    show(*preview_, kPreset);
    ASSERT_TRUE(preview_->seek(1.0).ok());
    (void)picture(*preview_);
    OverlayChoice choice;
    choice.bounds = choice.velocities = true;
    const OverlayData data = preview_->overlays(choice, frame());
    EXPECT_EQ(data.bounded, 1u);
    EXPECT_EQ(data.arrows, preview_->particles());
    EXPECT_EQ(data.moving, preview_->particles());
    glm::dvec3 low(1e9), high(-1e9);
    for (const WireLine& line : data.lines)
        if (line.kind == WireKind::Bounds)
            for (const glm::dvec3& p : {line.from, line.to})
                low = glm::min(low, p), high = glm::max(high, p);
    size_t arrows = 0;
    for (const WireLine& line : data.lines) {
        if (line.kind != WireKind::Velocity)
            continue;
        ++arrows;
        EXPECT_LE(glm::length(line.to - line.from), 0.1 * 12.0); // at 1.5 m/s and 1 s of fall at most
        for (int i = 0; i < 3; ++i)
            EXPECT_TRUE(line.from[i] >= low[i] && line.from[i] <= high[i]);
    }
    EXPECT_EQ(arrows, data.arrows);
    EXPECT_TRUE(preview_->overlays({}, frame()).lines.empty());
}

TEST_F(PreviewTest, overdrawCountsDisksOnTheirPlace)
{
    show(*preview_,
         R"({"version": 1, "emitters": [{"maxParticles": 7, "emission": {"bursts": [{"time": 0, "count": 7}]},
        "lifetime": 5, "speed": 0, "forces": {"gravity": 0}, "position": [0, 1, 0], "radius": 2.0, "size": 0}]})");
    ASSERT_TRUE(preview_->seek(0.5).ok());
    OverlayChoice choice;
    choice.overdraw = true;
    const OverdrawMap map = preview_->overlays(choice, frame()).overdraw;
    ASSERT_EQ(map.columns, kSide / 8);
    ASSERT_EQ(map.rows, kSide / 8);
    EXPECT_NEAR(map.largest, 7.0, 1e-6); // all at one place, in the middle
    EXPECT_NEAR(double(map.counts[size_t(map.rows / 2 * map.columns + map.columns / 2)]), 7.0, 1e-6);
    EXPECT_EQ(map.counts[0], 0.0f);
}

TEST_F(PreviewTest, aSliceCutsBallsInDisks)
{
    // One ball of 0.5 m at the height 1 m, which does not move.
    show(*preview_,
         R"({"version": 1, "emitters": [{"maxParticles": 1, "emission": {"bursts": [{"time": 0, "count": 1}]},
        "lifetime": 9, "radius": 0.5, "speed": 0, "position": [0, 1, 0], "forces": {"gravity": 0}}]})");
    ASSERT_TRUE(preview_->seek(0.5).ok());
    OverlayChoice choice;
    choice.slice = true;
    const auto areaAt = [&](double z) { // [cells]
        PreviewFrame seen = frame();
        seen.pose.position = {0.0, 1.0, z + 6.0};
        seen.pose.target = {0.0, 1.0, z};
        const OverlayData data = preview_->overlays(choice, seen);
        double sum = 0.0;
        for (const float count : data.slice.counts)
            sum += double(count);
        return sum;
    };
    const double middle = areaAt(0.0);
    EXPECT_GT(middle, 1.0);
    EXPECT_LT(areaAt(0.4), 0.7 * middle); // a disk of 0.3 m
    EXPECT_EQ(areaAt(0.6), 0.0);
}

TEST_F(PreviewTest, theVolumeOfLightSlicesHoldsTheMedium)
{
    show(
        *preview_,
        R"({"version": 1, "emitters": [{"maxParticles": 60, "emission": {"rate": 60}, "lifetime": 5, "speed": 0,
        "forces": {"gravity": 0}, "size": 0.2, "position": [0, 1.2, 0], "radius": 0.5, "opticalDepth": 10}]})");
    ASSERT_TRUE(preview_->seek(1.0).ok());
    (void)picture(*preview_);
    OverlayChoice choice;
    choice.lightSlices = true;
    const OverlayData data = preview_->overlays(choice, frame());
    ASSERT_GE(data.volumes, 1u);
    ASSERT_EQ(data.lines.size(), 12u * data.volumes);
    glm::dvec3 middle(0.0); // of the first, the widest
    for (size_t i = 0; i < 12; ++i)
        middle += (data.lines[i].from + data.lines[i].to) / 24.0;
    double reach = 0.0;
    for (size_t i = 0; i < 12; ++i)
        reach = std::max(reach, glm::length(data.lines[i].from - middle));
    EXPECT_LT(glm::length(middle - glm::dvec3(0.0, 1.2, 0.0)), reach);
    EXPECT_GT(reach, 0.5);
}

TEST(ErrorPicture, statesMeanP99AndLargestOfTheClippedLuminance)
{
    std::vector<float> picture(300, 0.5f), reference(300, 0.5f);
    picture[0] = picture[1] = picture[2] = 0.75f;      // 0.25 brighter
    reference[3] = reference[4] = reference[5] = 3.0f; // counts as white: 0.5 darker
    const ErrorPicture error = errorOf(picture, reference, 10, 10);
    EXPECT_NEAR(error.mean, 0.0075, 1e-7);
    EXPECT_NEAR(error.p99, 0.25, 1e-7);
    EXPECT_NEAR(error.largest, 0.5, 1e-7);
    const std::vector<uint8_t> colors = errorColors(error);
    ASSERT_EQ(colors.size(), 400u);
    EXPECT_EQ(colors[8], 0); // no error is black
    EXPECT_GT(colors[4], colors[0] - 1);
    EXPECT_GT(colors[5], colors[1]);
}

TEST(ErrorPicture, colorsThatAreNoNumbersAreCountedAndAsWrongAsCanBe)
{
    std::vector<float> picture(300, 0.5f), reference(300, 0.5f);
    reference[4] = std::numeric_limits<float>::quiet_NaN();
    reference[9] = std::numeric_limits<float>::infinity();
    picture[299] = -std::numeric_limits<float>::infinity();
    const ErrorPicture error = errorOf(picture, reference, 10, 10);
    EXPECT_EQ(error.notFinite, 3u);
    EXPECT_NEAR(error.mean, 0.03, 1e-9);
    EXPECT_EQ(error.largest, 1.0);
    EXPECT_EQ(error.errors[1], 1.0f);
    EXPECT_EQ(error.errors[2], 0.0f);
}

TEST_F(PreviewTest, theReferenceOfASmallPictureIsNearAndCanBeStopped)
{
    show(*preview_, kPreset);
    ASSERT_TRUE(preview_->seek(1.0).ok());
    PreviewFrame linear = frame();
    linear.isLinear = true;
    ASSERT_TRUE(preview_->render(linear).ok());
    std::vector<float> rows = render::readTexture(preview_->device(), preview_->texture(), kSide, kSide, 3);
    std::vector<float> downwards;
    for (int y = kSide - 1; y >= 0; --y)
        downwards.insert(downwards.end(), rows.begin() + std::ptrdiff_t(3 * kSide * y),
                         rows.begin() + std::ptrdiff_t(3 * kSide * (y + 1)));
    ReferenceRun run(preview_->scene(), 1.0, linear, downwards);
    const base::Result<ErrorPicture>& result = run.result();
    ASSERT_TRUE(result.ok()) << result.status().message();
    EXPECT_DOUBLE_EQ(run.progress(), 1.0);
    EXPECT_LT(result->mean, 0.03);
    ReferenceRun wrong(preview_->scene(), 1.0, linear, rows); // upside down
    ASSERT_TRUE(wrong.result().ok());
    EXPECT_GT(wrong.result()->mean, 3.0 * result->mean);
    ReferenceRun stopped(preview_->scene(), 300.0, linear, downwards);
    stopped.stop();
    EXPECT_EQ(stopped.result().status().code(), base::Code::Interrupted);
}

} // namespace
} // namespace fx::editor
