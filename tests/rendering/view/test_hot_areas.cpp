// Where heat shimmer looks: everywhere where there is heat, and hardly anywhere else.
#include "rendering/media/hot_areas.h"

#include "foundation/random/philox.h"
#include "rendering/passes/heat_offset_pass.h"
#include "tests/rendering/passes/post_pass_harness.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <limits>
#include <string>

namespace {

using namespace fx;
using namespace fx::render;

constexpr int kWidth = 330; // no multiple of a tile
constexpr int kHeight = 205;
constexpr ShimmerSettings kSettings{.strength = 4.0f, .maxOffset = 30.0f};

BlobInstance ball(glm::vec3 center, float radius, float heat)
{
    BlobInstance blob{};
    blob.centerRadius = {center, radius};
    blob.medium = {1.0f, heat, 0.0f, 0.3f};
    return blob;
}

CameraView perspective(float shiftX = 0.0f)
{
    CameraView camera;
    camera.projection = glm::perspective(0.9f, float(kWidth) / float(kHeight), 0.1f, 1000.0f);
    camera.projection[2][0] = shiftX;
    return camera;
}

CameraView orthographic()
{
    CameraView camera;
    camera.projection = glm::ortho(-8.0f, 8.0f, -5.0f, 5.0f, 0.1f, 100.0f);
    return camera;
}

/// Around the eye, at every distance and size, before and behind it; some are cold.
std::vector<BlobInstance> scattered(uint64_t seed, uint32_t count)
{
    std::vector<BlobInstance> blobs;
    for (uint64_t i = 0; i < count; ++i) {
        const auto u = base::randomUnit4(seed, 1, i, base::RandomPurpose::Position);
        const auto v = base::randomUnit4(seed, 2, i, base::RandomPurpose::Position);
        const float distance = std::exp2(8.0f * v[0] - 2.0f);
        const glm::vec3 way(3.0f * u[0] - 1.5f, 2.0f * u[1] - 1.0f, v[1] < 0.8f ? -1.0f : 1.0f);
        blobs.push_back(ball(distance * way, 0.4f * distance * u[2] * u[2], v[2] < 0.8f ? 900.0f : 0.0f));
    }
    return blobs;
}

bool isIn(const HotArea& area, uint32_t x, uint32_t y)
{
    return x >= area.left && x < area.right && y >= area.low && y < area.high;
}

uint64_t pixelsOf(std::span<const HotArea> areas)
{
    uint64_t sum = 0;
    for (const HotArea& area : areas)
        sum += uint64_t(area.right - area.left) * (area.high - area.low);
    return sum;
}

class HotAreasInPictures : public test::PostPass
{
protected:
    /// Adds the heat of the blobs to a new graph.
    ResourceId heatOf(const std::vector<BlobInstance>& blobs, const CameraView& camera)
    {
        graph_->begin();
        const std::vector<float> distances(size_t(kWidth) * kHeight, std::numeric_limits<float>::infinity());
        distance_ = importScalar(kWidth, kHeight, distances);
        HeatOffsetPass::Inputs in{};
        in.blobs = importBytes(std::as_bytes(std::span(blobs)));
        in.distance = distance_;
        in.count = uint32_t(blobs.size());
        in.anyHeat = true;
        in.width = kWidth;
        in.height = kHeight;
        in.view = makeViewBlock(camera, kWidth, kHeight);
        in.settings = kSettings;
        in.time = 1.0;
        return HeatOffsetPass::addTo(*graph_, in).heat;
    }

    /// A picture of noise through the heat of the blobs. @param outFragments of both passes of heat shimmer
    std::vector<float> shimmer(const std::vector<BlobInstance>& blobs, const CameraView& camera,
                               std::span<const HotArea> areas, uint64_t& outFragments)
    {
        const ResourceId heat = heatOf(blobs, camera);
        execute(heat);
        const test::Picture heatPicture = pictureOf(read(heat));

        graph_->begin();
        const std::vector<float> distances(size_t(kWidth) * kHeight, std::numeric_limits<float>::infinity());
        const auto out =
            HeatShimmerPass::addTo(*graph_, {import(noise()), importScalar(kWidth, kHeight, distances),
                                             import(heatPicture), areas, kWidth, kHeight, false, kSettings});
        outFragments = countFragments([&] { execute(out.color); });
        return read(out.color);
    }

    static test::Picture pictureOf(const std::vector<float>& texels)
    {
        test::Picture picture(kWidth, kHeight);
        picture.texels = texels;
        return picture;
    }

    static test::Picture noise()
    {
        test::Picture picture(kWidth, kHeight);
        for (size_t i = 0; i < picture.texels.size(); i += 4) {
            const auto u = base::randomUnit4(11, 0, i, base::RandomPurpose::Noise);
            std::copy_n(u.begin(), 4, picture.texels.begin() + ptrdiff_t(i));
        }
        return picture;
    }

    ResourceId distance_;

private:
    template <class F>
    uint64_t countFragments(F&& draw)
    {
        const GlLoader loader = context_->loader();
        const auto begin =
            reinterpret_cast<PFNGLBEGINQUERYPROC>(loader.getProcAddress(loader.user, "glBeginQuery"));
        const auto end =
            reinterpret_cast<PFNGLENDQUERYPROC>(loader.getProcAddress(loader.user, "glEndQuery"));
        GLuint query = 0;
        device_->gl.CreateQueries(GL_SAMPLES_PASSED, 1, &query);
        begin(GL_SAMPLES_PASSED, query);
        draw();
        end(GL_SAMPLES_PASSED);
        GLuint64 fragments = 0;
        device_->gl.GetQueryObjectui64v(query, GL_QUERY_RESULT, &fragments);
        device_->gl.DeleteQueries(1, &query);
        return fragments;
    }
};

HotAreas found(const std::vector<BlobInstance>& blobs, const CameraView& camera)
{
    HotAreas areas(std::pmr::new_delete_resource());
    areas.find(blobs, camera, kWidth, kHeight);
    return areas;
}

} // namespace

TEST_F(HotAreasInPictures, everyPixelWithHeatLiesInOneArea)
{
    size_t hot = 0;
    for (const CameraView& camera : {perspective(), perspective(0.7f), orthographic()})
        for (uint64_t seed = 0; seed < 12; ++seed) {
            const std::vector<BlobInstance> blobs = scattered(seed, seed % 2 == 0 ? 3 : 25);
            const HotAreas areas = found(blobs, camera);
            const ResourceId heat = heatOf(blobs, camera);
            execute(heat);
            const std::vector<float> texels = read(heat);
            for (uint32_t y = 0; y < kHeight; ++y)
                for (uint32_t x = 0; x < kWidth; ++x) {
                    const size_t n = size_t(std::count_if(areas.areas().begin(), areas.areas().end(),
                                                          [&](const HotArea& a) { return isIn(a, x, y); }));
                    ASSERT_LE(n, 1u);
                    const float* const texel = &texels[(size_t(y) * kWidth + x) * 4];
                    if (std::any_of(texel, texel + 4, [](float v) { return v != 0.0f; })) {
                        ++hot;
                        ASSERT_EQ(n, 1u) << x << ", " << y << " of seed " << seed;
                    }
                }
        }
    EXPECT_GT(hot, 100000u);
}

TEST_F(HotAreasInPictures, thePictureIsTheSameAsWhenAllOfItIsDrawn)
{
    constexpr HotArea kAll[] = {{0, 0, kWidth, kHeight}};
    size_t moved = 0;
    for (uint64_t seed = 20; seed < 24; ++seed) {
        const std::vector<BlobInstance> blobs = scattered(seed, 6);
        const HotAreas areas = found(blobs, perspective());
        uint64_t few = 0, all = 0;
        const auto inAreas = shimmer(blobs, perspective(), areas.areas(), few);
        const auto inAll = shimmer(blobs, perspective(), kAll, all);
        EXPECT_EQ(test::differentBits(inAreas, inAll), 0u);
        moved += test::differentBits(inAll, noise().texels);
        EXPECT_EQ(all, 2u * kWidth * kHeight);
        EXPECT_EQ(few, 2u * pixelsOf(areas.areas()));
    }
    EXPECT_GT(moved, 1000u);
}

TEST_F(HotAreasInPictures, aSmallFireCostsFragmentsBesideItOnly)
{
    const std::vector<BlobInstance> blobs{ball({1.0f, -2.0f, -20.0f}, 0.6f, 900.0f)}; // 14 pixels wide
    uint64_t fragments = 0;
    shimmer(blobs, perspective(), found(blobs, perspective()).areas(), fragments);
    EXPECT_GE(fragments, 2u * 14 * 14);
    EXPECT_LE(fragments, 2u * 3 * kHotTile * 3 * kHotTile);
}

TEST(HotAreas, gasBehindTheEyeBesideTheWindowOrColdHasNone)
{
    EXPECT_TRUE(found({ball({0, 0, 20}, 3.0f, 900.0f)}, perspective()).areas().empty());
    EXPECT_TRUE(found({ball({60, 0, -20}, 3.0f, 900.0f)}, perspective()).areas().empty());
    EXPECT_TRUE(found({ball({0, -60, -20}, 3.0f, 900.0f)}, perspective()).areas().empty());
    EXPECT_TRUE(found({ball({0, 0, -20}, 3.0f, 0.0f)}, perspective()).areas().empty());
    EXPECT_TRUE(found({}, perspective()).areas().empty());
}

TEST(HotAreas, withTheEyeInsideAllOfThePictureIsOne)
{
    EXPECT_EQ(pixelsOf(found({ball({0.1f, 0, 0}, 3.0f, 900.0f)}, perspective()).areas()),
              uint64_t(kWidth) * kHeight);
}

TEST(HotAreas, anOriginAtTheUpperLeftTurnsThemOver)
{
    const std::vector<BlobInstance> blobs{ball({1.0f, -3.0f, -20.0f}, 1.0f, 900.0f)};
    HotAreas areas(std::pmr::new_delete_resource());
    CameraView camera = perspective();
    areas.find(blobs, camera, kWidth, 13 * int(kHotTile));
    const std::vector<HotArea> upright(areas.areas().begin(), areas.areas().end());
    camera.upperLeftOrigin = true;
    areas.find(blobs, camera, kWidth, 13 * int(kHotTile));
    ASSERT_EQ(areas.areas().size(), upright.size());
    for (size_t i = 0; i < upright.size(); ++i) {
        const HotArea& turned = areas.areas()[upright.size() - 1 - i];
        EXPECT_EQ(turned.left, upright[i].left);
        EXPECT_EQ(turned.right, upright[i].right);
        EXPECT_EQ(turned.low, 13 * kHotTile - upright[i].high);
        EXPECT_EQ(turned.high, 13 * kHotTile - upright[i].low);
    }
}
