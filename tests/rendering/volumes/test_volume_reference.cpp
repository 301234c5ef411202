// A volume in the ray integral and in the path tracer: balls say where it is, voxels what it has.
#include "foundation/snapshot/material_kind.h"
#include "foundation/snapshot/volume_kind.h"
#include "rendering/reference/path/blob_path_medium.h"
#include "rendering/reference/render/detailed_ray.h"
#include "rendering/reference/render/medium_blobs.h"
#include "rendering/reference/trace/ray_query.h"
#include "rendering/volumes/medium_volume.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace fx;

namespace {

constexpr float kSide = 0.25f;

/// One brick with the extinction f(x, y, z) of its voxels 0..7, and albedo .5.
class VolumeScene
{
public:
    template <class F>
    explicit VolumeScene(F f, const glm::quat& rotation = {1, 0, 0, 0}, bool hasDetail = false)
        : hasDetail_(hasDetail)
    {
        base::VoxelVolume voxels;
        voxels.bricks = {{1, 1, 1}};
        voxels.evenAlbedo = glm::vec3(0.5f);
        voxels.temperature.assign(512, 1200.0f);
        for (int v = 0; v < 512; ++v)
            voxels.extinction.push_back(f(v % 8, v / 8 % 8, v / 64));
        volume_ = std::make_shared<render::MediumVolume>(voxels);
        schema_.add(base::kBlobKind);
        schema_.add(base::kMaterialKind);
        schema_.add(base::kVolumeKind);
        voxels.side = kSide;
        publish(base::volumeCells(voxels), rotation);
        list_ =
            render::mediumOf({&snapshot_, nullptr}, 1.0, [&](const render::GroupVolume&) { return volume_; });
    }

    const render::MediumList& list() const { return list_; }
    render::MediumList& list() { return list_; }
    const render::MediumVolume& volume() const { return *volume_; }

private:
    void publish(const std::vector<base::VolumeCells>& cells, const glm::quat& rotation)
    {
        namespace blob = base::blob_column;
        base::SnapshotGroup& blobs = snapshot_.addGroup(schema_.find("blob"), cells.size());
        blobs.editInfo().kind = schema_.find("blob");
        blobs.editInfo().count = uint32_t(cells.size());
        blobs.editInfo().placement.rotation = rotation;
        for (size_t c = 0; c < blob::Count; ++c)
            std::ranges::fill(blobs.editColumn(c), 0.0f);
        for (size_t i = 0; i < cells.size(); ++i) {
            for (int a = 0; a < 3; ++a)
                blobs.editColumn(blob::PositionX + size_t(a))[i] =
                    kSide * 8.0f * (float(cells[i].brick[a]) + 0.5f);
            blobs.editColumn(blob::Radius)[i] = base::kVolumeBallRadius * kSide;
            blobs.editColumn(blob::CrossSection)[i] = cells[i].crossSection;
            blobs.editIds()[i] = i;
        }
        if (hasDetail_)
            addDetail(cells.size());
        base::SnapshotGroup& volume = snapshot_.addGroup(schema_.find("volume"), 0);
        volume.editInfo().kind = schema_.find("volume");
        volume.editInfo().placement.rotation = rotation;
        volume.editConstants()[base::volume_constant::Side] = kSide;
        volume.editConstants()[base::volume_constant::Density] = 1.0f;
    }

    void addDetail(size_t balls)
    {
        namespace m = base::material_constant;
        const uint32_t capacity = uint32_t(balls);
        base::SnapshotGroup& material = snapshot_.addGroup(schema_.find("material"), capacity);
        const base::SnapshotGroup& blobs = snapshot_.editGroup(0);
        material.editInfo() = blobs.info();
        material.editInfo().kind = schema_.find("material");
        for (size_t g = 0; g < 2; ++g) {
            for (size_t k = 0; k < 3; ++k)
                std::ranges::copy(blobs.column(base::blob_column::PositionX + k),
                                  material.editColumn(base::material_column::Place0X + 3 * g + k).begin());
            material.editConstants()[m::Length0 + g] = 4.0f * kSide;
            material.editConstants()[m::Growth0 + g] = 1.0f;
        }
        material.editConstants()[m::Generation] = 1.0f;
        material.editConstants()[m::Thinnest] = 0.2f;
        material.editConstants()[m::Densest] = 5.0f;
        material.editConstants()[m::Ramp] = 0.25f;
        material.editConstants()[m::Gain] = 0.55f;
        material.editConstants()[m::Lossy] = 1.0f;
    }

    bool hasDetail_;
    base::SnapshotSchema schema_;
    base::FrameSnapshot snapshot_{&schema_, std::pmr::get_default_resource()};
    std::shared_ptr<const render::MediumVolume> volume_;
    render::MediumList list_;
};

double depthOf(const VolumeScene& scene, const render::TraceRay& ray)
{
    const auto tasks = base::makeSerialRunner();
    render::MediumView view;
    view.build(scene.list().blobs, glm::dvec3(0.0), *tasks, scene.list().details);
    render::DetailedRay detailed(view, render::DetailedRay::Wanted::Light, 1e-6);
    render::RayHits hits;
    render::findHits(view.tree(), ray, 0.0, 1e3, hits);
    hits.sort();
    detailed.trace(ray, hits, 0.0, 1e3);
    return detailed.opticalDepth();
}

} // namespace

TEST(VolumeReference, opticalDepthIsTheIntegralOfTheInterpolatedVoxels)
{
    const VolumeScene even([](int, int, int) { return 2.0f; });
    // along x: voxels 8 to 15, and half a voxel's depth in the cell before and behind each
    const double middle = double(kSide) * 11.5;
    EXPECT_NEAR(depthOf(even, {{-1.0, middle, middle}, {1, 0, 0}}), 2.0 * double(kSide) * 8.0, 1e-5);
    const VolumeScene uneven([](int x, int y, int z) { return float((x * 5 + y * 3 + z) % 7); });
    const glm::dvec3 origin(-1.0, 2.0, 1.9), direction = glm::normalize(glm::dvec3(3.0, 0.7, 1.1));
    double sum = 0.0;
    const int steps = 200'000;
    for (int k = 0; k < steps; ++k) {
        const glm::dvec3 p = origin + direction * (8.0 * (k + 0.5) / steps);
        sum += uneven.volume().at(p / double(kSide)).extinction * 8.0 / steps;
    }
    EXPECT_NEAR(depthOf(uneven, {origin, direction}), sum, 1e-4);
}

TEST(VolumeReference, detailErodesVoxelsEquallyForRaysAndPaths)
{
    const VolumeScene scene([](int x, int y, int z) { return 0.2f + 0.1f * float((x * 5 + y * 3 + z) % 7); },
                            {1, 0, 0, 0}, true);
    const auto tasks = base::makeSerialRunner();
    const render::BlobPathMedium medium(scene.list().blobs, glm::dvec3(0.0), *tasks, 0.0,
                                        scene.list().details);
    const auto walk = medium.walk();
    int eroded = 0, denser = 0;
    for (int i = 0; i < 6; ++i) {
        const glm::dvec3 origin(0.1, 0.3, -4.0);
        const glm::dvec3 direction =
            glm::normalize(double(kSide) * glm::dvec3(9.0 + i, 13.0 - i, 11.5) - origin);
        walk->start({origin, direction}, 0.0, 1e3);
        render::MajorantSegment segment;
        double depth = 0.0;
        while (walk->next(segment)) {
            const int points = 1 + int((segment.end - segment.begin) * 400.0);
            for (int k = 0; k < points; ++k) {
                const double t = segment.begin + (segment.end - segment.begin) * (k + 0.5) / points;
                const double found = walk->at(t, 0.5).extinction.x;
                const double smooth = scene.volume().at((origin + direction * t) / double(kSide)).extinction;
                EXPECT_LE(found, segment.majorant);
                eroded += smooth > 0.1 && found < 0.5 * smooth ? 1 : 0;
                denser += found > 1.2 * smooth ? 1 : 0;
                depth += found * (segment.end - segment.begin) / points;
            }
        }
        EXPECT_NEAR(depthOf(scene, {origin, direction}), depth, 0.01 * depth) << i;
    }
    EXPECT_GT(eroded, 100);
    EXPECT_GT(denser, 100) << "the mean of what is left is the smooth medium";
}

TEST(VolumeReference, withoutDetailOfPicturesIsTheSmoothVolume)
{
    const auto f = [](int x, int, int) { return x < 4 ? 0.6f : 0.3f; };
    VolumeScene detailed(f, {1, 0, 0, 0}, true);
    const double middle = double(kSide) * 11.5;
    const render::TraceRay ray{{-1.0, middle, middle}, {1, 0, 0}};
    const double smooth = depthOf(VolumeScene(f), ray);
    EXPECT_GT(std::abs(depthOf(detailed, ray) - smooth), 0.05 * smooth);
    render::removeNoise(detailed.list().details);
    EXPECT_EQ(depthOf(detailed, ray), smooth);
}

TEST(VolumeReference, turnsWithItsInstance)
{
    const auto f = [](int x, int, int) { return x < 4 ? 3.0f : 1.0f; };
    const glm::quat turn(std::sqrt(0.5f), 0.0f, std::sqrt(0.5f), 0.0f); // x to -z
    const double a = double(kSide) * 10.0, b = double(kSide) * 12.5;
    EXPECT_NEAR(depthOf(VolumeScene(f, turn), {{b, b, -a - 10.0}, {0, 0, 1}}),
                depthOf(VolumeScene(f), {{a + 10.0, b, b}, {-1, 0, 0}}), 1e-4);
    EXPECT_GT(depthOf(VolumeScene(f, turn), {{b, b, -20.0}, {0, 0, 1}}), 1.0);
}

TEST(VolumeReference, majorantsOfPathsBoundTheVoxelsAndPointsHaveTheirMedium)
{
    const VolumeScene scene([](int x, int y, int z) { return x == 3 && y == 4 && z == 5 ? 40.0f : 0.5f; });
    const auto tasks = base::makeSerialRunner();
    const render::BlobPathMedium medium(scene.list().blobs, glm::dvec3(0.0), *tasks, 0.0,
                                        scene.list().details);
    const auto walk = medium.walk();
    int points = 0;
    for (int i = 0; i < 64; ++i) {
        const glm::dvec3 target =
            double(kSide) * glm::dvec3(8.0 + i % 4 * 2.0, 8.0 + i / 4 % 4 * 2.0, 8.0 + i / 16 * 2.0);
        const glm::dvec3 direction = glm::normalize(target - glm::dvec3(0.1, 0.3, -4.0));
        walk->start({{0.1, 0.3, -4.0}, direction}, 0.0, 1e3);
        render::MajorantSegment segment;
        while (walk->next(segment)) {
            for (int k = 0; k < 8; ++k) {
                const double t = segment.begin + (segment.end - segment.begin) * (k + 0.5) / 8.0;
                const render::MediumPoint point = walk->at(t, 0.5);
                const glm::dvec3 p = glm::dvec3(0.1, 0.3, -4.0) + direction * t;
                const double exact = scene.volume().at(p / double(kSide)).extinction;
                EXPECT_LE(point.extinction.x, segment.majorant);
                EXPECT_NEAR(point.extinction.x, exact, 1e-5 * (exact + 1e-3));
                EXPECT_NEAR(point.scattering.y, 0.5 * exact, 1e-5 * (exact + 1e-3));
                EXPECT_NEAR(point.emission.x, scene.volume().at(p / double(kSide)).emitted.x, 1e-3);
                ++points;
            }
        }
    }
    EXPECT_GT(points, 1000);
    EXPECT_GE(medium.majorant(), 40.0);
}
