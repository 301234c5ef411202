#include "rendering/reference/integral/packet_job.h"
#include "rendering/reference/integral/ray_integrator-inl.h"

namespace fx::render {

namespace integral {

template <class T>
void integrateOneByOne(const PacketJob<T>& job)
{
    const T largest = largestRadius(job.packet);
    const T brightest = brightestSource(job.packet);
    for (uint32_t lane = 0; lane < kPacketRays; ++lane)
        integrateAny<T>(job.rules, job.scratch, inputOf(job, lane, largest, brightest),
                        job.packet.shared.data(), job.work, outputOf(job, lane));
}

template void integrateOneByOne(const PacketJob<float>&);
template void integrateOneByOne(const PacketJob<double>&);

} // namespace integral

template class RayIntegrator<float>;
template class RayIntegrator<double>;

} // namespace fx::render
