#include "simulation/verification/riemann_problem.h"

#include <cmath>

namespace fx::sim {
namespace {

double soundSpeed(const FlowState& state, double gamma)
{
    return std::sqrt(gamma * state.pressure / state.density);
}

FlowState mirrored(FlowState state)
{
    state.velocity = -state.velocity;
    return state;
}

} // namespace

RiemannProblem::RiemannProblem(const FlowState& left, const FlowState& right, double gamma)
    : left_(left), right_(right), gamma_(gamma)
{
    double low = std::log(1e-30 * std::fmin(left.pressure, right.pressure));
    double high = std::log(1e30 * std::fmax(left.pressure, right.pressure));
    for (int i = 0; i < 80; ++i) {
        const double middle = 0.5 * (low + high);
        const double pressure = std::exp(middle);
        const double sum = velocityJump(left_, pressure) + velocityJump(right_, pressure) + right_.velocity -
                           left_.velocity; // (3)
        (sum < 0 ? low : high) = middle;
    }
    pressure_ = std::exp(0.5 * (low + high));
    velocity_ = 0.5 * (left_.velocity + right_.velocity + velocityJump(right_, pressure_) -
                       velocityJump(left_, pressure_)); // (3)
}

double RiemannProblem::velocityJump(const FlowState& side, double pressure) const
{
    if (pressure > side.pressure) {
        const double a = 2 / ((gamma_ + 1) * side.density);
        const double b = (gamma_ - 1) / (gamma_ + 1) * side.pressure;
        return (pressure - side.pressure) * std::sqrt(a / (pressure + b)); // (1)
    }
    const double exponent = (gamma_ - 1) / (2 * gamma_);
    return 2 * soundSpeed(side, gamma_) / (gamma_ - 1) *
           (std::pow(pressure / side.pressure, exponent) - 1); // (2)
}

double RiemannProblem::starDensity(const FlowState& side) const
{
    const double ratio = pressure_ / side.pressure;
    if (ratio > 1) {
        const double k = (gamma_ - 1) / (gamma_ + 1);
        return side.density * (ratio + k) / (k * ratio + 1); // (4)
    }
    return side.density * std::pow(ratio, 1 / gamma_); // (5)
}

double RiemannProblem::starDensityLeft() const
{
    return starDensity(left_);
}

double RiemannProblem::starDensityRight() const
{
    return starDensity(right_);
}

double RiemannProblem::rightWaveSpeed() const
{
    const double ratio = std::fmax(1.0, pressure_ / right_.pressure);
    return right_.velocity + soundSpeed(right_, gamma_) * std::sqrt((gamma_ + 1) / (2 * gamma_) * ratio +
                                                                    (gamma_ - 1) / (2 * gamma_)); // (6)
}

FlowState RiemannProblem::leftOfContact(const FlowState& left, double velocity, double speed) const
{
    const double sound = soundSpeed(left, gamma_);
    const FlowState star{starDensity(left), velocity, pressure_};
    if (pressure_ > left.pressure) {
        const double shock =
            left.velocity - sound * std::sqrt((gamma_ + 1) / (2 * gamma_) * pressure_ / left.pressure +
                                              (gamma_ - 1) / (2 * gamma_)); // (6)
        return speed < shock ? left : star;
    }
    if (speed < left.velocity - sound)
        return left;
    if (speed > velocity - soundSpeed(star, gamma_))
        return star;
    const double u = 2 / (gamma_ + 1) * (sound + 0.5 * (gamma_ - 1) * left.velocity + speed); // (7)
    const double ratio = (sound + 0.5 * (gamma_ - 1) * (left.velocity - u)) / sound;          // (7)
    return {left.density * std::pow(ratio, 2 / (gamma_ - 1)), u,
            left.pressure * std::pow(ratio, 2 * gamma_ / (gamma_ - 1))};
}

FlowState RiemannProblem::at(double speed) const
{
    if (speed < velocity_)
        return leftOfContact(left_, velocity_, speed);
    return mirrored(leftOfContact(mirrored(right_), -velocity_, -speed));
}

} // namespace fx::sim
