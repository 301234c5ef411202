/// @file ray_integrator-inl.h
/// Implementation of RayIntegrator. For number types other than float and double, integral::Real<T> must be
/// specialized before this file is included.
#pragma once

#include "foundation/simd/floating_point_scope.h"
#include "rendering/reference/integral/group_scratch.h"
#include "rendering/reference/integral/lane_numbers.h"
#include "rendering/reference/integral/ray_integrator.h"

#include <hwy/base.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace fx::render::integral {
// These files must be included in this order.
// clang-format off
#include "rendering/reference/integral/blob_sums.inl"
#include "rendering/reference/integral/interval_walk.inl"
#include "rendering/reference/integral/moments.inl"
#include "rendering/reference/integral/part_rules.inl"
#include "rendering/reference/integral/interval_rules.inl"
#include "rendering/reference/integral/ray_rules.inl"
// clang-format on
} // namespace fx::render::integral

namespace fx::render {

template <class T>
class RayIntegrator<T>::Machine
{
public:
    explicit Machine(const IntegralSettings& settings) : rules_(settings) {}

    RayLight<T> integrate(std::span<const RayBlob<T>> blobs, const RayWindow<T>& window)
    {
        RayLight<T> light{{T(0), T(0), T(0)}, T(0), T(1), kRayInvalid};
        if (!isValid(window))
            return {{T(0), T(0), T(0)}, T(0), T(0), kRayInvalid};
        met_.clear();
        T largest = T(0), brightest = T(0);
        for (const RayBlob<T>& blob : blobs) {
            if (!isValid(blob))
                return {{T(0), T(0), T(0)}, T(0), T(0), kRayInvalid};
            largest = largest < blob.radius ? blob.radius : largest;
            for (const T source : blob.source)
                brightest = brightest < source ? source : brightest;
            if (blob.chord2 > T(0))
                met_.push_back(blob);
        }
        std::sort(met_.begin(), met_.end(),
                  [](const RayBlob<T>& a, const RayBlob<T>& b) { return a.id < b.id; });
        center_.clear();
        chord2_.clear();
        for (const RayBlob<T>& blob : met_) {
            center_.push_back(blob.center);
            chord2_.push_back(blob.chord2);
        }
        const T* background = window.background.data();
        const integral::GroupInput<T> input{uint32_t(met_.size()),
                                            1,
                                            largest,
                                            brightest,
                                            center_.data(),
                                            chord2_.data(),
                                            &window.nearest,
                                            &window.farthest,
                                            {background, background + 1, background + 2}};
        const integral::GroupOutput<T> output{{&light.radiance[0], &light.radiance[1], &light.radiance[2]},
                                              &light.opticalDepth,
                                              &light.transmittance,
                                              &light.flags};
        const base::FloatingPointScope mode;
        integral::integrateAny<T>(rules_, scratch_, input, met_.data(), &work_, output);
        return light;
    }

    RayWork work_;

private:
    static bool isFinite(T x) { return x - x == T(0); }
    static bool isAmount(T x) { return isFinite(x) && x >= T(0); }
    static bool isValid(const RayBlob<T>& blob)
    {
        return isFinite(blob.center) && isFinite(blob.chord2) && isFinite(blob.radius) &&
               blob.radius > T(0) && isAmount(blob.extinction) && isAmount(blob.source[0]) &&
               isAmount(blob.source[1]) && isAmount(blob.source[2]);
    }
    static bool isValid(const RayWindow<T>& window)
    {
        return isFinite(window.nearest) && window.farthest == window.farthest &&
               isAmount(window.background[0]) && isAmount(window.background[1]) &&
               isAmount(window.background[2]);
    }

    integral::GroupRules<T> rules_;
    integral::GroupScratch<T> scratch_;
    std::vector<RayBlob<T>> met_;
    std::vector<T> center_, chord2_;
};

template <class T>
RayIntegrator<T>::RayIntegrator(const IntegralSettings& settings)
    : machine_(std::make_unique<Machine>(settings))
{}
template <class T>
RayIntegrator<T>::~RayIntegrator() = default;
template <class T>
RayIntegrator<T>::RayIntegrator(RayIntegrator&&) noexcept = default;
template <class T>
RayIntegrator<T>& RayIntegrator<T>::operator=(RayIntegrator&&) noexcept = default;

template <class T>
RayLight<T> RayIntegrator<T>::integrate(std::span<const RayBlob<T>> blobs, const RayWindow<T>& window)
{
    return machine_->integrate(blobs, window);
}
template <class T>
const RayWork& RayIntegrator<T>::work() const
{
    return machine_->work_;
}
template <class T>
void RayIntegrator<T>::clearWork()
{
    machine_->work_ = {};
}

} // namespace fx::render
