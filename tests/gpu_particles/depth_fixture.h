/// @file depth_fixture.h
/// Particles of steppedText() under a camera that sees planes, and error bounds of their contacts.
#pragma once

#include "gpu_fixture.h"
#include "module_cases.h"
#include "seen_planes.h"

#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

namespace fx::test {

namespace column = base::particle_column;

inline constexpr int kWidth = 160, kHeight = 120;
inline constexpr float kAspect = float(kWidth) / float(kHeight);
/// [m/s] largest speed of particles of steppedText() at their first contact
inline constexpr double kFastest = 9.0;

/// A camera above the emitter of steppedText(). All particles of the emitter are visible.
inline const render::CameraPose kAbove{{1.5, 8.0, 9.0}, {0.3, 0.0, 0.6}};

struct CameraCase
{
    const char* name;
    render::CameraView camera;
};

inline std::vector<CameraCase> cameras()
{
    render::CameraView zeroToOne = render::perspectiveView(kAbove, 1.3f, kAspect, 1.0f);
    zeroToOne.projection[3][2] = -1.0f; // clip depth = 1 - near / distance
    zeroToOne.zeroToOne = true;
    render::CameraView flipped = render::perspectiveView(kAbove, 1.3f, kAspect, 1.0f);
    flipped.upperLeftOrigin = true;
    render::CameraView shifted =
        render::perspectiveView(kAbove, 1.3f, kAspect, 0.5f, render::DepthConvention::Reversed);
    shifted.projection[2][0] = 0.1f; // the axis is not in the middle
    shifted.projection[2][1] = -0.07f;
    return {
        {"perspective", render::perspectiveView(kAbove, 1.3f, kAspect, 1.0f)},
        {"reversed", render::perspectiveView(kAbove, 1.3f, kAspect, 0.1f, render::DepthConvention::Reversed)},
        {"zero to one", zeroToOne},
        {"upper left", flipped},
        {"shifted", shifted},
        {"parallel", render::orthographicView(kAbove, 16.0f, kAspect, 0.5f, 40.0f)}};
}

struct PlaneCase
{
    const char* name;
    glm::dvec3 normal;
    double offset;
};
inline const PlaneCase kPlanes[] = {{"level", {0, 1, 0}, 0.0},
                                    {"tilted", glm::normalize(glm::dvec3(0.3, 1, 0.2)), 0.1},
                                    {"steep", glm::normalize(glm::dvec3(-0.5, 1, 0.4)), 0.2}};

inline std::string planeMember(const PlaneCase& plane, const std::string& answer)
{
    const glm::dvec3 place = plane.normal * plane.offset;
    const auto vectorOf = [](const glm::dvec3& v) {
        char text[120];
        std::snprintf(text, sizeof text, "[%.9g, %.9g, %.9g]", v.x, v.y, v.z);
        return std::string(text);
    };
    return R"("collisions": [{"shape": "plane", "axis": )" + vectorOf(plane.normal) + R"(, "position": )" +
           vectorOf(place) + ", " + answer + "}]";
}

inline std::string depthMember(const std::string& answer)
{
    return R"("collisions": [{"shape": "depth", )" + answer + "}]";
}

inline glm::dvec3 placeOf(const Rows& rows, size_t i)
{
    return {rows.columns[column::PositionX][i], rows.columns[column::PositionY][i],
            rows.columns[column::PositionZ][i]};
}

/// [m] Error bound of formula depth-contact for the position of a particle, `seconds` [s] after its first
/// contact. Every contact at least halves the speed. The error of the first contact has two parts: a shift of
/// 3 e, which a bounce at most doubles, and an error of the direction. The direction is wrong by twice the
/// angular error of the normal. The sum of all contacts has less than four times this error.
inline double boundOf(const render::CameraView& camera, double distance, double seconds)
{
    const DepthResolution at = resolutionAt(camera, kHeight, distance);
    const double shift = 3.0 * at.error, turn = 2.0 * at.texture / at.pixel;
    return 4.0 * (2.0 * shift + 2.0 * turn * kFastest * seconds);
}

class GpuDepthContacts : public GpuParticleTest
{
protected:
    void see(const render::CameraView& camera, const std::vector<SeenPlane>& planes)
    {
        makeTargets(kWidth, kHeight);
        setDepth(depthOf(camera, kWidth, kHeight, planes));
        depthCamera_ = camera;
        states_ = makeStates();
    }
    /// [m] Largest difference of positions. `outLiving` is the number of compared particles, `outLonely` the
    /// number of particles that are alive only on CPU or only on GPU.
    double worstOf(const Rows& cpu, const Rows& gpu, size_t& outLiving, size_t& outLonely)
    {
        double worst = 0.0;
        outLiving = outLonely = 0;
        for (size_t i = 0; i < gpu.count(); ++i) {
            const bool isAlive = i < cpu.count() && cpu.isAlive(i);
            outLonely += gpu.isAlive(i) != isAlive ? 1 : 0;
            if (!isAlive || !gpu.isAlive(i))
                continue;
            ++outLiving;
            const double difference = glm::length(placeOf(cpu, i) - placeOf(gpu, i));
            worst = std::max(worst, std::isfinite(difference) ? difference : 1e9);
        }
        return worst;
    }
    /// [m] Tolerance for positions of equal motion on CPU and GPU. It is 0 for llvmpipe, which rounds like
    /// the CPU, and 1e-4 for other drivers.
    double sameWithin() const
    {
        return device_->limits().renderer.find("llvmpipe") != std::string::npos ? 0.0 : 1e-4;
    }
    /// Expects equal motion on CPU and GPU, for particles without contacts.
    void expectSame(const Rows& cpu, const Rows& gpu)
    {
        size_t living = 0, lonely = 0;
        const double worst = worstOf(cpu, gpu, living, lonely);
        EXPECT_LE(worst, sameWithin());
        EXPECT_EQ(lonely, 0u);
        EXPECT_GT(living, 30u);
    }
    Rows playedOnCpu(const std::string& members, double seconds)
    {
        OneEffect cpu(schema_, load(steppedText(members, "cpu")), false);
        cpu.playTo(seconds);
        return rowsOf(cpu.publish().group(0));
    }
    Rows playedOnGpu(const std::string& members, double seconds)
    {
        OneEffect gpu(schema_, load(steppedText(members, "gpu")), true);
        gpu.playTo(seconds);
        return computed(gpu.publish().group(0));
    }
    static constexpr const char* kFewThatLast =
        R"("lifetime": 4, "maxParticles": 500, "emission": {"rate": 100, "duration": 0.5})";
    /// Members of a preset without obstacles and with motion that is integrated in steps.
    static constexpr const char* kFree = R"("collisions": [{"shape": "hook"}])";
};

} // namespace fx::test
