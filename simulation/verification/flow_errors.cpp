#include "simulation/verification/flow_errors.h"

#include <algorithm>
#include <cmath>

namespace fx::sim {

void FlowErrors::add(const ProfilePoint& point, const FlowState& exact)
{
    const double volume = point.mass / point.state.density;
    volume_ += volume;
    densities_.push_back({volume, point.state.density - exact.density});
    sum_.density += volume * std::abs(point.state.density - exact.density);    // (1)
    sum_.velocity += volume * std::abs(point.state.velocity - exact.velocity); // (1)
    sum_.pressure += volume * std::abs(point.state.pressure - exact.pressure); // (1)
}

void FlowErrors::store(const FlowState& units, CaseMeasures& out) const
{
    out.l1Density = sum_.density / (volume_ * units.density);
    out.l1Velocity = sum_.velocity / (volume_ * units.velocity);
    out.l1Pressure = sum_.pressure / (volume_ * units.pressure);
    out.densityErrors = densities_;
    for (DensityError& density : out.densityErrors)
        density.error /= units.density;
}

std::vector<Shell> shellsOf(std::span<const ProfilePoint> points, double width)
{
    double farthest = 0;
    for (const ProfilePoint& point : points)
        farthest = std::max(farthest, point.place);
    std::vector<Shell> shells(size_t(farthest / width) + 1);
    for (size_t k = 0; k < shells.size(); ++k)
        shells[k].place = (double(k) + 0.5) * width;
    for (const ProfilePoint& point : points) {
        Shell& shell = shells[size_t(std::max(0.0, point.place) / width)];
        ++shell.count;
        shell.state.density += point.state.density;
        shell.state.velocity += point.state.velocity;
        shell.state.pressure += point.state.pressure;
    }
    for (Shell& shell : shells) {
        const double share = shell.count > 0 ? 1.0 / shell.count : 0;
        shell.state = {share * shell.state.density, share * shell.state.velocity,
                       share * shell.state.pressure};
    }
    return shells;
}

double shockRadius(std::span<const Shell> shells, double densityAhead)
{
    size_t top = 0;
    for (size_t k = 0; k < shells.size(); ++k)
        top = shells[k].state.density > shells[top].state.density ? k : top;
    if (shells.empty() || shells[top].state.density <= densityAhead)
        return 0;
    const double half = 0.5 * (densityAhead + shells[top].state.density); // (2)
    size_t last = top;
    for (size_t k = top; k < shells.size(); ++k)
        last = shells[k].state.density > half ? k : last;
    size_t next = last + 1;
    while (next < shells.size() && shells[next].count == 0)
        ++next;
    if (next >= shells.size())
        return shells[last].place;
    const double above = shells[last].state.density;
    const double below = shells[next].state.density;
    return shells[last].place + (shells[next].place - shells[last].place) * (above - half) / (above - below);
}

double densestRadius(std::span<const Shell> shells)
{
    size_t top = 0;
    for (size_t k = 0; k < shells.size(); ++k)
        top = shells[k].state.density > shells[top].state.density ? k : top;
    if (top == 0 || top + 1 >= shells.size())
        return shells.empty() ? 0 : shells[top].place;
    const double below = shells[top].state.density - shells[top - 1].state.density;
    const double above = shells[top].state.density - shells[top + 1].state.density;
    const double width = shells[top].place - shells[top - 1].place;
    return shells[top].place + 0.5 * width * (below - above) / (below + above); // (3)
}

std::vector<ProfilePoint> profileOf(const GasCase& gasCase, std::span<const CaseParticle> particles)
{
    std::vector<ProfilePoint> points;
    points.reserve(particles.size());
    for (const CaseParticle& particle : particles)
        points.push_back(gasCase.seen(particle));
    return points;
}

void storeErrors(std::span<const ProfilePoint> points, double radius, const FlowState& units,
                 const std::function<FlowState(double place)>& exact, CaseMeasures& out)
{
    FlowErrors errors;
    for (const ProfilePoint& point : points) {
        if (point.place < radius)
            errors.add(point, exact(point.place));
    }
    errors.store(units, out);
}

} // namespace fx::sim
