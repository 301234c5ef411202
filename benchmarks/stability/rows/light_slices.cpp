/// @file light_slices.cpp
/// LS-01 to LS-08: planes of optical depth across lights of every kind and place.

#include "benchmarks/scenes/slice_forms.h"
#include "benchmarks/stability/stability_row.h"
#include "rendering/lights/slices/light_list.h"
#include "rendering/lights/slices/slice_depths.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <memory_resource>
#include <numbers>

namespace fx::cli {
namespace {

using render::MediumCaster;
using render::SliceDepths;
using render::SliceResolution;
using render::SliceStack;

constexpr double kPi = std::numbers::pi;

/// One ball of radius 1 in the middle. @param depth [1] through its middle
std::vector<MediumCaster> ball(double depth)
{
    return {{glm::vec3(0.0f), 1.0f, float(depth * kPi / 3.5)}};
}

SliceDepths filled(const SliceStack& stack, std::span<const MediumCaster> casters)
{
    SliceDepths depths(std::pmr::new_delete_resource());
    depths.build(stack, casters);
    return depths;
}

/// Transmittance on the way along x through the middle of a ball, with as many planes.
double alongX(int planes, double depth, double x)
{
    const auto casters = ball(depth);
    SliceStack stack;
    if (!render::fitParallelSlices({-1, 0, 0}, casters, glm::dvec3(0.0), {256, planes}, stack))
        return 1.0;
    return std::exp(-double(filled(stack, casters).depthAt({float(x), 0.0f, 0.0f}).toLight));
}

double exactAlongX(double depth, double x)
{
    const render::BlobMedium medium = mediumOf(ball(depth));
    return std::exp(-medium.opticalDepth({{-2.0, 0.0, 0.0}, {1.0, 0.0, 0.0}}, 0.0, x + 2.0));
}

/// Planes from the first to the last place of the medium, as many as asked for.
double plainAlongX(int planes, double depth, double x)
{
    const double spacing = 2.0 / double(planes - 1);
    const double place = (x + 1.0) / spacing;
    const double lower = std::floor(place);
    const auto stored = [&](double k) { return -std::log(exactAlongX(depth, -1.0 + k * spacing)); };
    return std::exp(-(stored(lower) + (place - lower) * (stored(lower + 1.0) - stored(lower))));
}

std::vector<StabilitySweep> noSlices(bool isQuick)
{
    const StabilitySweep sweep{"no planes, no shadow",
                               values("planes", {0, -1, -7}),
                               powersOfTen("tau", -6, 6, 5, isQuick),
                               0.0,
                               false,
                               [](double planes, double depth) {
                                   double worst = 0.0;
                                   for (const double x : {-2.0, 0.0, 0.3, 2.0})
                                       worst =
                                           std::fmax(worst, std::fabs(alongX(int(planes), depth, x) - 1.0));
                                   return worst;
                               }};
    return {sweep, controlOf(sweep, "extent over planes - 1", [](double planes, double depth) {
                return std::fabs(plainAlongX(int(planes), depth, 0.3) - 1.0);
            })};
}

std::vector<StabilitySweep> oneSlice(bool isQuick)
{
    const auto error = [](double (*transmittance)(int, double, double)) {
        return [transmittance](double planes, double x) {
            const double got = transmittance(int(planes), 2.0, x);
            if (std::fabs(x) > 3.4) // before or behind all planes
                return std::fabs(got - exactAlongX(2.0, x));
            return got >= 0.0 && got <= 1.0 ? 0.0 : std::numeric_limits<double>::infinity();
        };
    };
    const StabilitySweep sweep{"before and behind a ball",
                               values("planes", {1, 2, 3}),
                               evenSteps("place [radius]", -6.0, 6.0, 120, isQuick),
                               1e-4,
                               false,
                               error(alongX)};
    return {sweep, controlOf(sweep, "extent over planes - 1", error(plainAlongX))};
}

/// Even directions.
glm::dvec3 direction(int i, int count)
{
    const double z = 1.0 - 2.0 * (i + 0.5) / count, across = std::sqrt(1.0 - z * z);
    const double turn = kPi * (3.0 - std::sqrt(5.0)) * i;
    return {across * std::cos(turn), across * std::sin(turn), z};
}

/// Light in a shell of air around a light, summed over all distances up to 3 m, relative to the exact sum.
double radialError(const SliceStack& stack, const glm::vec3& light, double depth)
{
    const auto casters = ball(depth);
    const render::BlobMedium medium = mediumOf(casters);
    const SliceDepths depths = filled(stack, casters);
    double got = 0.0, wanted = 0.0;
    constexpr int kDirections = 60, kSteps = 60;
    for (int i = 0; i < kDirections; ++i)
        for (int s = 0; s < kSteps; ++s) {
            const glm::dvec3 d = direction(i, kDirections);
            const double length = 3.0 * (s + 0.5) / kSteps;
            const glm::vec3 p = light + glm::vec3(d * length);
            got += std::exp(-double(depths.depthAt(p).toLight));
            wanted += std::exp(-medium.opticalDepth({glm::dvec3(light), d}, 0.0, length));
        }
    const double atLight = std::fabs(std::exp(-double(depths.depthAt(light).toLight)) - 1.0);
    return std::fmax(std::fabs(got / wanted - 1.0), atLight);
}

std::vector<StabilitySweep> lightInside(bool isQuick)
{
    const glm::vec3 towards = glm::normalize(glm::vec3(0.6f, 0.5f, -0.3f));
    const StabilitySweep sweep{
        "radial integral, 64 texels and shells",
        evenSteps("place of the light [radius]", 0.0, 1.2, 12, isQuick),
        powersOfTen("tau", -1, 0.7, 3, isQuick),
        1e-3,
        false,
        [towards](double place, double depth) {
            const glm::vec3 light = float(place) * towards;
            SliceStack stack;
            render::fitPointSlices(light, 0.0f, ball(depth), glm::dvec3(0.0), {64, 64}, stack);
            return radialError(stack, light, depth);
        }};
    return {sweep, controlOf(sweep, "flat planes through the light", [towards](double place, double depth) {
                SliceStack stack;
                render::fitParallelSlices(towards, ball(depth), glm::dvec3(0.0), {64, 64}, stack);
                return radialError(stack, float(place) * towards, depth);
            })};
}

/// Transmittances at points of a cloud as light goes around it, and how much they change in a step.
class LightSweep
{
public:
    LightSweep(int planes, int texels)
        : casters_(lightCloud(20, 2.0)), points_(pointsWithin(casters_, 48)), planes_(planes), texels_(texels)
    {
        const render::BlobMedium medium = mediumOf(casters_);
        for (int i = 0; i < 90; ++i) {
            const auto at = [&](double angle) {
                SliceStack stack;
                stack.along = -towards(angle);
                std::vector<double> picture;
                for (const glm::vec3& point : points_)
                    picture.push_back(std::exp(-shadowRayDepth(medium, stack, point)));
                return picture;
            };
            exact_.push_back(difference(at(4.0 * i), at(4.0 * i + 0.1)) * 10.0);
        }
        std::vector<double> sorted = exact_;
        std::nth_element(sorted.begin(), sorted.begin() + 45, sorted.end());
        median_ = sorted[45];
    }

    /// In a step up to `angle`, beyond that of exact shadows, in units of their median change.
    double change(double angle, double step)
    {
        if (lastAngle_ != angle - step)
            last_ = at(angle - step);
        std::vector<double> now = at(angle);
        const double place = std::fmod(angle + 360.0, 360.0) / 4.0, part = place - std::floor(place);
        const double exact =
            exact_[size_t(place) % 90] * (1.0 - part) + exact_[(size_t(place) + 1) % 90] * part;
        const double excess = std::fmax(difference(last_, now) / step - exact, 0.0) / median_;
        last_ = std::move(now);
        lastAngle_ = angle;
        return excess;
    }

    /// [1] how far an axis half way between view and light turns in a step, relative to half of the step.
    static double turnOfHalfVector(double angle, double step)
    {
        const auto half = [](double degrees) {
            const glm::vec3 sum = towards(degrees) + towards(0.0);
            return sum / glm::length(sum);
        };
        return double(glm::length(half(angle) - half(angle - step))) / (0.5 * step * kPi / 180.0);
    }

private:
    /// In a plane that meets no axis of the world.  @param angle [degree]
    static glm::vec3 towards(double angle)
    {
        const glm::vec3 a = glm::normalize(glm::vec3(0.9f, 0.3f, -0.2f));
        const glm::vec3 b = glm::normalize(glm::cross(a, glm::vec3(0.2f, 0.1f, 1.0f)));
        const double radian = angle * kPi / 180.0;
        return glm::normalize(a * float(std::cos(radian)) + b * float(std::sin(radian)));
    }

    std::vector<double> at(double angle)
    {
        SliceStack stack;
        render::fitParallelSlices(towards(angle), casters_, glm::dvec3(0.0), {texels_, planes_}, stack);
        SliceField field({SliceForm::Kind::Planes, planes_}, stack, casters_);
        std::vector<double> picture;
        for (const glm::vec3& point : points_)
            picture.push_back(std::exp(-field.depthAt(point)));
        return picture;
    }

    static double difference(const std::vector<double>& a, const std::vector<double>& b)
    {
        double sum = 0.0;
        for (size_t i = 0; i < a.size(); ++i)
            sum += std::fabs(a[i] - b[i]);
        return sum / double(a.size());
    }

    std::vector<MediumCaster> casters_;
    std::vector<glm::vec3> points_;
    int planes_, texels_;
    std::vector<double> exact_; ///< [1/degree] change of exact shadows, every 4 degrees
    double median_ = 0.0;       ///< [1/degree] of exact_
    double lastAngle_ = std::numeric_limits<double>::quiet_NaN();
    std::vector<double> last_;
};

std::vector<StabilitySweep> turningLight(bool isQuick)
{
    const auto sweepOf = [isQuick](const char* name, double step, int planes, int texels, double limit) {
        auto sweep = std::make_shared<LightSweep>(planes, texels);
        return StabilitySweep{name,
                              evenSteps("angle [degree]", 0.0, 360.0, uint32_t(360.0 / step), isQuick),
                              values("step [degree]", {step}),
                              limit,
                              false,
                              [sweep](double angle, double s) { return sweep->change(angle, s); }};
    };
    const StabilitySweep coarse = sweepOf("change in half a degree, 32 planes", 0.5, 32, 128, 0.5);
    const StabilitySweep fine = sweepOf("change in a hundredth, 128 planes", 0.01, 128, 512, 2.0);
    return {coarse, fine, controlOf(coarse, "half way between view and light", LightSweep::turnOfHalfVector)};
}

/// Largest error of transmittance in a cloud before a light.
double errorAt(const glm::vec3& light, const SliceStack& stack, std::span<const MediumCaster> casters)
{
    SliceStack exact = stack;
    exact.origin = light;
    exact.begin = 0.0f;
    const render::BlobMedium medium = mediumOf(casters);
    SliceField field({SliceForm::Kind::Planes, stack.resolution.planes}, stack, casters);
    double worst = 0.0;
    for (const glm::vec3& point : pointsWithin(casters, 40))
        worst = std::fmax(worst, std::fabs(std::exp(-field.depthAt(point)) -
                                           std::exp(-shadowRayDepth(medium, exact, point))));
    return worst;
}

std::vector<StabilitySweep> placesOfLights(bool isQuick)
{
    const auto placed = [](double distance, double side) {
        return glm::vec3(direction(int(side), 8) * distance);
    };
    const StabilitySweep sweep{
        "64 shells, fine texels",
        powersOfTen("distance [m]", -6, 3, 4, isQuick),
        evenSteps("side", 0, 7, 7, false),
        0.02,
        false,
        [placed](double distance, double side) {
            const auto casters = lightCloud(30, 2.0);
            const glm::vec3 light = placed(distance, side);
            SliceStack stack;
            render::fitPointSlices(light, 0.0f, casters, glm::dvec3(0.0), {512, 64}, stack);
            stack.resolution.texels = int(4.0 * (distance + 1.5) / (double(stack.spacing) / 8.0));
            return errorAt(light, stack, casters);
        }};
    const StabilitySweep atCenters{
        "at the center of each ball",
        evenSteps("ball", 0, 29, 29, isQuick),
        powersOfTen("tau", -1, 1, 2, isQuick),
        0.02,
        false,
        [](double which, double depth) {
            const auto casters = lightCloud(30, depth);
            const glm::vec3 light = casters[size_t(which)].center;
            SliceStack stack;
            render::fitPointSlices(light, 0.0f, casters, glm::dvec3(0.0), {512, 64}, stack);
            return errorAt(light, stack, casters);
        }};
    return {sweep, atCenters, controlOf(sweep, "flat planes", [placed](double distance, double side) {
                const auto casters = lightCloud(30, 2.0);
                const glm::vec3 light = placed(distance, side);
                SliceStack flat, shells;
                render::fitParallelSlices(glm::normalize(light), casters, glm::dvec3(0.0), {512, 64}, flat);
                render::fitPointSlices(light, 0.0f, casters, glm::dvec3(0.0), {512, 64}, shells);
                const render::BlobMedium medium = mediumOf(casters);
                SliceField field({SliceForm::Kind::Planes, 64}, flat, casters);
                double worst = 0.0;
                for (const glm::vec3& point : pointsWithin(casters, 40))
                    worst = std::fmax(worst, std::fabs(std::exp(-field.depthAt(point)) -
                                                       std::exp(-shadowRayDepth(medium, shells, point))));
                return worst;
            })};
}

/// How many numbers of a list of lights are none, and whether a light of the given strength changed another.
double brokenNumbers(double intensity, double distance)
{
    render::ViewSettings settings;
    settings.lighting.sunIlluminance = glm::vec3(1e5f);
    settings.lighting.sunDirection = {0, 1, 0};
    settings.hostLights.count = 2;
    settings.hostLights.lights[0].position = {distance, 0.0, 0.0};
    settings.hostLights.lights[0].intensity = glm::vec3(float(intensity));
    settings.hostLights.lights[1].position = {0.0, 3.0, 0.0};
    settings.hostLights.lights[1].intensity = glm::vec3(10.0f);
    const auto casters = lightCloud(20, 1.0);
    render::LightList list(std::pmr::new_delete_resource());
    list.build({&settings, glm::dvec3(0.0), {}, casters});
    double broken = 0.0;
    bool hasOther = false;
    for (const render::SliceLightBlock& light : list.lights()) {
        hasOther = hasOther || (light.color.w > 0.5f && light.color.x > 0.0f && light.place.y == 3.0f);
        for (const glm::vec4& v : {light.right, light.up, light.along, light.tiles, light.color, light.place})
            for (int c = 0; c < 4; ++c)
                broken += std::isfinite(v[c]) ? 0.0 : 1.0;
    }
    return broken + (hasOther ? 0.0 : 1.0);
}

std::vector<StabilitySweep> strengths(bool)
{
    const double nan = std::numeric_limits<double>::quiet_NaN(),
                 inf = std::numeric_limits<double>::infinity();
    const StabilitySweep sweep{"numbers that are none",
                               values("intensity [cd]", {0.0, 1e-38, 1e-30, 1.0, 1e30, inf, -inf, nan}),
                               values("distance [m]", {0.0, 1e-20, 1.0, 1e6, 1e30, nan}),
                               0.0,
                               false,
                               brokenNumbers};
    return {sweep, controlOf(sweep, "intensity over squared distance", [](double intensity, double distance) {
                const double light = intensity / (distance * distance);
                return std::isfinite(light) ? 0.0 : 1.0;
            })};
}

/// Distance of the fitted order of a curve of errors from 2.
double orderError(double depth, double side, bool isClipped)
{
    const auto casters = lightCloud(30, depth);
    const render::BlobMedium medium = mediumOf(casters);
    double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
    for (const int planes : {16, 32, 64, 128}) {
        SliceStack stack;
        render::fitParallelSlices(glm::vec3(direction(int(side), 8)), casters, glm::dvec3(0.0), {512, planes},
                                  stack);
        const SliceForm form{SliceForm::Kind::Planes, planes};
        double sum = 0.0;
        for (const glm::vec3& point : pointsWithin(casters, 400)) {
            const render::SlicePlace place = stack.placeOf(point);
            const render::SliceRay ray = render::sliceRay(stack, place.x, place.y); // texels have no part
            double got = 0.0;
            if (isClipped) {
                got = double(
                    columnDepth(form, makeColumn(form, stack, ray, casters), place.plane * stack.spacing));
            } else { // whole balls from the plane behind their center on
                for (const MediumCaster& caster : casters) {
                    const float center = glm::dot(caster.center - ray.start, ray.direction) / stack.spacing;
                    if (std::ceil(center) <= std::floor(place.plane))
                        got += mediumOf({&caster, 1})
                                   .opticalDepth({glm::dvec3(ray.start), glm::dvec3(ray.direction)}, -10.0,
                                                 10.0);
                }
            }
            sum += std::fabs(std::exp(-got) - std::exp(-shadowRayDepth(medium, stack, point)));
        }
        const double x = std::log(double(stack.spacing)), y = std::log(sum);
        n += 1.0;
        sx += x;
        sy += y;
        sxx += x * x;
        sxy += x * y;
    }
    return std::fabs((n * sxy - sx * sy) / (n * sxx - sx * sx) - 2.0);
}

std::vector<StabilitySweep> orders(bool isQuick)
{
    const StabilitySweep sweep{"order - 2, 16 to 128 planes",
                               powersOfTen("tau", -2, 1, 2, isQuick),
                               evenSteps("side", 0, 7, 7, false),
                               0.2,
                               false,
                               [](double depth, double side) { return orderError(depth, side, true); }};
    return {sweep, controlOf(sweep, "whole balls, in front or not",
                             [](double depth, double side) { return orderError(depth, side, false); })};
}

/// Share of a spot's light as shaders/shared/light_slices.glsl has it.
double shareOf(double inner, double outer, double angle)
{
    render::ViewSettings settings;
    settings.hostLights.count = 1;
    render::HostLight& light = settings.hostLights.lights[0];
    light.intensity = glm::vec3(1.0f);
    light.axis = {0, -1, 0};
    light.cosInner = float(std::cos(inner * kPi / 180.0));
    light.cosOuter = float(std::cos(outer * kPi / 180.0));
    render::LightList list(std::pmr::new_delete_resource());
    list.build({&settings, glm::dvec3(0.0), {}, {}});
    const glm::vec4 cone = list.lights()[1].cone; // the first is the sun, also where there is none
    const glm::vec3 towards(std::sin(angle * kPi / 180.0), std::cos(angle * kPi / 180.0), 0.0);
    const float x = std::clamp(cone.w - glm::dot(towards, glm::vec3(cone)), 0.0f, 1.0f);
    return double(x * (x * (3.0f - 2.0f * x)));
}

/// 1 within, 0 outside, and between them where there is a rim.
double profileError(double inner, double outer, double (*share)(double, double, double))
{
    double worst = 0.0;
    for (double angle = 0.0; angle <= 180.0; angle += 1.5) {
        const double got = share(inner, outer, angle);
        constexpr double kRim = 1.0; // [degree] the narrowest that is drawn
        double wanted = got;
        if (angle > outer + kRim && outer < 180.0)
            wanted = 0.0;
        else if (angle < std::min(inner, outer) - kRim)
            wanted = 1.0;
        else if (!(got >= 0.0 && got <= 1.0))
            wanted = std::numeric_limits<double>::infinity();
        worst = std::fmax(worst, got == wanted ? 0.0 : std::fabs(got - wanted));
    }
    return worst;
}

std::vector<StabilitySweep> profiles(bool isQuick)
{
    const StabilityAxis inner = evenSteps("inner angle [degree]", 0.0, 180.0, 30, isQuick);
    const StabilityAxis outer = evenSteps("outer angle [degree]", 0.0, 180.0, 30, isQuick);
    const StabilitySweep sweep{
        "spots with rims of any width, also none", inner, outer, 1e-3, false, [](double a, double b) {
            return profileError(a, b, shareOf);
        }};
    return {sweep, controlOf(sweep, "divided by the width", [](double a, double b) {
                return profileError(a, b, [](double in, double out, double angle) {
                    const auto cosine = [](double degree) { return std::cos(degree * kPi / 180.0); };
                    return std::clamp((cosine(angle) - cosine(out)) / (cosine(in) - cosine(out)), 0.0, 1.0);
                });
            })};
}

} // namespace

StabilityRows lightSlicesStability()
{
    return {
        {"LS-01", "no planes, no shadow", "1", noSlices},
        {"LS-02", "one plane is defined", "the exact integral before and behind", oneSlice},
        {"LS-03", "a light within the medium", "the exact radial integral", lightInside},
        {"LS-04", "light that turns around the scene", "change of exact shadows, in units of its median",
         turningLight},
        {"LS-05", "lights at any distance, and at the center of a ball", "exact integral", placesOfLights},
        {"LS-06", "lights of any strength", "finite numbers", strengths},
        {"LS-07", "errors fall with the square of the planes' distance", "exact integral", orders},
        {"LS-08", "profiles of spots", "1 within, 0 outside", profiles},
    };
}

} // namespace fx::cli
