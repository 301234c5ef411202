#include "benchmarks/accuracy/techniques/lit_ball.h"

#include "fxsdk/cli/support/interrupt.h"
#include "rendering/reference/path/homogeneous_medium.h"
#include "rendering/reference/path/path_tracking.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace fx::cli {
namespace {

constexpr uint32_t kPaths = 1u << 19;
constexpr double kMin = 1e-6; // throughput below which a path counts as absorbed

struct LitBall
{
    double diameter, albedo, anisotropy;
};

std::vector<LitBall> litBalls()
{
    std::vector<LitBall> balls;
    for (const double diameter : {1.0, 5.0, 15.0, 50.0})
        for (const LitBall& ball :
             {LitBall{diameter, 1.0, 0.7}, {diameter, 0.99, 0.0}, {diameter, 0.99, 0.7}})
            balls.push_back(ball);
    return balls;
}

/// Shares of the light of paths, and their squares.
struct Shares
{
    double sunward = 0.0, far = 0.0;
    double sunwardSquares = 0.0, farSquares = 0.0;

    void add(double light, bool isSunward)
    {
        (isSunward ? sunward : far) += light;
        (isSunward ? sunwardSquares : farSquares) += light * light;
    }
    /// Of a mean of kPaths.
    static double standardError(double sum, double squares)
    {
        const double mean = sum / kPaths;
        return std::sqrt(std::max(0.0, squares / kPaths - mean * mean) / kPaths);
    }
};

/// Light from above (+Y) that hits a ball of radius 1 evenly over its cross section.
void follow(render::MediumTracker& tracker, uint32_t number, Shares& io)
{
    render::PathSampler sampler(3, 0, number);
    const auto [area, turn] = sampler.pair();
    const double r = std::sqrt(area), angle = 2.0 * std::numbers::pi * turn;
    render::FlightStart start{{{r * std::cos(angle), 4.0, r * std::sin(angle)}, {0.0, -1.0, 0.0}}};
    glm::dvec3 throughput(1.0), emitted(0.0);
    for (uint32_t scatterings = 0; throughput.x > kMin; ++scatterings) {
        const render::Flight flight = tracker.fly(start, sampler, throughput, emitted);
        if (!flight.isScattered) {
            const glm::dvec3 place =
                start.ray.origin + tracker.lastWay()->extent().second * start.ray.direction;
            io.add(throughput.x, scatterings > 0 && place.y > 0.0);
            return;
        }
        const auto [u, v] = sampler.pair();
        start.ray = {start.ray.origin + flight.distance * start.ray.direction,
                     render::PhaseFunction::around(start.ray.direction, flight.phase.cosine(u), v)};
    }
}

class LitBallAccuracy final : public AccuracyTechnique
{
public:
    LitBallAccuracy() : balls_(litBalls())
    {
        for (const LitBall& ball : balls_) {
            char name[64];
            std::snprintf(name, sizeof name, "tau %g albedo %g g %g", ball.diameter, ball.albedo,
                          ball.anisotropy);
            settings_.push_back(
                {name, "", {{"tau", ball.diameter}, {"albedo", ball.albedo}, {"g", ball.anisotropy}}});
        }
    }
    std::string_view scene() const override { return "lit-ball"; }
    const std::vector<AccuracySetting>& settings() const override { return settings_; }

    base::Result<AccuracySample> run(size_t setting, const std::function<bool()>& stop) override
    {
        const LitBall& ball = balls_[setting];
        render::MediumPoint point;
        point.extinction = glm::dvec3(0.5 * ball.diameter);
        point.scattering = ball.albedo * point.extinction;
        point.phase = render::PhaseFunction::henyeyGreenstein(ball.anisotropy);
        const render::HomogeneousMedium medium({render::MediumShape::Kind::Ball, {}, {1.0, 0.0, 0.0}}, point);
        render::MediumTracker tracker(&medium, render::FlightEstimator::Depth,
                                      render::ShadowEstimator::Exact);
        Shares shares;
        bool isStopped = false;
        const MeasuredWork measured = measureWork([&] {
            for (uint32_t i = 0; i < kPaths && !isStopped; ++i) {
                follow(tracker, i, shares);
                isStopped = i % 1024 == 0 && stop();
            }
        });
        if (isStopped)
            return interruptedStatus();
        AccuracySample sample;
        sample.seconds = measured.seconds;
        sample.instructions = measured.instructions;
        sample.items = kPaths;
        const double sunward = shares.sunward / kPaths, far = shares.far / kPaths;
        storeErrors({Shares::standardError(shares.sunward, shares.sunwardSquares),
                     Shares::standardError(shares.far, shares.farSquares)},
                    sample);
        sample.work = {
            {"paths", kPaths}, {"collisions", tracker.collisions()}, {"sunward", sunward}, {"far", far}};
        char note[64];
        std::snprintf(note, sizeof note, "sunward %.3f far %.3f", sunward, far);
        sample.note = note;
        return sample;
    }

private:
    std::vector<LitBall> balls_;
    std::vector<AccuracySetting> settings_;
};

} // namespace

std::unique_ptr<AccuracyTechnique> makeLitBallAccuracy()
{
    return std::make_unique<LitBallAccuracy>();
}

} // namespace fx::cli
