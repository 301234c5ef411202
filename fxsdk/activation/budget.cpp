#include "fxsdk/activation/budget.h"

#include <algorithm>

namespace fx::activation {

namespace {

bool goesFirst(const Candidate& a, const Candidate& b)
{
    if (a.must != b.must)
        return a.must;
    const double sa = a.significance * (a.runs ? kReluctance : 1.0);
    const double sb = b.significance * (b.runs ? kReluctance : 1.0);
    return sa != sb ? sa > sb : a.serial < b.serial;
}

} // namespace

void share(const Budget& budget, double nanosecondsPerParticle, std::span<Candidate> candidates)
{
    std::sort(candidates.begin(), candidates.end(), goesFirst); // total: serials differ
    uint64_t particles = 0;
    uint64_t bytes = 0;
    bool isFirst = true;
    for (Candidate& candidate : candidates) {
        const uint64_t most = particles + candidate.particles;
        const uint64_t memory = bytes + candidate.bytes;
        const bool fits = (budget.particles == 0 || most <= budget.particles) &&
                          (budget.bytes == 0 || memory <= budget.bytes) &&
                          (!(budget.milliseconds > 0) ||
                           double(most) * nanosecondsPerParticle * 1e-6 <= budget.milliseconds);
        candidate.granted = candidate.must || isFirst || fits;
        isFirst = false;
        if (!candidate.granted)
            continue;
        particles = most;
        bytes = memory;
    }
}

} // namespace fx::activation
