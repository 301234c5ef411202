/// @file neighbor_stage.h
/// Clouds of particles, and a reference search for neighbors over all pairs.
#pragma once

#include "foundation/random/philox.h"
#include "foundation/simd/floating_point_scope.h"
#include "simulation/sph/neighbors/neighbor_lists.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <vector>

namespace fx::test {

template <class T>
struct Cloud
{
    std::vector<T> x, y, z, support;

    uint32_t count() const { return uint32_t(x.size()); }
    sim::PointColumns<T> columns() const { return {x.data(), y.data(), z.data(), support.data(), count()}; }
    void add(double px, double py, double pz, double h)
    {
        x.push_back(T(px));
        y.push_back(T(py));
        z.push_back(T(pz));
        support.push_back(T(h));
    }
    /// Adds random particles, uniform in [low, low + extent)^3, with supports uniform in [least, most).
    void addRandom(uint32_t particles, uint64_t seed, double low, double extent, double least, double most)
    {
        for (uint32_t i = 0; i < particles; ++i) {
            const auto u = base::randomUnit4(seed, 0, i, base::RandomPurpose::Position);
            add(low + extent * double(u[0]), low + extent * double(u[1]), low + extent * double(u[2]),
                least + (most - least) * double(u[3]));
        }
    }
    /// Adds `edge`^3 particles of a lattice with the spacing `spacing`, x fastest.
    void addLattice(uint32_t edge, double low, double spacing, double h)
    {
        for (uint32_t k = 0; k < edge; ++k)
            for (uint32_t j = 0; j < edge; ++j)
                for (uint32_t i = 0; i < edge; ++i)
                    add(low + spacing * i, low + spacing * j, low + spacing * k, h);
    }
    Cloud reordered(std::span<const uint32_t> order) const
    {
        Cloud out;
        for (const uint32_t i : order)
            out.add(double(x[i]), double(y[i]), double(z[i]), double(support[i]));
        return out;
    }
};

/// A cloud whose particles are in the order of its tree, with neighbor lists of the owners.
template <class T>
struct Searched
{
    Cloud<T> cloud;
    sim::Domain domain;
    T margin;
    std::unique_ptr<sim::ParticleTree<T>> tree;
    std::unique_ptr<sim::NeighborLists<T>> lists;
    std::vector<uint32_t> owners;

    std::vector<uint32_t> list(uint32_t slot) const
    {
        std::vector<uint32_t> entries;
        bool ended = false;
        lists->forEachPiece(slot, [&](const uint32_t* piece, uint32_t count, bool last) {
            EXPECT_FALSE(ended) << "a piece after the last";
            EXPECT_TRUE(last || count % sim::kLanes == 0);
            for (uint32_t k = count; k % sim::kLanes != 0; ++k)
                EXPECT_EQ(piece[k], slot) << "padding";
            entries.insert(entries.end(), piece, piece + count);
            ended = last;
        });
        EXPECT_TRUE(ended);
        return entries;
    }
};

inline std::vector<uint32_t> everyone(uint32_t count)
{
    std::vector<uint32_t> owners(count);
    std::iota(owners.begin(), owners.end(), 0u);
    return owners;
}

/// Special value for a number of threads. Loops then run serially in the shortest allowed ranges, the last
/// range first.
constexpr uint32_t kBackwards = ~0u;

inline std::unique_ptr<base::TaskRunner> runner(uint32_t threads)
{
    if (threads == kBackwards)
        return base::makeHostRunner(
            {nullptr, [](void*, uint32_t count, uint32_t minBatch, base::LoopBody body, void* argument) {
                 for (uint32_t begin = (count - 1) / minBatch * minBatch;; begin -= minBatch) {
                     body(argument, begin, std::min(count, begin + minBatch));
                     if (begin == 0)
                         return;
                 }
             }});
    return threads == 1 ? base::makeSerialRunner() : base::makeTbbRunner(threads);
}

struct SearchOptions
{
    double margin = 0.125;
    uint32_t entriesPerParticle = 512;
    uint32_t threads = 1;
    std::vector<uint32_t> owners = {}; ///< owners of lists; empty: all particles
};

template <class T>
Searched<T> searched(const Cloud<T>& cloud, const sim::Domain& domain, const SearchOptions& options = {})
{
    auto* const memory = std::pmr::get_default_resource();
    Searched<T> s;
    s.domain = domain;
    s.margin = T(options.margin);
    s.tree = std::make_unique<sim::ParticleTree<T>>(memory, cloud.count());
    s.lists = std::make_unique<sim::NeighborLists<T>>(memory, cloud.count(), options.entriesPerParticle);
    const auto tasks = runner(options.threads);
    s.tree->sort(cloud.columns(), domain, *tasks);
    s.cloud = cloud.reordered(s.tree->order());
    s.tree->refit(s.cloud.columns(), *tasks);
    s.owners = options.owners.empty() ? everyone(cloud.count()) : options.owners;
    s.lists->build(*s.tree, domain, s.owners, s.margin, *tasks);
    return s;
}

/// [m2] Squared distance of particle i from the image of particle j that is mirrored on the axes of
/// `mirrors`; infinite if there is no wall. The function does not use the tested code.
template <class T>
T distance2(const Cloud<T>& cloud, const sim::Domain& domain, uint32_t i, uint32_t j, uint32_t mirrors)
{
    const std::vector<T>* const axes[3] = {&cloud.x, &cloud.y, &cloud.z};
    T d2 = 0;
    for (uint32_t a = 0; a < 3; ++a) {
        const T xi = (*axes[a])[i];
        const T xj = (*axes[a])[j];
        const T low = T(domain.low[int(a)]);
        const T high = T(domain.high[int(a)]);
        T d = xi - xj;
        if (domain.axes[a] == sim::AxisKind::Periodic) {
            const T length = T(domain.high[int(a)] - domain.low[int(a)]);
            d -= length * std::nearbyint(d * (T(1) / length));
        }
        if ((mirrors >> a & 1) != 0) {
            const T wall = xi - low <= high - xi ? low : high;
            const bool real = domain.axes[a] == sim::AxisKind::Reflecting && std::isfinite(wall);
            d = real ? (xi - wall) + (xj - wall) : std::numeric_limits<T>::infinity();
        }
        d2 += d * d;
    }
    return d2;
}

/// Entries of the list of slot `i`, in the order of lists. The function tests all particles and all images.
template <class T>
std::vector<uint32_t> trialOfAll(const Cloud<T>& cloud, const sim::Domain& domain, T margin, uint32_t i)
{
    std::vector<uint32_t> entries;
    for (uint32_t mirrors = 0; mirrors < 8; ++mirrors)
        for (uint32_t j = 0; j < cloud.count(); ++j) {
            const T reach = (T(1) + margin) * std::max(cloud.support[i], cloud.support[j]);
            const bool isOther = mirrors != 0 || i != j;
            if (isOther && distance2(cloud, domain, i, j, mirrors) < reach * reach)
                entries.push_back(j | mirrors * sim::kMirrorX);
        }
    return entries;
}

/// Compares the list of every `stride`th owner with the result of trialOfAll().
template <class T>
void expectTrialOfAll(const Searched<T>& s, uint32_t stride = 1)
{
    for (size_t k = 0; k < s.owners.size(); k += stride) {
        const uint32_t slot = s.owners[k];
        ASSERT_EQ(s.list(slot), trialOfAll(s.cloud, s.domain, s.margin, slot)) << "place " << slot;
    }
}

} // namespace fx::test
