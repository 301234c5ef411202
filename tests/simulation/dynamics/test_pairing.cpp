#include "tests/simulation/dynamics/gas_stage.h"

#include <gtest/gtest.h>

using namespace fx;
using namespace fx::test;
using namespace fx::sim;

namespace {

/// Median distance to the nearest neighbor over the spacing, after a disturbed lattice has been damped for
/// `times` of h / c.
double nearestOverSpacing(SphKernel kernel, double neighbors, double times)
{
    constexpr uint32_t n = 9;
    GasDynamicsDef def = periodicBox(n);
    def.kernel = kernel;
    def.neighbors = neighbors;
    std::vector<GasParticle> particles = lattice(n, 0.9);
    uint64_t random = 7;
    for (GasParticle& particle : particles)
        for (int a = 0; a < 3; ++a) {
            random = random * 6364136223846793005u + 1442695040888963407u;
            particle.position[a] += 0.2 / n * (double(random >> 40) / double(1 << 24) - 0.5);
        }
    GasStage<float> stage(def, particles);
    const double unit = 0.5 * stage.gas.supportOf(0); // h / c with c = 1
    for (int i = 0; i < int(2 * times); ++i) {
        stage.advance(0.5 * unit);
        const GasView<float> view = stage.gas.view();
        for (uint32_t k = 0; k < view.count; ++k) {
            view.vx[k] *= 0.8f;
            view.vy[k] *= 0.8f;
            view.vz[k] *= 0.8f;
            stage.gas.setEnergy(view.id[k], 0.9);
        }
        stage.gas.edited();
    }
    std::vector<double> nearest;
    const GasView<float> view = stage.gas.view();
    for (uint32_t i = 0; i < view.count; ++i) {
        double least = 1;
        for (uint32_t j = 0; j < view.count; ++j) {
            glm::dvec3 d(view.x[i] - view.x[j], view.y[i] - view.y[j], view.z[i] - view.z[j]);
            for (int a = 0; a < 3; ++a)
                d[a] -= std::round(d[a]);
            if (i != j)
                least = std::min(least, length(d));
        }
        nearest.push_back(least * n);
    }
    std::sort(nearest.begin(), nearest.end());
    return nearest[nearest.size() / 2];
}

} // namespace

TEST(Pairing, particlesKeepTheirDistance)
{
    EXPECT_GE(nearestOverSpacing(SphKernel::WendlandC2, 58, 15), 0.85);
    EXPECT_GE(nearestOverSpacing(SphKernel::WendlandC4, 110, 15), 0.85);
    EXPECT_GE(nearestOverSpacing(SphKernel::CubicSpline, 40, 15), 0.85);
}

TEST(Pairing, forcesOfThePaperKernelLetParticlesFallTogether)
{
    EXPECT_LT(nearestOverSpacing(SphKernel::Quartic, 58, 15), 0.5);
}
