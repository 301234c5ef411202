/// @file ray_integrator.h
/// Computes the light along one ray through overlapping blobs. For many rays, ray_packet.h is faster and
/// gives the same bits.
#pragma once

#include "rendering/reference/integral/integral_scheme.h"
#include "rendering/reference/integral/ray_records.h"

#include <memory>
#include <span>

namespace fx::render {

/// Integrates single rays. Memory is reused for the next ray. Each thread needs its own object. T is float or
/// double; tests instantiate ray_integrator-inl.h for __float128.
template <class T>
class RayIntegrator
{
public:
    explicit RayIntegrator(const IntegralSettings& settings);
    ~RayIntegrator();
    RayIntegrator(RayIntegrator&&) noexcept;
    RayIntegrator& operator=(RayIntegrator&&) noexcept;

    /// Computes light, optical depth and transmittance of a ray. The result does not depend on the order of
    /// `blobs`, bit for bit.
    RayLight<T> integrate(std::span<const RayBlob<T>> blobs, const RayWindow<T>& window);

    const RayWork& work() const;
    void clearWork();

private:
    class Machine;
    std::unique_ptr<Machine> machine_;
};

extern template class RayIntegrator<float>;
extern template class RayIntegrator<double>;

} // namespace fx::render
