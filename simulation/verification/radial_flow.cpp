#include "simulation/verification/radial_flow.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fx::sim {
namespace {

constexpr double kCourant = 0.4;
constexpr double kMinPressure = 1e-300; ///< [Pa]

double limited(double a, double b)
{
    if (a * b <= 0)
        return 0;
    const double sign = a > 0 ? 1 : -1;
    return sign * std::min({2 * std::abs(a), 2 * std::abs(b), 0.5 * std::abs(a + b)});
}

/// Pressure (4) on a side and its derivative by d.
struct Response
{
    double pressure;
    double slope;
};

Response respond(const FlowState& side, double d, double gamma)
{
    const double a = 0.25 * (gamma + 1);
    const double sound2 = gamma * side.pressure / side.density;
    const double root = std::sqrt(a * a * d * d + sound2);
    const double pressure = side.pressure + side.density * d * (a * d + root); // (4)
    const double slope =
        side.density * (2 * a * d + root + a * a * d * d / std::max(root, 1e-300)); // (4), by d
    return {pressure, slope};
}

} // namespace

RadialFlow::RadialFlow(const RadialFlowDef& def) : def_(def)
{
    const auto n = size_t(def.cells);
    faces_.resize(n + 1);
    for (size_t f = 0; f <= n; ++f)
        faces_[f] = def.length * double(f) / double(n);
    masses_.resize(n);
    cells_.resize(n);
    centers_.resize(n);
    states_.resize(n);
    slopes_.resize(n);
    for (size_t i = 0; i < n; ++i) {
        const FlowState state = def.initial(0.5 * (faces_[i] + faces_[i + 1]));
        masses_[i] = state.density * volume(i);
        const double thermal = state.pressure / ((def.gamma - 1) * state.density);
        cells_[i] = {state.velocity, thermal + 0.5 * state.velocity * state.velocity};
    }
    updateStates();
}

double RadialFlow::volume(size_t cell) const
{
    const double a = faces_[cell];
    const double b = faces_[cell + 1];
    return def_.spherical ? (b - a) * (a * a + a * b + b * b) / 3 : b - a;
}

void RadialFlow::updateStates()
{
    for (size_t i = 0; i < cells_.size(); ++i) {
        const double thermal = cells_[i].energy - 0.5 * cells_[i].velocity * cells_[i].velocity;
        const double density = masses_[i] / volume(i);
        centers_[i] = 0.5 * (faces_[i] + faces_[i + 1]);
        states_[i] = {density, cells_[i].velocity,
                      std::max((def_.gamma - 1) * density * thermal, kMinPressure)};
    }
}

void RadialFlow::updateSlopes()
{
    const size_t n = cells_.size();
    const auto slope = [this](size_t i, double FlowState::*member) {
        const double low = (states_[i].*member - states_[i - 1].*member) / (centers_[i] - centers_[i - 1]);
        const double high = (states_[i + 1].*member - states_[i].*member) / (centers_[i + 1] - centers_[i]);
        return limited(low, high);
    };
    for (size_t i = 1; i + 1 < n; ++i)
        slopes_[i] = {slope(i, &FlowState::density), slope(i, &FlowState::velocity),
                      slope(i, &FlowState::pressure)};
}

FlowState RadialFlow::sideOf(size_t cell, double radius) const
{
    const double d = radius - centers_[cell];
    const FlowState& state = states_[cell];
    const FlowState& slope = slopes_[cell];
    return {state.density + d * slope.density, state.velocity + d * slope.velocity,
            std::max(state.pressure + d * slope.pressure, kMinPressure)};
}

RadialFlow::Face RadialFlow::solveFace(const FlowState& left, const FlowState& right) const
{
    const double stiffLeft = std::sqrt(def_.gamma * left.pressure * left.density);
    const double stiffRight = std::sqrt(def_.gamma * right.pressure * right.density);
    double u = (stiffLeft * left.velocity + stiffRight * right.velocity + left.pressure - right.pressure) /
               (stiffLeft + stiffRight);
    u = std::isfinite(u) ? u : 0.5 * (left.velocity + right.velocity);
    for (int i = 0; i < 8; ++i) {
        const Response l = respond(left, left.velocity - u, def_.gamma);
        const Response r = respond(right, u - right.velocity, def_.gamma);
        const double step = (l.pressure - r.pressure) / std::max(l.slope + r.slope, 1e-300);
        u += step;
        if (std::abs(step) <= 1e-12 * (std::abs(u) + std::abs(left.velocity - right.velocity)))
            break;
    }
    return {std::max(respond(left, left.velocity - u, def_.gamma).pressure, 0.0), u};
}

RadialFlow::Face RadialFlow::solveWall(const FlowState& side, double sign) const
{
    return {std::max(respond(side, sign * side.velocity, def_.gamma).pressure, 0.0), 0};
}

void RadialFlow::computeRates(Rates& out)
{
    updateStates();
    updateSlopes();
    const size_t n = cells_.size();
    std::vector<Face> stars(n + 1);
    stars[0] = solveWall(sideOf(0, faces_[0]), -1);
    for (size_t f = 1; f < n; ++f)
        stars[f] = solveFace(sideOf(f - 1, faces_[f]), sideOf(f, faces_[f]));
    const FlowState& last = states_[n - 1];
    const double stiff = std::sqrt(def_.gamma * last.pressure * last.density);
    stars[n] = def_.outerWall ? solveWall(last, 1)
                              : Face{def_.outsidePressure,
                                     last.velocity + (last.pressure - def_.outsidePressure) / stiff};

    out.faces.resize(n + 1);
    out.cells.resize(n);
    for (size_t f = 0; f <= n; ++f)
        out.faces[f] = stars[f].velocity; // (1)
    for (size_t i = 0; i < n; ++i) {
        const double inner = area(faces_[i]);
        const double outer = area(faces_[i + 1]);
        const double push = 0.5 * (inner + outer) * (stars[i + 1].pressure - stars[i].pressure); // (2)
        const double work = outer * stars[i + 1].pressure * stars[i + 1].velocity -
                            inner * stars[i].pressure * stars[i].velocity; // (3)
        out.cells[i] = {-push / masses_[i], -work / masses_[i]};
    }
}

double RadialFlow::stepLimit() const
{
    double limit = 1e300;
    for (size_t i = 0; i < cells_.size(); ++i) {
        const double width = faces_[i + 1] - faces_[i];
        const double before = i > 0 ? states_[i - 1].velocity : 0; // the wall rests
        const double behind = i + 1 < cells_.size() ? states_[i + 1].velocity
                              : def_.outerWall      ? 0
                                                    : states_[i].velocity;
        const double change =
            std::max(std::abs(states_[i].velocity - before), std::abs(states_[i].velocity - behind));
        const double sound = std::sqrt(def_.gamma * states_[i].pressure / states_[i].density);
        limit = std::min(limit, width / (sound + 2 * change + 1e-300));
    }
    return kCourant * limit;
}

void RadialFlow::advanceTo(double time)
{
    Rates first;
    Rates second;
    while (time_ < time) {
        computeRates(first);
        const double step = std::min(stepLimit(), time - time_);
        const std::vector<double> faces = faces_;
        const std::vector<Cell> cells = cells_;
        const auto blend = [&](double a, double b) {
            for (size_t f = 0; f < faces_.size(); ++f)
                faces_[f] = faces[f] + step * (a * first.faces[f] + (b > 0 ? b * second.faces[f] : 0));
            for (size_t i = 0; i < cells_.size(); ++i) {
                const Cell& late = b > 0 ? second.cells[i] : first.cells[i];
                cells_[i].velocity =
                    cells[i].velocity + step * (a * first.cells[i].velocity + b * late.velocity);
                cells_[i].energy = cells[i].energy + step * (a * first.cells[i].energy + b * late.energy);
            }
        };
        blend(1, 0);
        computeRates(second);
        blend(0.5, 0.5);
        time_ = step < time - time_ ? time_ + step : time;
    }
    updateStates();
}

FlowState RadialFlow::at(double radius) const
{
    if (radius > faces_.back())
        return {};
    const auto above = std::upper_bound(centers_.begin(), centers_.end(), radius);
    if (above == centers_.begin())
        return states_.front();
    if (above == centers_.end())
        return states_.back();
    const auto i = size_t(above - centers_.begin());
    const double f = (radius - centers_[i - 1]) / (centers_[i] - centers_[i - 1]);
    const auto mix = [f](double a, double b) { return a + f * (b - a); };
    return {mix(states_[i - 1].density, states_[i].density),
            mix(states_[i - 1].velocity, states_[i].velocity),
            mix(states_[i - 1].pressure, states_[i].pressure)};
}

double RadialFlow::total(double kineticShare) const
{
    double sum = 0;
    for (size_t i = 0; i < cells_.size(); ++i) {
        const double kinetic = 0.5 * cells_[i].velocity * cells_[i].velocity;
        sum += masses_[i] * (cells_[i].energy - (1 - kineticShare) * kinetic);
    }
    return def_.spherical ? 4 * std::numbers::pi * sum : sum;
}

double RadialFlow::energy() const
{
    return total(1);
}

double RadialFlow::thermalEnergy() const
{
    return total(0);
}

} // namespace fx::sim
