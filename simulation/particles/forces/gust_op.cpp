/// @formula gust-noise
/// A random function of time that is smooth and the same for any step.
///
/// symbol   unit   meaning
///   s       1      time in periods
///   i, f    1      floor(s) and s - floor(s)
///   gi      1      random numbers at whole s, uniform in [-1, 1)
///   w       1      fade, 6 f^5 - 15 f^4 + 10 f^3
/// @derivation
///   n(s) = gi + w (g(i+1) - gi)                                                             (1)
///   Gusts take it at the middle of the step, where a value that stands for the step belongs (2)
/// @source    [PER02] for the fade
/// @deviation values instead of gradients at the nodes, so that the bound is exact
/// @valid     |s| < 2^52
/// @accuracy  |n| <= 1; n has a continuous second derivative
/// @tests     tests/simulation/particles/modules/test_forces.cpp
#include "foundation/random/philox.h"
#include "simulation/particles/forces/force_ops.h"
#include "simulation/particles/gpu_module_source.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <bit>
#include <cmath>

namespace fx::sim {

namespace {

class GustOp final : public TileOp, public GpuModuleSource
{
public:
    explicit GustOp(const GustDef& def) : def_(def) {}

    TileBound bound() const override { return {0.0f, glm::length(def_.strength), false}; }
    TilePhase phase() const override { return TilePhase::Force; }
    bool describe(base::GpuModules& out) const override
    {
        out.add(base::GpuModule::Gust, {}, 3);
        return true;
    }
    void writeWords(const void* scratch, uint32_t* out) const override
    {
        for (int axis = 0; axis < 3; ++axis)
            out[axis] = std::bit_cast<uint32_t>((*static_cast<const glm::vec3*>(scratch))[axis]);
    }
    size_t scratchBytes() const override { return sizeof(glm::vec3); }
    void prepare(const TileContext& context, void* scratch) const override
    {
        const double middle = context.begin + 0.5 * double(context.seconds); // (2)
        const double phase = middle / double(std::max(def_.period, 1e-3f));
        glm::vec3& air = *static_cast<glm::vec3*>(scratch);
        for (int axis = 0; axis < 3; ++axis)
            air[axis] =
                def_.strength[axis] * gustNoise(context.step.seed, context.step.solverIndex, phase, axis);
    }
    void run(const TileContext&, const void* scratch, Tile& tile) const override
    {
        const glm::vec3 air = *static_cast<const glm::vec3*>(scratch);
        for (uint32_t i = 0; i < tile.padded; ++i) {
            tile.ux[i] += air.x;
            tile.uy[i] += air.y;
            tile.uz[i] += air.z;
        }
    }

private:
    GustDef def_;
};

class QuadraticDragOp final : public TileOp, public GpuModuleSource
{
public:
    explicit QuadraticDragOp(float coefficient) : coefficient_(std::max(coefficient, 0.0f)) {}

    TileBound bound() const override { return {0.0f, 0.0f, coefficient_ > 0.0f}; }
    TilePhase phase() const override { return TilePhase::Force; }
    bool describe(base::GpuModules& out) const override
    {
        if (coefficient_ > 0.0f)
            out.add(base::GpuModule::QuadraticDrag, {coefficient_});
        return true;
    }
    void run(const TileContext&, const void*, Tile& tile) const override
    {
        for (uint32_t i = 0; i < tile.padded; ++i)
            tile.quadratic[i] += coefficient_;
    }

private:
    float coefficient_;
};

float nodeValue(uint64_t seed, uint32_t solverIndex, int64_t node, int axis)
{
    const std::array<float, 4> numbers =
        base::randomUnit4(seed, solverIndex, uint64_t(node), base::RandomPurpose::Gusts);
    return 2.0f * numbers[size_t(axis)] - 1.0f;
}

} // namespace

float gustNoise(uint64_t seed, uint32_t solverIndex, double phase, int axis)
{
    const double low = std::floor(phase);
    const float f = float(phase - low);
    const float w = f * f * f * (f * (f * 6.0f - 15.0f) + 10.0f);
    const float a = nodeValue(seed, solverIndex, int64_t(low), axis);
    const float b = nodeValue(seed, solverIndex, int64_t(low) + 1, axis);
    return a + w * (b - a); // (1)
}

std::unique_ptr<TileOp> makeGustOp(const GustDef& def)
{
    return std::make_unique<GustOp>(def);
}

std::unique_ptr<TileOp> makeQuadraticDragOp(float coefficient)
{
    return std::make_unique<QuadraticDragOp>(coefficient);
}

} // namespace fx::sim
