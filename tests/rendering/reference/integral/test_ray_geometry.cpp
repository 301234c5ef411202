#include "ray_cases.h"
#include "rendering/reference/integral/ray_packet.h"

#include <gtest/gtest.h>

#include <numbers>
#include <numeric>

namespace fx::render {
namespace {

/// All lanes are the same ray.
template <class T>
PacketRays<T> raysAlong(const std::array<double, 3>& origin, const std::array<double, 3>& direction)
{
    PacketRays<T> rays;
    for (uint32_t i = 0; i < kPacketRays; ++i) {
        for (int a = 0; a < 3; ++a) {
            rays.origin[a][i] = T(origin[size_t(a)]);
            rays.direction[a][i] = T(direction[size_t(a)]);
            rays.background[a][i] = T(0);
        }
        rays.nearest[i] = T(0);
        rays.farthest[i] = std::numeric_limits<T>::infinity();
    }
    return rays;
}

/// Half chord that meetBlobs() finds for a ball of radius 1 at distance `far` with distance `off` from the
/// ray; the true one for the same rounded numbers.
struct Chord
{
    double got, naive, exact;
};

Chord chordOf(float far, float off, const std::array<float, 3>& d)
{
    // the ball's center: far along the ray and off to the side
    const std::array<float, 3> side = {d[1] / std::hypot(d[0], d[1]), -d[0] / std::hypot(d[0], d[1]), 0.0f};
    std::array<float, 3> center;
    for (size_t a = 0; a < 3; ++a)
        center[a] = far * d[a] + off * side[a];
    const std::vector<BallBlob<float>> balls = {
        {{center[0], center[1], center[2]}, 1.0f, 1.0f, {1.0f, 1.0f, 1.0f}}};
    RayPacket<float> packet;
    const uint32_t first = 0;
    meetBlobs<float>(raysAlong<float>({0, 0, 0}, {d[0], d[1], d[2]}), balls, {&first, 1}, packet);

    Quad along = 0, length2 = 0, square = 0;
    float alongFloat = 0.0f, squareFloat = 0.0f;
    for (size_t a = 0; a < 3; ++a) {
        along += Quad(center[a]) * Quad(d[a]);
        length2 += Quad(d[a]) * Quad(d[a]);
        square += Quad(center[a]) * Quad(center[a]);
        alongFloat += center[a] * d[a];
        squareFloat += center[a] * center[a];
    }
    const Quad chord2 = Quad(1) - (square - along * along / length2);
    const float naive2 = 1.0f - (squareFloat - alongFloat * alongFloat); // loses all digits far away
    return {packet.chord2.empty() ? 0.0 : std::sqrt(std::max(0.0, double(packet.chord2[0]))),
            std::sqrt(std::max(0.0, double(naive2))), chord2 > Quad(0) ? double(sqrtq(chord2)) : 0.0};
}

TEST(RayBallApproach, errsNoMoreThanThePlaceOfTheBallIsRounded)
{
    Draw draw(3);
    for (const double far : {1.0, 1e2, 1e3, 1e4, 1e5}) {
        double worst = 0.0, worstNaive = 0.0;
        for (int i = 0; i < 2000; ++i) {
            const double z = draw.between(-1, 1), phi = draw.between(0, 6.28), s = std::sqrt(1 - z * z);
            const std::array<float, 3> d = {float(s * std::cos(phi)), float(s * std::sin(phi)), float(z)};
            const Chord chord = chordOf(float(far), float(draw.between(0.0, 0.95)), d);
            worst = std::max(worst, std::fabs(chord.got - chord.exact));
            worstNaive = std::max(worstNaive, std::fabs(chord.naive - chord.exact));
        }
        const double rounding = std::ldexp(far + 1.0, -24);
        EXPECT_LT(worst, 16.0 * rounding) << far; // the chord changes up to 3 times as fast as the distance
        if (far >= 1e3) {
            EXPECT_GT(worstNaive, 100.0 * worst) << far; // the textbook form is no answer
        }
    }
}

TEST(RayBallApproach, ofAGrazingRayGoesToNothingContinuously)
{
    double last = 1.0;
    for (double gap = 0.1; gap > 1e-7; gap *= 0.7) {
        const Chord chord = chordOf(3.0f, float(1.0 - gap), {0.6f, 0.0f, 0.8f});
        EXPECT_LE(chord.got, last);
        EXPECT_NEAR(chord.got, std::sqrt(gap * (2.0 - gap)), 8e-7 / std::sqrt(gap) + 1e-6);
        last = chord.got;
    }
    EXPECT_EQ(chordOf(3.0f, 1.0001f, {0.6f, 0.0f, 0.8f}).got, 0.0);
}

TEST(UnitDirection, isThatOfAVectorOfAnyLength)
{
    Draw draw(5);
    for (int i = 0; i < 50; ++i) {
        const std::array<double, 3> d = {draw.between(-1, 1), draw.between(-1, 1), draw.between(-1, 1)};
        const std::array<double, 3> expected = *unitDirection(d);
        EXPECT_NEAR(std::hypot(expected[0], expected[1], expected[2]), 1.0, 4e-16);
        for (const double length : {1e-300, 1e-20, 1.0 - 1e-6, 1.0 + 1e-6, 1e20, 1e300}) {
            const std::array<double, 3> got = *unitDirection({d[0] * length, d[1] * length, d[2] * length});
            for (size_t a = 0; a < 3; ++a)
                EXPECT_NEAR(got[a], expected[a], 9e-16) << length; // 4 eps
        }
    }
    // the textbook form: squares vanish
    const float tiny = 1e-25f;
    EXPECT_EQ(std::sqrt(tiny * tiny), 0.0f);
}

TEST(UnitDirection, ofNothingIsRefused)
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const std::array<double, 3>& bad :
         {std::array<double, 3>{0, 0, 0}, {nan, 0, 1}, {0, kInfinity, 1}, {0, 0, -kInfinity}})
        EXPECT_EQ(unitDirection(bad).status().code(), base::Code::InvalidArgument);
}

TEST(UnitDirection, mattersFarAwayWhereALengthOffByAMillionthMovesTheBall)
{
    // H changes by e^2 t^2: at 1e5 m a millionth is 0.01 m2, of a ball of radius 1 m.
    const std::array<double, 3> d = *unitDirection({0.6, 0.1, 0.8});
    const std::vector<BallBlob<double>> balls = {{{d[0] * 1e5, d[1] * 1e5, d[2] * 1e5}, 1.0, 1.0, {1, 1, 1}}};
    const uint32_t first = 0;
    const auto chord2Of = [&](double length) {
        RayPacket<double> packet;
        meetBlobs<double>(raysAlong<double>({0, 0, 0}, {d[0] * length, d[1] * length, d[2] * length}), balls,
                          {&first, 1}, packet);
        return packet.chord2.at(0);
    };
    EXPECT_NEAR(chord2Of(1.0), 1.0, 1e-9);
    EXPECT_GT(std::fabs(chord2Of(1.0 + 1e-6) - 1.0), 1e-2);
}

/// Light of a scene of ten blobs that is moved, together with its camera, by a shift of the world. Places are
/// formed in double and handed over relative to `zero`.
std::array<float, 3> shiftedLight(const std::array<double, 3>& shift, const std::array<double, 3>& zero)
{
    Draw draw(12);
    std::vector<BallBlob<float>> balls;
    for (int i = 0; i < 10; ++i) {
        BallBlob<float> ball{{}, float(draw.between(0.5, 1.0)), 0.7f, {}};
        for (int a = 0; a < 3; ++a) {
            const double world = double(float(draw.between(-1, 1))) + (a == 2 ? 4.0 : 0.0) + shift[size_t(a)];
            ball.center[a] = float(world - zero[size_t(a)]);
            ball.source[a] = float(draw.next());
        }
        balls.push_back(ball);
    }
    std::array<double, 3> origin;
    for (size_t a = 0; a < 3; ++a)
        origin[a] = shift[a] - zero[a];
    const PacketRays<float> rays = raysAlong<float>(origin, {0.0, 0.0, 1.0});
    std::vector<uint32_t> all(balls.size());
    std::iota(all.begin(), all.end(), 0u);
    RayPacket<float> packet;
    meetBlobs<float>(rays, balls, all, packet);
    PacketLight<float> light;
    PacketIntegrator<float>(settingsOf("gauss-5")).integrate(rays, packet, light);
    return {light.radiance[0][0], light.radiance[1][0], light.radiance[2][0]};
}

TEST(RayIntegral, isTheSameWhereverInTheWorldSceneAndCameraAre)
{
    const std::array<float, 3> home = shiftedLight({0, 0, 0}, {0, 0, 0});
    for (const double far : {1e2, 1e3, 1e4, 1e5, 1e7})
        for (const std::array<double, 3>& axis : {std::array<double, 3>{1, 0, 0}, {0, 0, 1}, {1, 1, 1}}) {
            const std::array<double, 3> shift = {far * axis[0], far * axis[1], far * axis[2]};
            const std::array<float, 3> moved = shiftedLight(shift, shift);
            for (size_t c = 0; c < 3; ++c)
                EXPECT_NEAR(moved[c] / home[c], 1.0f, 1e-6f) << far;
        }
    // places in float relative to the world's origin are another matter
    const std::array<double, 3> diagonal = {1e5 + 0.3, 1e5 + 0.3, 1e5 + 0.3};
    EXPECT_GT(std::fabs(shiftedLight(diagonal, {0, 0, 0})[0] / home[0] - 1.0f), 1e-4f);
}

TEST(RayIntegral, overAllRaysHoldsTheMassOfTheBlob)
{
    // The integral of (1 - q^2)^2 over the ball is 32 pi R^3 / 105.
    for (const double pixels : {2.0, 5.0, 20.0, 100.0}) { // radius in pixels
        const uint32_t size = 256;
        const double pixel = 2.2 / size * std::max(1.0, 100.0 / pixels / 1.2), radius = pixels * pixel;
        const std::vector<BallBlob<double>> balls = {
            {{0.0371 * pixel, 0.21 * pixel, 3.0 * radius}, radius, 2.5, {1.0, 1.0, 1.0}}};
        PacketIntegrator<double> integrator(settingsOf("gauss-5"));
        RayPacket<double> packet;
        PacketLight<double> light;
        const uint32_t first = 0;
        double mass = 0.0;
        for (uint32_t y = 0; y < size; ++y)
            for (uint32_t x = 0; x < size; x += kPacketRays) {
                PacketRays<double> rays = raysAlong<double>({0, 0, 0}, {0, 0, 1});
                for (uint32_t i = 0; i < kPacketRays; ++i) {
                    rays.origin[0][i] = (x + i + 0.5 - size / 2.0) * pixel;
                    rays.origin[1][i] = (y + 0.5 - size / 2.0) * pixel;
                }
                packet.clear();
                if (meetBlobs<double>(rays, balls, {&first, 1}, packet) == 0)
                    continue;
                integrator.integrate(rays, packet, light);
                mass = std::accumulate(light.opticalDepth, light.opticalDepth + kPacketRays, mass,
                                       [&](double sum, double depth) { return sum + depth * pixel * pixel; });
            }
        const double expected = 2.5 * 32.0 * std::numbers::pi / 105.0 * radius * radius * radius;
        EXPECT_NEAR(mass / expected, 1.0, pixels < 5.0 ? 1e-2 : 1e-3) << pixels;
        // a kernel of another degree has another mass: 64 pi R^3 / 315 for the third
        EXPECT_GT(std::fabs(mass / (2.5 * 64.0 * std::numbers::pi / 315.0 * radius * radius * radius) - 1.0),
                  0.1);
    }
}

} // namespace
} // namespace fx::render
