/// @file gas_stage.h
/// A gas for measurements and tests of the pair loops: particles with neighbor lists. Results are in the
/// order in which the particles were given.
#pragma once

#include "foundation/math/elementary.h"
#include "foundation/random/philox.h"
#include "foundation/simd/floating_point_scope.h"
#include "simulation/sph/pair_loops/concentration_loop.h"
#include "simulation/sph/pair_loops/force_loop.h"

#include <cmath>
#include <memory>
#include <numeric>
#include <vector>

namespace fx::bench {

using Gas = std::vector<sim::GasRecord<double>>;

/// A parcel of air at rest. All values are of the order of one, so that every term has an effect.
inline sim::GasRecord<double> parcel(double x, double y, double z, double support)
{
    return {x, y, z, support, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1, 0};
}

/// A random number in [0, 1) for each particle and purpose.
inline double chance(uint64_t seed, uint32_t i, uint32_t k)
{
    const auto u = base::randomUnit4(seed, k / 4, i, base::RandomPurpose::Position);
    return double(u[k % 4]);
}

/// A lattice of n^3 particles of spacing 1 / n in the unit cube, displaced by up to `jitter` spacings, with
/// mean density 1.
inline Gas latticeGas(uint32_t n, double jitter, double neighbors, uint64_t seed = 1)
{
    Gas gas;
    const double spacing = 1.0 / n;
    const double support = base::cubeRoot(3.0 * neighbors / (4.0 * 3.14159265358979323846)) * spacing;
    for (uint32_t i = 0; i < n * n * n; ++i) {
        const auto at = [&](uint32_t k, uint32_t axis) {
            return (k + 0.5 + jitter * (chance(seed, i, axis) - 0.5)) * spacing;
        };
        sim::GasRecord<double> p = parcel(at(i % n, 0), at(i / n % n, 1), at(i / n / n, 2), support);
        p.mass = spacing * spacing * spacing;
        gas.push_back(p);
    }
    return gas;
}

/// Sets a different state for every particle.
inline void stir(Gas& gas, uint64_t seed = 2)
{
    for (uint32_t i = 0; i < gas.size(); ++i) {
        sim::GasRecord<double>& p = gas[i];
        p.vx = chance(seed, i, 0) - 0.5;
        p.vy = chance(seed, i, 1) - 0.5;
        p.vz = chance(seed, i, 2) - 0.5;
        p.push = 0.5 + chance(seed, i, 3);
        p.density = 0.5 + chance(seed, i, 4);
        p.sound = 0.5 + chance(seed, i, 5);
        p.viscosity = 2.0 * chance(seed, i, 6);
        p.limiter = chance(seed, i, 7);
        p.energy = 0.5 + chance(seed, i, 8);
        p.pressure = 0.5 + chance(seed, i, 9);
        p.stepLevel = std::floor(20.0 * chance(seed, i, 10));
    }
}

inline sim::Domain unitBox(sim::AxisKind kind)
{
    sim::Domain box;
    box.axes = {kind, kind, kind};
    box.low = glm::dvec3(0.0);
    box.high = glm::dvec3(1.0);
    return box;
}

/// Columns of results. Element k of each column belongs to particle k in the order of creation.
template <class T>
struct Densities
{
    std::vector<T> support, density, correction, divergence, curl, exposure, expansion;
    std::vector<uint8_t> wantsReach;
    std::vector<uint32_t> neighbors;
};
template <class T>
struct Forces
{
    std::vector<T> ax, ay, az, heating, signalSpeed, fastestNeighbor;
    std::vector<uint32_t> pairs;
};

template <class T>
struct Concentrations
{
    std::vector<T> x, y, z, outwardX, outwardY, outwardZ;
};

template <class T>
class GasStage
{
public:
    explicit GasStage(const Gas& gas, const sim::Domain& domain = {}, double margin = 0.0,
                      uint32_t entriesPerParticle = 200)
        : domain_(domain), count_(uint32_t(gas.size())), tasks_(base::makeSerialRunner()),
          tree_(std::pmr::new_delete_resource(), count_),
          lists_(std::pmr::new_delete_resource(), count_, entriesPerParticle), records_(count_),
          places_(count_), particleOf_(count_)
    {
        const base::FloatingPointScope floatingPoint;
        for (auto& column : columns_)
            column.resize(count_);
        for (uint32_t i = 0; i < count_; ++i)
            fill(i, gas[i]);
        tree_.sort(points(), domain_, *tasks_);
        for (uint32_t place = 0; place < count_; ++place) {
            particleOf_[place] = tree_.order()[place];
            records_[place] = narrow(gas[particleOf_[place]]);
            fill(place, gas[particleOf_[place]]);
        }
        tree_.refit(points(), *tasks_);
        std::iota(places_.begin(), places_.end(), 0u);
        lists_.build(tree_, domain_, places_, T(margin), *tasks_);
    }

    Densities<T> densities(const sim::DensityRules& rules, double reach = 0.0) const
    {
        Densities<T> at = sized<Densities<T>>();
        for (uint32_t place = 0; place < count_; ++place)
            at.support[place] = records_[place].support;
        sumDensity(rules, reach, at);
        return inOrderGiven(at);
    }
    Forces<T> forces(const sim::ForceRules& rules) const
    {
        Forces<T> at = sized<Forces<T>>();
        sumForces(rules, at);
        return inOrderGiven(at);
    }

    Concentrations<T> concentration(double range) const
    {
        Concentrations<T> at = sized<Concentrations<T>>();
        const base::FloatingPointScope floatingPoint;
        sim::sumConcentration<T>({range,
                                  pairs(),
                                  {at.x.data(), at.y.data(), at.z.data(), at.outwardX.data(),
                                   at.outwardY.data(), at.outwardZ.data()}});
        return inOrderGiven(at);
    }

    /// Writes results into existing memory in the order of slots, for timing.
    void sumDensity(const sim::DensityRules& rules, double reach, Densities<T>& at) const
    {
        const base::FloatingPointScope floatingPoint;
        sim::sumDensity<T>({rules,
                            pairs(),
                            T(reach),
                            {at.support.data(), at.density.data(), at.correction.data(), at.divergence.data(),
                             at.curl.data(), at.wantsReach.data(), at.neighbors.data(), at.exposure.data(),
                             at.expansion.data()}});
    }
    void sumForces(const sim::ForceRules& rules, Forces<T>& at) const
    {
        const base::FloatingPointScope floatingPoint;
        sim::sumForces<T>({rules,
                           pairs(),
                           {at.ax.data(), at.ay.data(), at.az.data(), at.heating.data(),
                            at.signalSpeed.data(), at.fastestNeighbor.data(), at.pairs.data()}});
    }
    sim::PairSlots<T> pairs() const { return {lists_, records_.data(), domain_, places_}; }
    template <class Results>
    Results sized() const
    {
        Results at;
        eachColumn(at, [&](auto& column) { column.resize(count_); });
        return at;
    }
    uint32_t count() const { return count_; }
    uint64_t entries() const { return lists_.entries(); }
    std::vector<sim::GasRecord<T>>& records() { return records_; }

    /// The particles as the loops process them, rounded to T, in the given order.
    Gas seen() const
    {
        Gas gas(count_);
        for (uint32_t place = 0; place < count_; ++place)
            gas[particleOf_[place]] = widen(records_[place]);
        return gas;
    }

private:
    static sim::GasRecord<T> narrow(const sim::GasRecord<double>& p)
    {
        return {T(p.x),       T(p.y),      T(p.z),        T(p.support),  T(p.vx),    T(p.vy),
                T(p.vz),      T(p.mass),   T(p.push),     T(p.density),  T(p.sound), T(p.viscosity),
                T(p.limiter), T(p.energy), T(p.pressure), T(p.stepLevel)};
    }
    static sim::GasRecord<double> widen(const sim::GasRecord<T>& p)
    {
        return {p.x,    p.y,       p.z,     p.support,   p.vx,      p.vy,     p.vz,       p.mass,
                p.push, p.density, p.sound, p.viscosity, p.limiter, p.energy, p.pressure, p.stepLevel};
    }
    void fill(uint32_t i, const sim::GasRecord<double>& p)
    {
        columns_[0][i] = T(p.x);
        columns_[1][i] = T(p.y);
        columns_[2][i] = T(p.z);
        columns_[3][i] = T(p.support);
    }
    sim::PointColumns<T> points() const
    {
        return {columns_[0].data(), columns_[1].data(), columns_[2].data(), columns_[3].data(), count_};
    }
    template <class F>
    static void eachColumn(Densities<T>& d, F&& f)
    {
        f(d.support), f(d.density), f(d.correction), f(d.divergence), f(d.curl), f(d.exposure),
            f(d.expansion), f(d.wantsReach), f(d.neighbors);
    }
    template <class F>
    static void eachColumn(Forces<T>& r, F&& f)
    {
        f(r.ax), f(r.ay), f(r.az), f(r.heating), f(r.signalSpeed), f(r.fastestNeighbor), f(r.pairs);
    }
    template <class F>
    static void eachColumn(Concentrations<T>& r, F&& f)
    {
        f(r.x), f(r.y), f(r.z), f(r.outwardX), f(r.outwardY), f(r.outwardZ);
    }
    template <class Results>
    Results inOrderGiven(Results at) const
    {
        eachColumn(at, [&](auto& column) {
            auto moved = column;
            for (uint32_t place = 0; place < count_; ++place)
                moved[particleOf_[place]] = column[place];
            column = std::move(moved);
        });
        return at;
    }

    sim::Domain domain_;
    uint32_t count_;
    std::unique_ptr<base::TaskRunner> tasks_;
    sim::ParticleTree<T> tree_;
    sim::NeighborLists<T> lists_;
    std::vector<sim::GasRecord<T>> records_;
    std::vector<uint32_t> places_, particleOf_;
    std::vector<T> columns_[4];
};

} // namespace fx::bench
