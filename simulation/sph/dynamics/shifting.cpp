#include "simulation/sph/dynamics/shifting.h"

#include "foundation/math/elementary.h"
#include "foundation/tasks/parallel_rows.h"
#include "simulation/sph/dynamics/neighborhood.h"
#include "simulation/sph/pair_loops/concentration_loop.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fx::sim {

namespace {

constexpr double kRange = 1.15;      ///< [1] of the concentration, in spacings
constexpr uint32_t kPairBatch = 128; ///< slots of a task in loops over neighbors
constexpr uint32_t kRowBatch = 1024;

/// Lists of all particles where they are, which the last evaluation usually leaves behind.
template <class T>
void listNow(DynamicsState<T>& s, base::TaskRunner& tasks)
{
    if (s.mustRecoverTree)
        recoverTree(s, tasks);
    for (uint32_t i = 0; i < s.count; ++i) {
        s.active[i] = i;
        s.nowX[i] = s.gas.x[i];
        s.nowY[i] = s.gas.y[i];
        s.nowZ[i] = s.gas.z[i];
    }
    if (s.listState.valid)
        return;
    if (!s.treeIsSorted)
        sortParticles(s, tasks);
    searchNeighbors(s, s.active.first(s.count), 0.0, tasks);
}

/// What sums over neighbors read; the next prediction fills all of it.
template <class T>
void fillPlaces(DynamicsState<T>& s, base::TaskRunner& tasks)
{
    parallelRows(tasks, s.count, kRowBatch, [&s](uint32_t begin, uint32_t end) {
        for (uint32_t i = begin; i < end; ++i) {
            GasRecord<T>& record = s.records[i];
            record.x = s.gas.x[i];
            record.y = s.gas.y[i];
            record.z = s.gas.z[i];
            record.support = s.gas.support[i];
            record.mass = s.gas.mass[i];
        }
    });
}

/// (1) to (3) @param longest [m]
template <class T>
glm::vec<3, T> displacementOf(glm::vec<3, T> shift, const glm::vec<3, T>& outward, T exposure, T longest)
{
    const T square = glm::dot(outward, outward);
    if (square > 0)
        shift -= outward * (exposure * std::max(glm::dot(outward, shift), T(0)) / square); // (2)
    const T length = std::sqrt(glm::dot(shift, shift));
    return length > longest ? shift * (longest / length) : shift; // (3)
}

} // namespace

template <class T>
void shiftParticles(DynamicsState<T>& s, double strength, double longest, base::TaskRunner& tasks)
{
    using Vector = glm::vec<3, T>;
    if (s.fresh || s.count == 0)
        return;
    listNow(s, tasks);
    fillPlaces(s, tasks);
    const double perSupport = 1.0 / base::cubeRoot(3.0 * s.def.neighbors / (4.0 * std::numbers::pi));
    const T most = T(longest * perSupport);
    // Columns that the next evaluation fills before it reads them.
    const ConcentrationResults<T> sums{s.nowX.data(),    s.nowY.data(),        s.nowZ.data(),
                                       s.heating.data(), s.signalSpeed.data(), s.fastestNeighbor.data()};
    parallelRows(tasks, s.count, kPairBatch, [&](uint32_t begin, uint32_t end) {
        const std::span<const uint32_t> slots = s.active.first(s.count).subspan(begin, end - begin);
        sumConcentration<T>({std::min(kRange * perSupport, 1.0), s.pairsOf(slots), sums});
        for (uint32_t i = begin; i < end; ++i) {
            const Vector shift = displacementOf(T(strength) * Vector(sums.x[i], sums.y[i], sums.z[i]),
                                                Vector(sums.outwardX[i], sums.outwardY[i], sums.outwardZ[i]),
                                                s.gas.exposure[i], most * s.gas.support[i]);
            s.gas.x[i] += shift.x;
            s.gas.y[i] += shift.y;
            s.gas.z[i] += shift.z;
        }
    });
    s.activeCount = 0;
}

template void shiftParticles<float>(DynamicsState<float>&, double, double, base::TaskRunner&);
template void shiftParticles<double>(DynamicsState<double>&, double, double, base::TaskRunner&);

} // namespace fx::sim
