// Ribbons and mesh particles on the picture against their areas, textures and normals.
#include "particle_fixture.h"

#include "rendering/frame/exposure.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <numbers>

using namespace fx;
using namespace fx::test;
namespace constant = base::particle_constant;

namespace {

constexpr int kSide = 100; ///< [pixel] 10 a metre with flatCamera()

class RibbonTest : public ParticleTest
{
protected:
    void SetUp() override
    {
        ParticleTest::SetUp();
        makeTargets(kSide, kSide);
    }
    Picture draw(const base::FrameSnapshot& snapshot)
    {
        setPicture(std::vector<float>(size_t(kSide) * kSide * 4, 0.0f));
        return renderPair(snapshot, nullptr, 1.0, flatCamera());
    }
    static double sum(const Picture& picture)
    {
        double total = 0.0;
        for (size_t i = 0; i < picture.texels.size(); i += 4)
            total += double(picture.texels[i]);
        return total;
    }
};

/// A square of side 2 in the plane z = 0, facing +Z.
float addSquare(base::AssetTable& table)
{
    const glm::vec3 n(0, 0, 1);
    const std::vector<base::MeshVertex> corners{
        {{-1, -1, 0}, n, {0, 0}}, {{1, -1, 0}, n, {1, 0}}, {{1, 1, 0}, n, {1, 1}}, {{-1, 1, 0}, n, {0, 1}}};
    return float(*table.addMesh(corners, std::vector<uint32_t>{0, 1, 2, 0, 2, 3}));
}

} // namespace

TEST_F(RibbonTest, aStraightRibbonIsARectangleWithoutGapsOrOverlaps)
{
    std::vector<TestPoint> points;
    for (int i = 0; i <= 20; ++i)
        points.push_back({{3.0f - 0.3f * float(i), 0.0f, 0.0f}, 0.5f, 0.0f, {1, 1, 1, 0.5f}});
    auto snapshot = emptySnapshot();
    addRibbon(snapshot, points);
    const Picture picture = draw(snapshot);
    for (int x = 21; x < 79; ++x)
        for (int y = 46; y < 54; ++y)
            ASSERT_NEAR(picture.at(x, y)[0], 0.5f, 1e-6f) << x << ", " << y;
    EXPECT_NEAR(sum(picture), 0.5 * 60 * 10, 5.0);
}

TEST_F(RibbonTest, stripsAreNotJoinedAndSinglePointsShowNothing)
{
    auto snapshot = emptySnapshot();
    std::vector<TestPoint> points{
        {{-4, 0, 0}, 0.5f}, {{-2, 0, 0}, 0.5f}, {{2, 0, 0}, 0.5f}, {{4, 0, 0}, 0.5f}, {{4, 4, 0}, 0.5f}};
    points[2].strip = points[3].strip = uint64_t(1) << 32 | 1; // differs in its upper half only
    points[4].strip = 9;
    addRibbon(snapshot, points);
    const Picture picture = draw(snapshot);
    EXPECT_EQ(picture.at(50, 50)[0], 0.0f);
    EXPECT_NEAR(sum(picture), 2 * 20 * 10, 5.0);
}

TEST_F(RibbonTest, aBentRibbonIsClosedAtItsCorners)
{
    std::vector<TestPoint> points;
    for (int i = 0; i <= 64; ++i) {
        const float a = 2.0f * std::numbers::pi_v<float> * float(i) / 64.0f;
        points.push_back({{3.0f * std::cos(a), 3.0f * std::sin(a), 0.0f}, 0.5f});
    }
    auto snapshot = emptySnapshot();
    addRibbon(snapshot, points);
    const Picture picture = draw(snapshot);
    for (int i = 0; i < 500; ++i) {
        const double a = 2.0 * std::numbers::pi * i / 500.0;
        ASSERT_GT(picture.at(int(50 + 30 * std::cos(a)), int(50 + 30 * std::sin(a)))[0], 0.99f) << i;
    }
    EXPECT_NEAR(sum(picture), std::numbers::pi * (35 * 35 - 25 * 25), 40.0);
}

TEST_F(RibbonTest, theTextureRunsAlongTheArcAndStaysWhenTheRibbonGrows)
{
    const std::vector<uint8_t> stripes{255, 255, 255, 255,
                                       0,   0,   0,   255}; // lower half black, upper half white
    const auto id = float(*assets_.addImage(1, 2, true, stripes));
    const auto ribbon = [&](int newest) {
        std::vector<TestPoint> points;
        for (int i = newest; i >= 0; --i)
            points.push_back({{-4.0f + float(i), 0.0f, 0.0f}, 0.5f, float(i)});
        auto snapshot = emptySnapshot();
        auto& group = addRibbon(snapshot, points);
        set(group, constant::Texture, id);
        set(group, constant::ArcPerTile, 2.0f);
        return draw(snapshot);
    };
    const Picture shorter = ribbon(6);
    const Picture longer = ribbon(8);
    for (int x = 12; x < 68; ++x)
        ASSERT_NEAR(shorter.at(x, 50)[0], longer.at(x, 50)[0], 1e-4f) << x;
    EXPECT_LT(shorter.at(15, 50)[0], 0.06f) << "the first half metre of a tile of two";
    EXPECT_GT(shorter.at(25, 50)[0], 0.94f); // filtered between two texels a metre apart
    EXPECT_LT(shorter.at(35, 50)[0], 0.06f);
}

TEST_F(RibbonTest, betweenTwoSnapshotsTheHeadIsWhereItsParticleIs)
{
    // The particle goes along +X with 2 m in the 1 s between the snapshots; points are half a second apart.
    auto older = emptySnapshot(1.0);
    addRibbon(older, {{{-1, 0, 0}, 0.5f}, {{-3, 0, 0}, 0.5f}});
    auto newer = emptySnapshot(2.0);
    std::vector<TestPoint> points;
    for (int i = 0; i <= 4; ++i) {
        points.push_back({{1.0f - float(i), 0, 0}, 0.5f});
        points.back().age = 0.5f * float(i);
    }
    addRibbon(newer, points);
    for (const double share : {1.0, 0.75, 0.5, 0.25, 0.0}) {
        setPicture(std::vector<float>(size_t(kSide) * kSide * 4, 0.0f));
        const Picture picture = renderPair(newer, &older, share, flatCamera());
        const double head = -1.0 + 2.0 * share; // [m]; 10 pixels a meter, the middle at 50
        EXPECT_NEAR(sum(picture), (head + 3.0) * 10 * 10, 6.0) << share;
        EXPECT_EQ(picture.at(int(50 + 10 * head) + 1, 50)[0], 0.0f);
        EXPECT_GT(picture.at(int(50 + 10 * head) - 2, 50)[0], 0.9f);
    }
}

TEST_F(RibbonTest, betweenTwoSnapshotsTheTailIsWhereItWasAtThatMoment)
{
    // The same particle with a trail of 1 s, the rows of which are known for another second.
    auto older = emptySnapshot(1.0);
    addRibbon(older, {{{-1, 0, 0}, 0.5f}, {{-3, 0, 0}, 0.5f}});
    auto newer = emptySnapshot(2.0);
    std::vector<TestPoint> points;
    for (int i = 0; i <= 5; ++i) {
        points.push_back({{1.0f - 0.8f * float(i), 0, 0}, 0.5f});
        points.back().age = 0.4f * float(i);
    }
    auto& group = addRibbon(newer, points);
    for (const float age : {1.0f, 0.0f}) { // the second: it does not end for its age
        set(group, constant::TailAge, age);
        for (const double share : {1.0, 0.7, 0.5, 0.3, 0.0}) {
            setPicture(std::vector<float>(size_t(kSide) * kSide * 4, 0.0f));
            const Picture picture = renderPair(newer, &older, share, flatCamera());
            const double head = -1.0 + 2.0 * share; // [m]; 10 pixels a meter, the middle at 50
            const double tail = age > 0.0f ? head - 2.0 : -3.0;
            EXPECT_NEAR(sum(picture), (head - tail) * 10 * 10, 6.0) << age << " " << share;
            EXPECT_EQ(picture.at(int(50 + 10 * tail) - 2, 50)[0], 0.0f) << age << " " << share;
            EXPECT_GT(picture.at(int(50 + 10 * tail) + 1, 50)[0], 0.9f * float(head > tail + 0.2)) << share;
        }
    }
}

TEST_F(RibbonTest, aSoftEdgeFadesAcrossAndAStretchedTextureDoesNotRepeat)
{
    auto snapshot = emptySnapshot();
    auto& group = addRibbon(snapshot, {{{4, 0, 0}, 2.0f, 1.0f}, {{-4, 0, 0}, 2.0f, 0.0f}});
    set(group, constant::Edge, 0.5f);
    const Picture soft = draw(snapshot);
    EXPECT_NEAR(soft.at(50, 50)[0], 1.0f, 1e-3f);
    EXPECT_NEAR(soft.at(50, 50 + 15)[0], 0.5f, 0.16f); // half way into the outer half
    EXPECT_LT(soft.at(50, 50 + 19)[0], 0.05f);

    const std::vector<uint8_t> halves{255, 255, 255, 255, 0, 0, 0, 255};
    auto stretched = emptySnapshot();
    auto& other = addRibbon(stretched, {{{4, 0, 0}, 2.0f, 1.0f}, {{-4, 0, 0}, 2.0f, 0.0f}});
    set(other, constant::Texture, float(*assets_.addImage(1, 2, true, halves)));
    set(other, constant::ArcPerTile, 0.0f);
    const Picture picture = draw(stretched);
    EXPECT_GT(picture.at(88, 50)[0], 0.99f); // the upper end of the image is the head, up to its very end
    EXPECT_LT(picture.at(12, 50)[0], 0.01f);
}

TEST_F(RibbonTest, aMeshIsAsLargeAsItsRadiusAndTurnedByItsOrientation)
{
    auto snapshot = emptySnapshot();
    TestParticle p{{1, 0, 0}, 1.5f};
    TestParticle edgeOn{{-3, 0, 0}, 1.5f};
    edgeOn.orientation = glm::angleAxis(std::numbers::pi_v<float> / 3, glm::vec3(0, 1, 0));
    auto& group = addParticles(snapshot, {p, edgeOn});
    set(group, constant::Shape, float(base::ParticleShape::Mesh));
    set(group, constant::Mesh, addSquare(assets_));
    const Picture picture = draw(snapshot);
    EXPECT_NEAR(sum(picture), 30 * 30 + 30 * 15, 40.0);
    EXPECT_EQ(picture.at(46, 50)[0], 1.0f);
    EXPECT_EQ(picture.at(44, 50)[0], 0.0f);
}

TEST_F(RibbonTest, aMeshIsMattAndBothItsSidesAreLit)
{
    const float exposure = render::exposureFromEv100(kEv100);
    view_->settings().lighting.sunDirection = glm::normalize(glm::vec3(0, 0.6f, 0.8f));
    view_->settings().lighting.sunIlluminance = glm::vec3(1.0f / exposure);
    view_->settings().lighting.groundAlbedo = 0.0f;
    for (const float turn : {0.0f, std::numbers::pi_v<float>}) {
        auto snapshot = emptySnapshot();
        TestParticle p;
        p.orientation = glm::angleAxis(turn, glm::vec3(0, 1, 0));
        auto& group = addParticles(snapshot, {p});
        set(group, constant::Shape, float(base::ParticleShape::Mesh));
        set(group, constant::Mesh, addSquare(assets_));
        set(group, constant::Blend, float(base::ParticleBlend::Opaque));
        set(group, constant::Luminance, 0.0f);
        set(group, constant::Lit, 0.5f);
        EXPECT_NEAR(draw(snapshot).at(50, 50)[0], 0.5 * 0.8 / std::numbers::pi, 1e-5);
    }
}

TEST_F(RibbonTest, solidMeshesCutEachOther)
{
    auto snapshot = emptySnapshot();
    TestParticle a{{0, 0, 0}, 3.0f, {1, 0, 0, 1}};
    TestParticle b{{0, 0, 0}, 3.0f, {0, 1, 0, 1}};
    a.orientation = glm::angleAxis(0.7f, glm::vec3(0, 1, 0));
    b.orientation = glm::angleAxis(-0.7f, glm::vec3(0, 1, 0));
    auto& group = addParticles(snapshot, {a, b});
    set(group, constant::Shape, float(base::ParticleShape::Mesh));
    set(group, constant::Mesh, addSquare(assets_));
    set(group, constant::Blend, float(base::ParticleBlend::Opaque));
    const Picture picture = draw(snapshot);
    EXPECT_EQ(picture.at(40, 50)[0], 1.0f); // turned by a positive angle the left side comes forward
    EXPECT_EQ(picture.at(40, 50)[1], 0.0f);
    EXPECT_EQ(picture.at(60, 50)[1], 1.0f);
}

TEST_F(RibbonTest, aMeshThatDoesNotExistIsAnErrorAndThePictureStays)
{
    auto snapshot = emptySnapshot();
    auto& group = addParticles(snapshot, {TestParticle{}});
    set(group, constant::Shape, float(base::ParticleShape::Mesh));
    set(group, constant::Mesh, 77.0f);
    setPicture(std::vector<float>(size_t(kSide) * kSide * 4, 0.25f));
    render::FrameRequest request;
    request.camera = flatCamera();
    request.targets = {color_->name(), 0, 0, false, kSide, kSide};
    const base::Status status = view_->render({&snapshot, nullptr}, request);
    EXPECT_EQ(status.code(), base::Code::NotFound);
    EXPECT_NE(status.message().find("77"), std::string::npos);
    EXPECT_EQ(read(color_->name()).at(50, 50)[0], 0.25f);
}
