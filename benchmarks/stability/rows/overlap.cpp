/// @file overlap.cpp
/// O-01 to O-05: balls that overlap, summed up along one ray as the programs of the compositions slabs and
/// volume do it, by the formulas that these are compiled from.

#include "benchmarks/stability/rows/ray_sweeps.h"
#include "benchmarks/stability/stability_row.h"
#include "shaders/formulas/formula.h"

#include <algorithm>
#include <array>
#include <numbers>

namespace fx::cli {
namespace {

constexpr float kFar = std::numeric_limits<float>::infinity();

/// A ball on a ray along z.
struct Ball
{
    float center; ///< [m] along the ray
    float beside; ///< [m] distance of the ray
    float radius; ///< [m]
    float depth;  ///< [1] optical depth of the chord through the middle
    float source = 1.0f;
};
using Balls = std::vector<Ball>;

struct Look
{
    double light = 0, through = 1;
    double opacity() const { return 1.0 - through; }
};

/// What lies in one slab, as in shaders/slabs/slab_sums.glsl.
struct Sums
{
    float depth = 0, moment = 0, light = 0, slope = 0;
};

void putBehind(Look& look, const Sums& sums)
{
    constexpr float kThinSlab = 0.02f;
    const float emitted = std::max(sums.light, 0.0f);
    const float slope = formula::fxSlabSlope(sums.depth, emitted, sums.moment, sums.slope);
    const float light = sums.depth < kThinSlab
                            ? formula::fxSlabThinLight(sums.depth, sums.light, sums.moment, sums.slope)
                            : formula::fxSlabLight(sums.depth, emitted, slope);
    look.light += look.through * double(light);
    look.through *= 1.0 - double(formula::fxSlabOpacity(sums.depth));
}

/// As in shaders/slabs/slab_window.glsl.
struct Chord
{
    float tc, w, depth, source;
    float placeOf(float t) const { return std::clamp((t - tc) / w, -1.0f, 1.0f); }
    float passed(float t) const { return depth * formula::fxKernelPassed(placeOf(t)); }
};

std::vector<Chord> chordsOf(const Balls& balls)
{
    std::vector<Chord> chords;
    for (const Ball& ball : balls) {
        const float q2 = std::max((ball.radius - ball.beside) * (ball.radius + ball.beside), 0.0f) /
                         (ball.radius * ball.radius);
        const float q = std::sqrt(q2);
        chords.push_back(
            {ball.center, ball.radius * std::max(q, 1e-6f), ball.depth * q2 * q2 * q, ball.source});
    }
    return chords;
}

struct Interval
{
    float from, to; ///< [m]
};

Interval narrowed(const std::vector<Chord>& chords, float start, Interval range, bool isLast)
{
    constexpr int kBins = 8;
    constexpr float kMinDepth = 0.002f, kMaxDepth = 9.0f;
    std::array<float, kBins + 1> passed{};
    const float width = (range.to - range.from) / float(kBins);
    for (const Chord& chord : chords)
        for (int k = 0; k <= kBins; ++k)
            passed[size_t(k)] += chord.passed(range.from + float(k) * width) - chord.passed(start);
    Interval narrow = range;
    for (int k = 1; k < kBins; ++k)
        if (passed[size_t(k)] < kMinDepth)
            narrow.from = range.from + float(k) * width;
    for (int k = kBins - 1; k >= 0; --k) {
        const float low = passed[size_t(k)], high = passed[size_t(k + 1)];
        const float share =
            std::clamp(isLast ? (kMaxDepth - low) / std::max(high - low, 1e-6f) : 1.0f, 0.0f, 1.0f);
        if (high >= kMaxDepth)
            narrow.to = range.from + (float(k) + (k == 0 ? std::cbrt(share) : share)) * width;
    }
    return narrow;
}

/// As shaders/slabs/slabs.frag.glsl, with 16 slabs.
Look inSlabs(const Balls& balls, float t0 = 0.0f, float t1 = kFar)
{
    constexpr int kSlabs = 16;
    const std::vector<Chord> chords = chordsOf(balls);
    Interval range{1e30f, -1e30f};
    for (const Chord& chord : chords) {
        const float front = std::max(chord.tc - chord.w, t0), back = std::min(chord.tc + chord.w, t1);
        if (chord.depth > 0.0f && front < back)
            range = {std::min(range.from, front), std::max(range.to, back)};
    }
    Look look;
    if (!(range.to > range.from))
        return look;
    const Interval window = narrowed(chords, range.from, narrowed(chords, range.from, range, false), true);
    const float width = (window.to - window.from) / float(kSlabs);
    const auto edge = [&](int k) {
        return k == 0 ? range.from : k == kSlabs ? window.to : window.from + float(k) * width;
    };
    for (int k = 0; k < kSlabs; ++k) {
        const float near = edge(k), far = edge(k + 1), middle = 0.5f * (near + far);
        Sums sums;
        for (const Chord& chord : chords) {
            const float u = chord.placeOf(near), v = chord.placeOf(far);
            const float depth = chord.depth * (formula::fxKernelPassed(v) - formula::fxKernelPassed(u));
            const float moved = formula::fxKernelMoment(v) - formula::fxKernelMoment(u);
            const float moment =
                ((chord.tc - middle) * depth + chord.w * chord.depth * moved) / std::max(far - near, 1e-20f);
            sums.depth += depth;
            sums.moment += moment;
            sums.light += depth * chord.source;
            sums.slope += moment * chord.source;
        }
        putBehind(look, sums);
    }
    float behind = 0.0f;
    for (const Chord& chord : chords)
        behind += chord.passed(range.to) - chord.passed(window.to);
    look.through *= std::exp(-double(behind));
    return look;
}

/// Samples of a lattice of side 1 that is interpolated linearly, as shaders/field/field_fill.comp.glsl writes
/// them.
class Field
{
public:
    struct Sample
    {
        float extinction = 0, light = 0; ///< [1/voxel]
    };

    /// @param balls with lengths in voxels; place: of the ray, and of the ball, within a voxel
    Field(const Balls& balls, float x, float y) : balls_(balls), x_(x), y_(y) {}

    Sample at(float t) const
    {
        const float below = std::floor(t), share = t - below;
        const Sample a = slice(below), b = slice(below + 1.0f);
        return {a.extinction + share * (b.extinction - a.extinction), a.light + share * (b.light - a.light)};
    }

    /// Of a ball that is no smaller than what voxels hold.
    static float extinctionOf(const Ball& ball, float distance2)
    {
        const float radius = std::max(ball.radius, 2.0f);
        const float depth =
            ball.depth * ball.radius * ball.radius / (radius * radius); // its cross section stays
        return 0.9375f * depth / radius *
               formula::fxVoxelKernel(distance2 / (radius * radius), 1.0f / (radius * radius));
    }

private:
    /// Interpolated across the ray. Samples stand at whole numbers, the ray at (x, y) between them.
    Sample slice(float z) const
    {
        Sample sum;
        for (int corner = 0; corner < 4; ++corner) {
            const float i = float(corner & 1), j = float(corner >> 1);
            const float weight = (i > 0.5f ? x_ : 1.0f - x_) * (j > 0.5f ? y_ : 1.0f - y_);
            for (const Ball& ball : balls_) {
                const float dx = i - x_ - ball.beside, dy = j - y_, dz = z - ball.center;
                const float extinction = weight * extinctionOf(ball, dx * dx + dy * dy + dz * dz);
                sum.extinction += extinction;
                sum.light += extinction * ball.source;
            }
        }
        return sum;
    }

    const Balls& balls_;
    float x_, y_;
};

/// As shaders/field/field_march.frag.glsl. Lengths in voxels.
Look marched(const Balls& balls, float t0, float t1, float x = 0.3f, float y = 0.6f)
{
    const Field field(balls, x, y);
    Look look;
    Field::Sample before = field.at(t0);
    for (float t = t0; t < t1 && look.through > 1e-4;) {
        const float room = std::clamp(0.4f / std::max(before.extinction, 1e-20f), 0.1f, 1.5f);
        const float stretch = std::min(float(1.0 / std::sqrt(std::sqrt(std::max(look.through, 1e-8)))), 3.0f);
        const float next = std::min(t + room * stretch, t1);
        const Field::Sample now = field.at(next);
        constexpr float kMaxBelow = 0.02f; // rims of dense balls are below 0
        float half = 0.5f * (next - t);
        half *= std::min(kMaxBelow / std::max(-half * (before.extinction + now.extinction), kMaxBelow), 1.0f);
        constexpr float kMoment = 1.0f / 6.0f;
        putBehind(look, {half * (before.extinction + now.extinction),
                         half * kMoment * (now.extinction - before.extinction),
                         half * (before.light + now.light), half * kMoment * (now.light - before.light)});
        before = now;
        t = next;
    }
    return look;
}

double depthOf(const Balls& balls)
{
    double sum = 0;
    for (const Ball& ball : balls) {
        const double h = double(ball.beside) / double(ball.radius);
        sum += double(ball.depth) * std::pow(std::max(1.0 - h * h, 0.0), 2.5);
    }
    return sum;
}

/// Light of media that emit `source`, from what they hide; relative to what comes from behind them.
double furnaceError(const Look& look, double opacity, double source)
{
    return std::fabs(look.light - source * opacity) / std::max(source * opacity, 1e-30);
}

constexpr float kVoxels = 6.0f; ///< radius of a ball in fields, as a view has it with 96 voxels

/// `count` balls in one place; every second is a fifth as bright.
Balls coincident(double count, double depth, float radius)
{
    Balls balls(size_t(count), {5.0f * radius, 0.3f * radius, radius, float(depth / count), 1.0f});
    for (size_t i = 1; i < balls.size(); i += 2)
        balls[i].source = 0.2f;
    return balls;
}

std::vector<StabilitySweep> coincidences(bool isQuick)
{
    const auto source = [](double count) { return count > 1.0 ? 0.6 : 1.0; };
    const StabilitySweep slabs{"slabs",
                               values("balls", {1, 2, 8, 64, 512}),
                               powersOfTen("tau", -6, 6, 4, isQuick),
                               1e-3,
                               false,
                               [source](double count, double depth) {
                                   const Balls balls = coincident(count, depth, 1.0f);
                                   return furnaceError(inSlabs(balls), -std::expm1(-depthOf(balls)),
                                                       source(count));
                               }};
    StabilitySweep volume = slabs;
    volume.name = "volume, 64 voxels";
    volume.x = values("balls", {1, 2, 8, 64});
    volume.error = [source](double count, double depth) {
        const Look look = marched(coincident(count, depth, kVoxels), 0.0f, 10.0f * kVoxels);
        return furnaceError(look, look.opacity(), source(count));
    };
    return {slabs, volume, controlOf(slabs, "one over the other", [source](double count, double depth) {
                Look look;
                const Balls balls = coincident(count, depth, 1.0f);
                for (const Ball& ball : balls) {
                    const double opacity = -std::expm1(-depthOf({ball}));
                    look.light += look.through * opacity * double(ball.source);
                    look.through *= 1.0 - opacity;
                }
                return furnaceError(look, look.opacity(), source(count));
            })};
}

/// `count` balls of radius `radius` about a place, all as bright.
Balls scattered(double count, double depth, float radius)
{
    SweepRandom random{uint64_t(count)};
    Balls balls;
    for (int i = 0; i < int(count); ++i)
        balls.push_back({float(random.between(2.0, 6.0)) * radius, float(random.between(0.0, 0.9)) * radius,
                         radius, 1.0f});
    const double scale = depth / depthOf(balls);
    for (Ball& ball : balls)
        ball.depth = float(scale);
    return balls;
}

std::vector<StabilitySweep> thickness(bool isQuick)
{
    const StabilitySweep slabs{"slabs",
                               powersOfTen("tau", -4, 7, 3, isQuick),
                               values("balls", {10, 100, 1000}),
                               5e-3,
                               false,
                               [](double depth, double count) {
                                   const Balls balls = scattered(count, depth, 1.0f);
                                   return furnaceError(inSlabs(balls), -std::expm1(-depthOf(balls)), 1.0);
                               }};
    StabilitySweep volume = slabs;
    volume.name = "volume";
    volume.y = values("balls", {10, 100});
    volume.error = [](double depth, double count) {
        const Look look = marched(scattered(count, depth, kVoxels), 0.0f, 8.0f * kVoxels);
        return furnaceError(look, look.opacity(), 1.0) + (look.through < 0.0 ? 1.0 : 0.0);
    };
    return {slabs, volume, controlOf(slabs, "opacities added", [](double depth, double count) {
                double light = 0.0;
                const Balls balls = scattered(count, depth, 1.0f);
                for (const Ball& ball : balls)
                    light += -std::expm1(-depthOf({ball}));
                return furnaceError({light, 0.0}, -std::expm1(-depthOf(balls)), 1.0);
            })};
}

std::vector<StabilitySweep> cuts(bool isQuick)
{
    const auto split = [](const auto& through, double at) {
        const double whole = through(-kFar, kFar);
        return std::fabs(through(-kFar, float(at)) * through(float(at), kFar) - whole);
    };
    const StabilitySweep slabs{
        "slabs",
        evenSteps("place [radius]", 0.5, 7.5, 200, isQuick),
        values("tau", {0.1, 1.0, 4.0}),
        1e-5,
        false,
        [split](double at, double depth) {
            const Balls balls = scattered(40, depth, 1.0f);
            return split([&](float t0, float t1) { return inSlabs(balls, t0, t1).through; }, at);
        }};
    StabilitySweep volume = slabs;
    volume.name = "volume";
    volume.limit = 5e-3;
    volume.error = [split](double at, double depth) {
        const Balls balls = scattered(40, depth, kVoxels);
        const auto through = [&](float t0, float t1) {
            return marched(balls, std::max(t0, 0.0f), std::min(t1, 8.0f * kVoxels)).through;
        };
        return split(through, at * double(kVoxels));
    };
    return {slabs, volume,
            controlOf(volume, "balls in front of the eye are whole", [split](double at, double depth) {
                const Balls balls = scattered(4, depth, 1.0f);
                const auto through = [&](float t0, float t1) {
                    Balls met;
                    for (const Ball& ball : balls)
                        if (ball.center + ball.radius > t0 && ball.center - ball.radius < t1)
                            met.push_back(ball);
                    return std::exp(-depthOf(met));
                };
                return split(through, at);
            })};
}

/// Sum of all samples of a ball over its integral; where lattices are interpolated linearly both are the
/// same.
double massError(double radius, double place, bool isWidened)
{
    const Ball ball{0.0f, 0.0f, float(radius), 1.0f};
    const int reach = int(std::ceil(std::max(radius, 2.0))) + 1;
    double sum = 0.0;
    for (int i = -reach; i <= reach; ++i)
        for (int j = -reach; j <= reach; ++j)
            for (int k = -reach; k <= reach; ++k) {
                const double x = i + place, y = j + 0.7 * place, z = k + 0.3 * place,
                             r2 = x * x + y * y + z * z;
                const double q = std::max(1.0 - r2 / (radius * radius), 0.0);
                sum += isWidened ? double(Field::extinctionOf(ball, float(r2))) : 0.9375 / radius * q * q;
            }
    const double exact = 0.9375 * radius * radius * 32.0 * std::numbers::pi / 105.0;
    return std::fabs(sum / exact - 1.0);
}

std::vector<StabilitySweep> sizes(bool isQuick)
{
    const StabilitySweep sweep{"mass of a ball in voxels",
                               powersOfTen("radius [voxel]", -3, 1.3, 6, isQuick),
                               evenSteps("place [voxel]", 0.0, 1.0, 10, isQuick),
                               0.05,
                               false,
                               [](double radius, double at) { return massError(radius, at, true); }};
    return {sweep, controlOf(sweep, "kernel where voxels are",
                             [](double radius, double at) { return massError(radius, at, false); })};
}

std::vector<StabilitySweep> distances(bool isQuick)
{
    const auto ballsAt = [](double away) {
        return Balls{{float(away) + 3.0f, 0.2f, 1.0f, 1.0f}, {float(away) + 3.5f, 0.4f, 1.5f, 0.5f}};
    };
    const StabilitySweep sweep{"slabs",
                               powersOfTen("distance [m]", 0, 7, 6, isQuick),
                               powersOfTen("near plane [m]", -6, 0, 2, isQuick),
                               1e-2,
                               false,
                               [ballsAt](double away, double near) {
                                   const Balls balls = ballsAt(away);
                                   return furnaceError(inSlabs(balls, float(near)),
                                                       -std::expm1(-depthOf(balls)), 1.0);
                               }};
    return {sweep,
            controlOf(sweep, "256 even steps from the near plane", [ballsAt](double away, double near) {
                const Balls balls = ballsAt(away);
                const double step = (away + 6.0 - near) / 256.0;
                double depth = 0.0;
                for (int i = 0; i < 256; ++i)
                    for (const Ball& ball : balls) {
                        const double z = near + (i + 0.5) * step - double(ball.center);
                        const double r = double(ball.radius), b = double(ball.beside);
                        const double q = std::max(1.0 - (z * z + b * b) / (r * r), 0.0);
                        depth += 0.9375 * double(ball.depth) / r * q * q * step;
                    }
                const double opacity = -std::expm1(-depth);
                return furnaceError({opacity, 1.0 - opacity}, -std::expm1(-depthOf(balls)), 1.0);
            })};
}

} // namespace

StabilityRows overlapStability()
{
    return {
        {"O-01", "many balls in one place are one of their sum", "the mean source times the opacity",
         coincidences},
        {"O-02", "thousands of balls of any optical depth", "1 - exp(-tau)", thickness},
        {"O-03", "the eye, or a plane, in many balls", "the whole ray", cuts},
        {"O-04", "balls of any size in voxels", "the integral of the kernel", sizes},
        {"O-05", "far balls, any near plane", "1 - exp(-tau)", distances},
    };
}

} // namespace fx::cli
