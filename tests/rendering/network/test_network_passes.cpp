// The network on the GPU against the one on the processor, and what holds for any light: furnace, no light
// made or lost, nowhere negative, light that goes on from frame to frame.
#include "foundation/random/philox.h"
#include "rendering/field/field_blocks.h"
#include "rendering/gl/gl_read_texture.h"
#include "rendering/network/network_passes.h"
#include "rendering/network/scattering_network.h"
#include "shaders/formulas/formula.h"
#include "tests/rendering/passes/post_pass_harness.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace fx;
using namespace fx::render;
using namespace fx::test;

namespace {

constexpr int kSide = 16; ///< cells along a side of a cube
constexpr size_t kCount = size_t(kSide) * kSide * kSide;
const float kRootSphere = std::sqrt(4.0f * std::numbers::pi_v<float>);

/// What fills a grid, and what shines on it.
struct Scene
{
    std::vector<float> cells, scatter; ///< emitted light, extinction; extinction times albedo, cosine
    FieldGlowBlock grid{glm::vec4(-0.5f, -0.5f, -0.5f, 1.0f / kSide)};
    LightListBlock lights{};

    explicit Scene(const glm::ivec3& sides = glm::ivec3(kSide))
    {
        grid.cells = glm::ivec4(sides, 0);
        cells.assign(4 * count(), 0.0f);
        scatter.assign(4 * count(), 0.0f);
        lights.counts = {1, 0, 1, 0};
        lights.lights[0].place = {0.0f, 1.0f, 0.0f, 0.0f};
    }
    size_t count() const { return size_t(grid.cells.x) * size_t(grid.cells.y) * size_t(grid.cells.z); }
    void set(size_t i, float extinction, const glm::vec3& albedo, const glm::vec3& emitted, float cosine)
    {
        for (int c = 0; c < 3; ++c) {
            cells[4 * i + size_t(c)] = emitted[c];
            scatter[4 * i + size_t(c)] = extinction * albedo[c];
        }
        cells[4 * i + 3] = extinction;
        scatter[4 * i + 3] = cosine;
    }
};

/// Cells of any kind, a quarter of them empty.
Scene randomScene(uint64_t seed, float cosine, const glm::ivec3& sides = glm::ivec3(kSide))
{
    Scene scene(sides);
    for (size_t i = 0; i < scene.count(); ++i) {
        const auto u = [&](uint32_t k) {
            return base::toUnitFloat(base::philox({uint32_t(i), k, 0, 0}, seed)[0]);
        };
        const float extinction = u(0) < 0.25f ? 0.0f : std::exp2(14.0f * u(1) - 8.0f);
        const glm::vec3 albedo(u(2), u(3), u(4));
        scene.set(i, extinction, albedo, extinction * glm::vec3(u(5), u(6), u(7)), cosine);
    }
    scene.lights.lights[0].place = glm::vec4(0.48f, 0.6f, -0.64f, 0.0f);
    scene.lights.lights[0].color = {5.0f, 3.0f, 2.0f, 0.0f};
    scene.lights.sky = {0.3f, 0.5f, 0.9f, 1.0f};
    scene.lights.ground = {0.2f, 0.1f, 0.1f, 0.0f};
    return scene;
}

/// The network on the processor for one color, after some sweeps from darkness.
struct Processor
{
    ScatteringNetwork network;
    NetworkState state;
    std::unique_ptr<base::TaskRunner> tasks = base::makeSerialRunner();

    Processor(const Scene& scene, size_t color)
    {
        NetworkGrid grid{glm::dvec3(scene.grid.corner), double(scene.grid.corner.w),
                         glm::ivec3(scene.grid.cells)};
        std::vector<float> extinction(scene.count()), albedo(scene.count()), emission(scene.count());
        for (size_t i = 0; i < scene.count(); ++i) {
            extinction[i] = scene.cells[4 * i + 3];
            if (extinction[i] > 0.0f) {
                albedo[i] = scene.scatter[4 * i + color] / extinction[i];
                emission[i] = scene.cells[4 * i + color] / extinction[i];
            }
        }
        EXPECT_TRUE(
            network.setMedium({grid, extinction, albedo, emission}, {26, 4, double(scene.scatter[3])}).ok());
        std::vector<float> outside;
        for (const NeighborDirection& d : network.directions()) {
            const float sky = scene.lights.sky[int(color)], ground = scene.lights.ground[int(color)];
            outside.push_back(d.step.y < 0 ? sky : d.step.y > 0 ? ground : 0.5f * (sky + ground));
        }
        EXPECT_TRUE(network.setEnvironment(outside).ok());
        auto sun = harmonics(-glm::dvec3(scene.lights.lights[0].place));
        for (double& moment : sun)
            moment *= double(scene.lights.lights[0].color[int(color)]);
        for (size_t i = 0; i < scene.count(); ++i)
            if (albedo[i] > 0.0f)
                network.addDirect(i, sun);
    }
    const std::vector<float>& swept(int sweeps)
    {
        SweepRules rules;
        rules.sweeps = sweeps;
        rules.acceleration = 0;
        network.sweep(rules, state, *tasks);
        return state.light;
    }
};

} // namespace

class NetworkPassesTest : public PostPass
{
protected:
    void begin(const Scene& scene) { begin(std::vector<Scene>{scene}); }
    /// Scenes whose grids lie above each other in the textures, in the light of the first.
    void begin(const std::vector<Scene>& scenes)
    {
        scene_ = scenes[0];
        grids_.clear();
        for (const Scene& scene : scenes) {
            const int layers = glowExtent(grids_).z;
            grids_.push_back(scene.grid);
            grids_.back().cells.w = layers;
        }
        volumes_.clear();
        const int blocks[][2] = {{1, 1},
                                 {1, 1},
                                 {kNetworkMedium, 1},
                                 {kNetworkMoments, 1},
                                 {kNetworkMoments, 1},
                                 {kNetworkMoments, 1},
                                 {kNetworkRays[0], kNetworkRays[1]}};
        block_ = glowExtent(grids_) + spare_;
        for (const auto& b : blocks) {
            auto made = GlTexture::createVolume(*device_, b[0] * block_.x, b[1] * block_.y, block_.z,
                                                glInternalFormat(Format::RGBA32F), "network");
            ASSERT_TRUE(made.ok()) << made.status().message();
            volumes_.push_back(std::move(*made));
        }
        for (size_t i = 0; i < scenes.size(); ++i)
            fill(scenes[i], i);
    }
    void fill(const Scene& scene, size_t grid = 0)
    {
        const glm::ivec4 cells = grids_[grid].cells;
        for (size_t texture : {0u, 1u})
            device_->gl.TextureSubImage3D(volumes_[texture].name(), 0, 0, 0, cells.w, cells.x, cells.y,
                                          cells.z, GL_RGBA, GL_FLOAT,
                                          (texture == 0 ? scene.cells : scene.scatter).data());
    }
    void sweep(int sweeps, bool prepares = true)
    {
        graph_->begin();
        NetworkPasses::Inputs in{};
        in.grids = importBytes(std::as_bytes(std::span(grids_)));
        in.lights = {.lights = importBytes(std::as_bytes(std::span(&scene_.lights, 1)))};
        if (!planes_.empty())
            in.lights.planes = importTexels(kPlaneColumns * kPlaneTexels,
                                            int(planes_.size()) / (2 * kPlaneColumns * kPlaneTexels),
                                            Format::RG32F, planes_);
        ResourceId* const ids[] = {&in.textures.cells,   &in.textures.scatter, &in.textures.medium,
                                   &in.textures.unswept, &in.textures.sources, &in.textures.moments,
                                   &in.textures.rays};
        const auto import = [&](const GlTexture& volume) {
            return graph_->importTexture({"network", volume.width(), volume.height(), Format::RGBA32F},
                                         volume.name());
        };
        for (size_t i = 0; i < volumes_.size(); ++i)
            *ids[i] = import(volumes_[i]);
        in.textures.before = before_.name() == 0 ? in.textures.moments : import(before_);
        in.block = block_;
        in.extent = glowExtent(grids_);
        in.mostLines = mostNetworkLines(grids_);
        in.gridCount = uint32_t(grids_.size());
        in.sweeps = sweeps;
        in.prepares = prepares;
        const NetworkTextures out = NetworkPasses::addTo(*graph_, in).textures;
        graph_->keep(out.sources);
        execute(out.moments);
    }
    std::vector<float> texels(size_t texture)
    {
        const GlTexture& v = volumes_[texture];
        return readTexture(*device_, v.name(), v.width(), v.height() * v.depth(), 4);
    }
    /// As NetworkState::light of one color.
    std::vector<float> light(size_t color, size_t grid = 0) { return ofColor(texels(5), color, grid); }
    std::vector<float> ofColor(const std::vector<float>& all, size_t color, size_t grid = 0) const
    {
        const glm::ivec4 cells = grids_[grid].cells;
        const size_t count = size_t(cells.x) * size_t(cells.y) * size_t(cells.z);
        std::vector<float> out(4 * count);
        for (size_t i = 0; i < count; ++i) {
            const size_t x = i % size_t(cells.x), y = i / size_t(cells.x) % size_t(cells.y);
            const size_t z = i / size_t(cells.x * cells.y) + size_t(cells.w);
            const size_t texel =
                x + size_t(block_.x) * (color + kNetworkMoments * (y + size_t(block_.y) * z));
            for (size_t k = 0; k < 4; ++k)
                out[k * count + i] = all[4 * texel + k];
        }
        return out;
    }

    /// [1] Largest difference of a moment of a cell to that of the processor, relative to the cell's light.
    double differenceToProcessor(const Scene& scene, int sweeps, size_t color, size_t grid = 0)
    {
        const std::vector<float> expected = Processor(scene, color).swept(sweeps);
        const std::vector<float> there = light(color, grid);
        double worst = 0.0, most = 0.0;
        for (size_t i = 0; i < scene.count(); ++i) {
            const float whole = expected[i]; // the moments of a cell are sums of the same lights
            most = std::max(most, double(whole));
            for (size_t k = 0; k < 4; ++k) {
                const size_t at = k * scene.count() + i;
                worst = std::max(worst, std::abs(double(there[at]) - double(expected[at])) / double(whole));
            }
        }
        EXPECT_GT(most, 0.1);
        return worst;
    }

    /// Light slices of a sun at +y over a medium whose optical depth below the top of the grid is depth(way
    /// [m]).
    template <class Depth>
    void shineFromAbove(Scene& io, Depth&& depth)
    {
        SliceLightBlock& sun = io.lights.lights[0];
        const float perMeter = 4.0f * kSide; // planes at the faces of half cells, and between them
        sun.along = {0.0f, -perMeter, 0.0f, 0.5f * perMeter};
        sun.right = {0.0f, 0.0f, 0.0f, 0.5f * kPlaneTexels};
        sun.up = sun.right;
        sun.tiles = {0.0f, 0.0f, float(kPlaneTexels), float(kPlanes)};
        const int width = kPlaneColumns * kPlaneTexels;
        planes_.assign(size_t(2 * width * kPlaneTexels * ((kPlanes - 1) / kPlaneColumns + 1)), 0.0f);
        for (int plane = 0; plane < kPlanes; ++plane)
            for (int y = 0; y < kPlaneTexels; ++y)
                for (int x = 0; x < kPlaneTexels; ++x) {
                    const int column = plane % kPlaneColumns * kPlaneTexels + x;
                    const int row = plane / kPlaneColumns * kPlaneTexels + y;
                    const float here = depth(float(plane) / perMeter);
                    planes_[size_t(2 * (row * width + column))] = here;
                    planes_[size_t(2 * (row * width + column) + 1)] =
                        depth(float(plane + 1) / perMeter) - here;
                }
    }

    static constexpr int kPlaneTexels = 4;
    static constexpr int kPlaneColumns = 8; ///< as shaders/shared/light_slices.glsl
    static constexpr int kPlanes = 4 * kSide + 1;
    Scene scene_;
    std::vector<FieldGlowBlock> grids_;
    glm::ivec3 block_{0}; ///< [texel] size of a block
    glm::ivec3 spare_{0}; ///< [texel] of a block that the grids do not take
    std::vector<GlTexture> volumes_;
    GlTexture before_;          ///< moments of the last frame, if not those of volumes_
    std::vector<float> planes_; ///< optical depths of the sun; empty: media cast no shadow
};

TEST(NetworkCellFormulas, areThoseOfTheirComment)
{
    for (double tau = 1e-12; tau < 1e12; tau *= 1.07) {
        const double taken = -std::expm1(-tau);
        double mean = 1.0 - taken / tau;
        if (tau < 1e-2)
            mean = tau * (0.5 - tau * (1.0 / 6.0 - tau * (1.0 / 24.0 - tau / 120.0)));
        const float t = float(tau);
        ASSERT_NEAR(formula64::fxNetworkMean(tau, std::exp(-tau)) / mean, 1.0, 5e-8) << tau;
        ASSERT_NEAR(formula64::fxNetworkTaken(tau, std::exp(-tau)) / taken, 1.0, 5e-8) << tau;
        ASSERT_NEAR(double(formula::fxNetworkMean(t, std::exp(-t))) / mean, 1.0, 5e-7) << tau;
        ASSERT_NEAR(double(formula::fxNetworkTaken(t, std::exp(-t))) / taken, 1.0, 5e-7) << tau;
    }
    for (double g = 0.0; g < 0.97; g += 0.01) {
        const double f = formula64::fxNetworkPeak(g);
        EXPECT_GE(1.0 - 3.0 * (g - f) / (1.0 - f), -1e-12) << "nowhere negative, at " << g;
        EXPECT_NEAR(f + (1.0 - f) * (g - f) / (1.0 - f), g, 1e-12) << "and the mean cosine is kept";
    }
}

TEST_F(NetworkPassesTest, haveTheLightOfTheProcessor)
{
    for (const float cosine : {0.0f, 0.5f, 0.8f, -0.2f})
        for (const int sweeps : {1, 4}) {
            const Scene scene = randomScene(uint64_t(17 + sweeps), cosine);
            begin(scene);
            sweep(sweeps);
            for (size_t color = 0; color < 3; ++color)
                EXPECT_LT(differenceToProcessor(scene, sweeps, color), 1e-5)
                    << "g " << cosine << ", sweeps " << sweeps << ", color " << color;
        }
}

TEST_F(NetworkPassesTest, gridsOfAnySidesHaveTheLightOfTheProcessor)
{
    const glm::ivec3 sides[] = {{8, 28, 12}, {20, 8, 8}, {12, 16, 36}, {8, 8, 8}};
    std::vector<Scene> scenes;
    for (size_t i = 0; i < std::size(sides); ++i) {
        scenes.push_back(randomScene(31 + i, 0.5f, sides[i]));
        scenes.back().grid.corner.w = 0.02f * float(i + 1);
    }
    for (const glm::ivec3& spare : {glm::ivec3(0), glm::ivec3(4, 8, 20)}) {
        spare_ = spare;
        begin(scenes);
        sweep(3);
        for (size_t i = 0; i < scenes.size(); ++i)
            for (size_t color = 0; color < 3; ++color)
                EXPECT_LT(differenceToProcessor(scenes[i], 3, color, i), 1e-5) << i << ", color " << color;
    }
}

TEST_F(NetworkPassesTest, emptyCellsAroundAMediumChangeNoLight)
{
    // A tall medium in its own grid and in a cube of cells of the same size.
    const glm::ivec3 sides(8, kSide, 12), corner(4, 0, 2);
    Scene tall = randomScene(41, 0.5f, sides);
    tall.lights.sky = tall.lights.ground = glm::vec4(0.0f); // empty cells would average it
    Scene cube;
    cube.lights = tall.lights;
    std::vector<size_t> places;
    for (size_t i = 0; i < tall.count(); ++i) {
        const glm::ivec3 cell =
            corner + glm::ivec3(int(i) % sides.x, int(i) / sides.x % sides.y, int(i) / (sides.x * sides.y));
        places.push_back(size_t(cell.x + kSide * (cell.y + kSide * cell.z)));
        std::copy_n(&tall.cells[4 * i], 4, &cube.cells[4 * places[i]]);
        std::copy_n(&tall.scatter[4 * i], 4, &cube.scatter[4 * places[i]]);
    }
    begin(tall);
    sweep(20);
    const std::vector<float> own = light(0);
    begin(cube);
    sweep(20);
    const std::vector<float> inCube = light(0);
    double most = 0.0;
    for (size_t i = 0; i < tall.count(); ++i) {
        for (size_t k = 0; k < 4; ++k)
            ASSERT_NEAR(own[k * tall.count() + i], inCube[k * kCount + places[i]], 1e-5f * own[i] + 1e-9f)
                << i << " " << k;
        most = std::max(most, double(own[i]));
    }
    EXPECT_GT(most, 0.1);
}

TEST_F(NetworkPassesTest, aWhiteMediumInARoomOfOneLightHasThatLight)
{
    for (const float cosine : {0.0f, 0.8f}) {
        Scene scene(cosine > 0.0f ? glm::ivec3(8, 28, 16) : glm::ivec3(kSide));
        const size_t count = scene.count();
        for (size_t i = 0; i < count; ++i)
            scene.set(i, float(i % 7) * 2.0f, glm::vec3(1.0f), glm::vec3(0.0f), cosine);
        scene.lights.sky = scene.lights.ground = {1.0f, 1.0f, 1.0f, 1.0f};
        begin(scene);
        sweep(400);
        const std::vector<float> there = light(1);
        for (size_t i = 0; i < count; ++i) {
            ASSERT_NEAR(there[i] / kRootSphere, 1.0f, 1e-4f) << cosine << " " << i;
            ASSERT_NEAR(there[count + i], 0.0f, 2e-4f) << "from all sides alike";
            const float seen = formula::fxNetworkSource(1.0f, cosine, there[i], there[2 * count + i]);
            ASSERT_NEAR(seen, 1.0f, 2e-4f) << "and so has the eye";
        }
    }
}

TEST_F(NetworkPassesTest, makeAndLoseNoLight)
{
    const Scene scene = randomScene(5, 0.5f);
    begin(scene);
    sweep(120);
    for (size_t color = 0; color < 3; ++color) {
        Processor processor(scene, color);
        const NetworkState state{processor.network.grid(), 4, light(color)};
        const NetworkEnergy energy = processor.network.energy(state, *processor.tasks);
        EXPECT_GT(energy.emitted, 0.1);
        EXPECT_NEAR((energy.absorbed + energy.escaped) / energy.emitted, 1.0, 1e-4);
    }
}

TEST_F(NetworkPassesTest, areNowhereNegative)
{
    for (const float cosine : {-0.3f, 0.33f, 0.5f, 0.9f}) {
        Scene scene = randomScene(9, cosine);
        for (size_t i = 0; i < kCount; ++i) // a beam of light in darkness: what series ring at
            for (size_t c = 0; c < 3; ++c)
                scene.cells[4 * i + c] *= i == kCount / 2 + kSide / 2 ? 1000.0f : 0.0f;
        scene.lights.sky = scene.lights.ground = glm::vec4(0.0f);
        begin(scene);
        for (int round = 0; round < 3; ++round) {
            sweep(2, round == 0);
            const std::vector<float> rays = texels(6);
            EXPECT_GE(*std::ranges::min_element(rays), 0.0f) << cosine;
            const std::vector<float> sources = ofColor(texels(4), 0);
            for (size_t i = 0; i < kCount; ++i) {
                const glm::vec3 first(sources[kCount + i], sources[2 * kCount + i], sources[3 * kCount + i]);
                ASSERT_LE(std::sqrt(3.0f * glm::dot(first, first)), sources[i] * 1.0001f + 1e-12f)
                    << "in no direction is a source below 0: " << cosine << " " << i;
            }
        }
    }
}

TEST_F(NetworkPassesTest, goOnFromTheLastSweep)
{
    begin(randomScene(3, 0.5f));
    sweep(2);
    sweep(3, false);
    const std::vector<float> inParts = texels(5);
    begin(randomScene(3, 0.5f));
    sweep(5);
    EXPECT_EQ(differentBits(inParts, texels(5)), 0u);
}

TEST_F(NetworkPassesTest, aGridThatMovesKeepsTheLightOfItsPlaces)
{
    Scene scene;
    for (size_t i = 0; i < kCount; ++i) {
        const glm::vec3 p(float(i % kSide), float(i / kSide % kSide), float(i / (kSide * kSide)));
        const bool isIn = glm::length(p - glm::vec3(8.0f)) < 5.0f;
        scene.set(i, isIn ? 40.0f : 0.0f, glm::vec3(0.95f), glm::vec3(0.0f), 0.0f);
    }
    scene.lights.lights[0].color = {5.0f, 5.0f, 5.0f, 0.0f};
    begin(scene);
    sweep(60);
    const std::vector<float> before = light(0);
    // The same medium in a grid that begins one cell further along x: its cells are those of before, moved.
    Scene moved = scene;
    moved.grid.before = scene.grid.corner;
    moved.grid.corner.x += moved.grid.corner.w;
    for (size_t i = 0; i < kCount; ++i)
        for (size_t c = 0; c < 4; ++c) {
            const bool isThere = i % kSide + 1 < size_t(kSide);
            moved.cells[4 * i + c] = isThere ? scene.cells[4 * (i + 1) + c] : 0.0f;
            moved.scatter[4 * i + c] = isThere ? scene.scatter[4 * (i + 1) + c] : 0.0f;
        }
    const auto error = [&](const std::vector<float>& after) {
        double difference = 0.0, sum = 0.0;
        for (size_t i = 0; i < kCount; ++i)
            if (moved.cells[4 * i + 3] > 0.0f) {
                difference += std::abs(double(after[i]) - double(before[i + 1]));
                sum += double(before[i + 1]);
            }
        return difference / sum;
    };
    moved.grid.cellsBefore = scene.grid.cells;
    before_ = std::move(volumes_[5]); // the light of before may be in textures of another size
    const auto sweptAnew = [&](const Scene& from) {
        begin(from);
        sweep(1);
        return error(light(0));
    };
    EXPECT_LT(sweptAnew(moved), 1e-3) << "a sweep from the light of before";
    spare_ = {4, 12, 8};
    EXPECT_LT(sweptAnew(moved), 1e-3) << "in wider blocks";
    moved.grid.before.w = 0.0f;
    EXPECT_GT(sweptAnew(moved), 0.1) << "from darkness";
}

TEST_F(NetworkPassesTest, aBeamLosesWhatTheCellsScatterAndAbsorb)
{
    // A layer that begins within a cell: of the light on a square meter it takes 1 - exp(-depth), however few
    // cells it has, and without the forward peak 1 - exp(-(1 - albedo f) depth).
    const float albedo = 0.9f, thickness = 0.45f; // [m]
    for (const float cosine : {0.0f, 0.85f})
        for (const float top : {0.25f, 0.25f + 0.5f / kSide, 0.25f + 0.25f / kSide})
            for (const float extinction : {1.0f, 10.0f, 60.0f, 300.0f}) {
                Scene scene;
                const auto depth = [&](float way) {
                    return extinction * std::clamp(way - top, 0.0f, thickness);
                };
                for (size_t i = 0; i < kCount; ++i) {
                    const int row = int(i / kSide % kSide); // from below
                    const float above = 1.0f - float(row + 1) / kSide;
                    const float inCell = depth(above + 1.0f / kSide) - depth(above);
                    scene.set(i, inCell * kSide, glm::vec3(albedo), glm::vec3(0.0f), cosine);
                }
                scene.lights.lights[0].color = {3.0f, 3.0f, 3.0f, 0.0f};
                shineFromAbove(scene, depth);
                begin(scene);
                sweep(1);
                const std::vector<float> first = ofColor(texels(3), 0); // not yet swept
                const double peak = formula64::fxNetworkPeak(double(cosine));
                const double straight = 1.0 - double(albedo) * peak;
                const double share = double(albedo) * (1.0 - peak) / straight;
                double lost = 0.0; // of a square meter: sources hold what cells scatter, per extinction
                for (size_t i = 0; i < kCount; ++i)
                    lost += double(first[i]) * double(kRootSphere) / share * double(scene.cells[4 * i + 3]) *
                            straight / double(kCount);
                const double expected = 3.0 * -std::expm1(-straight * double(extinction * thickness));
                // Parts without medium count by 1/1000 of the cell's: of 4.7 optical depths, half a part's.
                EXPECT_NEAR(lost / expected, 1.0, 3e-3)
                    << "g " << cosine << ", top " << top << " m, extinction " << extinction << "/m";
            }
}
