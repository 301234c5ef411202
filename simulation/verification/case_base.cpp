#include "simulation/verification/case_base.h"

#include <glm/geometric.hpp>

namespace fx::sim {

CaseBase::CaseBase(const CaseSettings& settings, double gamma, double time)
    : gamma_(settings.gamma > 0 ? settings.gamma : gamma), time_(settings.time > 0 ? settings.time : time),
      ownTime_(gamma_ == gamma && time_ == time), def_(settings.rules)
{
    def_.state = {};
    def_.state.gamma = gamma_;
    def_.domain = {};
}

void CaseBase::finish(uint32_t sampleCount)
{
    def_.capacity = uint32_t(particles_.size());
    for (uint32_t k = 1; k <= sampleCount; ++k)
        sampleTimes_.push_back(k == sampleCount ? time_ : time_ * k / sampleCount);
}

ProfilePoint CaseBase::seen(const CaseParticle& particle) const
{
    const double r = glm::length(particle.position);
    const double v = r > 0 ? glm::dot(particle.velocity, particle.position) / r : 0;
    return {r, particle.mass, {particle.density, v, particle.pressure}};
}

} // namespace fx::sim
