#include "rendering/reference/integral/ray_packet.h"

#include "foundation/simd/floating_point_scope.h"
#include "rendering/reference/integral/packet_job.h"

#include <algorithm>
#include <cmath>

namespace fx::render {

template <class T>
void RayPacket<T>::clear()
{
    center.clear();
    chord2.clear();
    shared.clear();
}

template <class T>
size_t RayPacket<T>::add(const Shared& blob)
{
    const size_t place = shared.size();
    shared.push_back(blob);
    center.resize(center.size() + kPacketRays, T(0));
    chord2.resize(chord2.size() + kPacketRays, T(0));
    return place;
}

base::Result<std::array<double, 3>> unitDirection(const std::array<double, 3>& direction)
{
    const auto [x, y, z] = direction;
    const double largest = std::max({std::fabs(x), std::fabs(y), std::fabs(z)});
    if (!(std::isfinite(x) && std::isfinite(y) && std::isfinite(z) && largest > 0.0))
        return base::Status{base::Code::InvalidArgument,
                            "a ray needs a direction: three finite numbers, not all 0"};
    // Squares of the scaled numbers neither overflow nor vanish.
    const double length = std::hypot(x / largest, y / largest, z / largest);
    return std::array<double, 3>{x / largest / length, y / largest / length, z / largest / length};
}

template <class T>
uint64_t meetBlobs(const PacketRays<T>& rays, std::span<const BallBlob<T>> balls,
                   std::span<const uint32_t> candidates, RayPacket<T>& packet)
{
    return integral::meetRays(integral::MeetJob<T>{rays, balls, candidates, packet});
}

template <class T>
class PacketIntegrator<T>::Machine
{
public:
    explicit Machine(const IntegralSettings& settings) : rules(settings) {}

    integral::GroupRules<T> rules;
    integral::GroupScratch<T> scratch;
    integral::MetBlobs<T> met;
    RayWork work;
    bool isCounting = false;
};

template <class T>
PacketIntegrator<T>::PacketIntegrator(const IntegralSettings& settings)
    : machine_(std::make_unique<Machine>(settings))
{}
template <class T>
PacketIntegrator<T>::~PacketIntegrator() = default;
template <class T>
PacketIntegrator<T>::PacketIntegrator(PacketIntegrator&&) noexcept = default;
template <class T>
PacketIntegrator<T>& PacketIntegrator<T>::operator=(PacketIntegrator&&) noexcept = default;

template <class T>
void PacketIntegrator<T>::integrate(const PacketRays<T>& rays, const RayPacket<T>& packet,
                                    PacketLight<T>& outLight)
{
    const base::FloatingPointScope mode;
    RayWork* work = machine_->isCounting ? &machine_->work : nullptr;
    integral::integrateRays(integral::PacketJob<T>{machine_->rules, machine_->scratch, machine_->met, rays,
                                                   packet, work, outLight});
}

template <class T>
void PacketIntegrator<T>::countWork(bool isOn)
{
    machine_->isCounting = isOn;
}
template <class T>
const RayWork& PacketIntegrator<T>::work() const
{
    return machine_->work;
}
template <class T>
void PacketIntegrator<T>::clearWork()
{
    machine_->work = {};
}

template struct RayPacket<float>;
template struct RayPacket<double>;
template class PacketIntegrator<float>;
template class PacketIntegrator<double>;
template uint64_t meetBlobs(const PacketRays<float>&, std::span<const BallBlob<float>>,
                            std::span<const uint32_t>, RayPacket<float>&);
template uint64_t meetBlobs(const PacketRays<double>&, std::span<const BallBlob<double>>,
                            std::span<const uint32_t>, RayPacket<double>&);

} // namespace fx::render
