/// @file ray_places.cpp
/// where rays meet blobs.

#include "benchmarks/stability/rows/ray_sweeps.h"
#include "benchmarks/stability/stability_row.h"
#include "rendering/reference/integral/ray_packet.h"

#include <algorithm>
#include <array>
#include <numbers>
#include <numeric>

namespace fx::cli {
namespace {

using Vector = std::array<double, 3>;

/// All lanes are the same ray.
template <class T>
render::PacketRays<T> raysAlong(const Vector& origin, const Vector& direction)
{
    render::PacketRays<T> rays{};
    for (uint32_t i = 0; i < render::kPacketRays; ++i) {
        for (size_t a = 0; a < 3; ++a) {
            rays.origin[a][i] = T(origin[a]);
            rays.direction[a][i] = T(direction[a]);
        }
        rays.farthest[i] = std::numeric_limits<T>::infinity();
    }
    return rays;
}

//

struct Approach
{
    double got, naive, exact, moved; ///< half chords [radius]; moved: by the rounding of the ball's place
};

/// A ball of radius 1 at a distance, whose rim the ray passes by a gap inside.
Approach approachOf(double gap, double distance, uint64_t seed)
{
    SweepRandom random(seed);
    const double z = random.between(-0.9, 0.9), phi = random.between(0, 6.28), s = std::sqrt(1 - z * z);
    const float d[3] = {float(s * std::cos(phi)), float(s * std::sin(phi)), float(z)};
    const double off = 1.0 - gap, length = std::hypot(double(d[0]), double(d[1]));
    const float center[3] = {float(distance * double(d[0]) + off * double(d[1]) / length),
                             float(distance * double(d[1]) - off * double(d[0]) / length),
                             float(distance * double(d[2]))};
    render::RayPacket<float> packet;
    const uint32_t first = 0;
    const render::BallBlob<float> ball{{center[0], center[1], center[2]}, 1.0f, 1.0f, {1, 1, 1}};
    render::meetBlobs<float>(raysAlong<float>({}, {double(d[0]), double(d[1]), double(d[2])}), {&ball, 1},
                             {&first, 1}, packet);
    long double along = 0, length2 = 0, across2 = 0;
    float alongFloat = 0.0f, squareFloat = 0.0f;
    for (size_t a = 0; a < 3; ++a) {
        along += static_cast<long double>(center[a]) * d[a];
        length2 += static_cast<long double>(d[a]) * d[a];
        alongFloat += center[a] * d[a];
        squareFloat += center[a] * center[a];
    }
    for (size_t a = 0; a < 3; ++a) {
        const long double side = center[a] - along / length2 * d[a];
        across2 += side * side;
    }
    const double rounding = std::ldexp(distance + 1.0, -24), across = double(std::sqrt(across2));
    const auto half = [](double b) { return std::sqrt(std::fmax((1.0 - b) * (1.0 + b), 0.0)); };
    const double got = packet.chord2.empty() ? 0.0 : std::fmax(double(packet.chord2[0]), 0.0);
    return {std::sqrt(got), std::sqrt(std::fmax(1.0 - double(squareFloat - alongFloat * alongFloat), 0.0)),
            half(across),
            std::fmax(half(across) - half(across + rounding), half(across - rounding) - half(across))};
}

/// In units of what the rounding of the ball's place moves the chord by.
double approachError(double gap, double distance, bool isNaive, uint64_t rays)
{
    double worst = 0;
    for (uint64_t seed = 0; seed < rays; ++seed) {
        const Approach a = approachOf(gap, distance, seed);
        worst = std::fmax(worst, std::fabs((isNaive ? a.naive : a.got) - a.exact) / a.moved);
    }
    return worst;
}

std::vector<StabilitySweep> grazingRays(bool isQuick)
{
    const uint64_t rays = isQuick ? 20 : 2000;
    const StabilitySweep sweep{
        "meetBlobs, in roundings of the place",
        powersOfTen("gap / radius", -7, -0.1, 10, isQuick),
        powersOfTen("distance [m]", 0, 5, 4, isQuick),
        2.0,
        false,
        [rays](double gap, double distance) { return approachError(gap, distance, false, rays); }};
    return {sweep, controlOf(sweep, "difference of squares", [rays](double gap, double distance) {
                return approachError(gap, distance, true, rays);
            })};
}

//

/// Ten blobs before a camera, both moved by `shift`; places are handed over relative to `zero`.
std::array<float, 3> shiftedLight(const Vector& shift, const Vector& zero)
{
    SweepRandom random(12);
    std::vector<render::BallBlob<float>> balls;
    for (int i = 0; i < 10; ++i) {
        render::BallBlob<float> ball{{}, float(random.between(0.5, 1.0)), 0.7f, {}};
        for (size_t a = 0; a < 3; ++a) {
            const double world = double(float(random.between(-1, 1))) + (a == 2 ? 4.0 : 0.0) + shift[a];
            ball.center[a] = float(world - zero[a]);
            ball.source[a] = float(random.next());
        }
        balls.push_back(ball);
    }
    const auto rays =
        raysAlong<float>({shift[0] - zero[0], shift[1] - zero[1], shift[2] - zero[2]}, {0.0, 0.0, 1.0});
    std::vector<uint32_t> all(balls.size());
    std::iota(all.begin(), all.end(), 0u);
    render::RayPacket<float> packet;
    render::meetBlobs<float>(rays, balls, all, packet);
    render::PacketLight<float> light;
    render::PacketIntegrator<float>(settingsFor("gauss-5")).integrate(rays, packet, light);
    return {light.radiance[0][0], light.radiance[1][0], light.radiance[2][0]};
}

double shiftError(double far, double axes, bool isFromWorldOrigin)
{
    const int bits = int(axes);
    const Vector shift{bits & 1 ? far : 0.0, bits & 2 ? far : 0.0, bits & 4 ? far : 0.0};
    const auto home = shiftedLight({}, {}), moved = shiftedLight(shift, isFromWorldOrigin ? Vector{} : shift);
    double worst = 0;
    for (size_t c = 0; c < 3; ++c)
        worst = std::fmax(worst, relativeError(double(moved[c]), double(home[c])));
    return worst;
}

std::vector<StabilitySweep> shifts(bool isQuick)
{
    const StabilitySweep sweep{"gauss-5, float, relative to the camera",
                               powersOfTen("shift [m]", 0, 7, 20, isQuick),
                               values("axes (bits x y z)", {1, 2, 3, 4, 5, 6, 7}),
                               1e-6,
                               false,
                               [](double far, double axes) { return shiftError(far, axes, false); }};
    return {sweep, controlOf(sweep, "relative to the world",
                             [](double far, double axes) { return shiftError(far, axes, true); })};
}

//

/// In roundings of a double. @param isNaive squares in float, as one would write it
double directionError(double length, double seed, bool isNaive)
{
    SweepRandom random(uint64_t(seed) + 1);
    const Vector d{random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)};
    const double norm = std::hypot(d[0], d[1], d[2]);
    const auto unit = render::unitDirection({d[0] * length, d[1] * length, d[2] * length});
    if (!unit)
        return kEndless;
    float square = 0.0f;
    for (size_t a = 0; a < 3; ++a)
        square += float(d[a] * length) * float(d[a] * length);
    double worst = 0;
    for (size_t a = 0; a < 3; ++a) {
        const double got = isNaive ? d[a] * length / double(std::sqrt(square)) : (*unit)[a];
        worst = std::fmax(worst, std::fabs(got - d[a] / norm));
    }
    return worst / std::numeric_limits<double>::epsilon();
}

std::vector<StabilitySweep> directions(bool isQuick)
{
    const StabilitySweep sweep{
        "unitDirection, in roundings",
        powersOfTen("length", -20, 20, 5, isQuick),
        evenSteps("direction", 0, 40, 40, isQuick),
        4.0,
        false,
        [](double length, double seed) { return directionError(length, seed, false); }};
    return {sweep, controlOf(sweep, "squares in float",
                             [](double length, double seed) { return directionError(length, seed, true); })};
}

//

/// Optical depth of all pixels times their area, over the mass of the ball. @param samples per pixel and axis
double massError(double pixels, double place, int samples)
{
    SweepRandom random(uint64_t(place) + 7);
    const double x = random.next(), y = random.next(), step = 1.0 / samples;
    const render::BallBlob<double> ball{{x, y, 3.0 * pixels}, pixels, 0.1 / pixels, {1, 1, 1}}; // thin
    render::PacketIntegrator<double> integrator(settingsFor("gauss-5"));
    render::RayPacket<double> packet;
    render::PacketLight<double> light;
    const uint32_t first = 0;
    const double low = std::floor(-pixels), high = std::ceil(pixels) + 1.0;
    double mass = 0;
    for (double v = low + 0.5 * step; v < high; v += step)
        for (double u = low + 0.5 * step; u < high; u += step * render::kPacketRays) {
            auto rays = raysAlong<double>({u, v, 0}, {0, 0, 1});
            for (uint32_t i = 0; i < render::kPacketRays; ++i)
                rays.origin[0][i] += i * step;
            packet.clear();
            if (render::meetBlobs<double>(rays, {&ball, 1}, {&first, 1}, packet) == 0)
                continue;
            integrator.integrate(rays, packet, light);
            mass = std::accumulate(light.opticalDepth, light.opticalDepth + render::kPacketRays, mass);
        }
    return relativeError(mass * step * step, 3.2 * std::numbers::pi / 105.0 * pixels * pixels);
}

std::vector<StabilitySweep> masses(bool isQuick)
{
    const StabilitySweep sweep{
        "rays 1/16 radius apart or a pixel",
        powersOfTen("radius [pixel]", -0.7, 2.3, 8, isQuick),
        evenSteps("place", 0, 8, 8, isQuick),
        1e-3,
        false,
        [](double pixels, double place) { return massError(pixels, place, int(std::ceil(16.0 / pixels))); }};
    return {sweep, controlOf(sweep, "a ray a pixel",
                             [](double pixels, double place) { return massError(pixels, place, 1); })};
}

} // namespace

StabilityRows rayPlacesStability()
{
    return {
        {"R-06", "chords of grazing rays keep their digits", "the chord of the rounded numbers", grazingRays},
        {"R-08", "light is the same anywhere in the world", "the light at the origin", shifts},
        {"R-09", "directions of any length are made unit", "std::hypot", directions},
        {"R-15", "all rays together hold the mass of a blob", "32 pi R^3 / 105", masses},
    };
}

} // namespace fx::cli
