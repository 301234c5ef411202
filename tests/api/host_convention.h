/// @file host_convention.h
/// Units and axes of hosts, for tests: what a host of another world passes and expects, computed by vectors
/// along its axes, in another way than the library converts.
#pragma once

#include "fxsdk/fxsdk.h"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <ostream>
#include <vector>

namespace fx::test {

struct HostConvention
{
    const char* name;
    double unitsPerMeter;
    FxAxis right, up, forward;

    FxContextDef contextDef() const
    {
        FxContextDef def = fxDefaultContextDef();
        def.workers = 1;
        def.unitsPerMeter = unitsPerMeter;
        def.rightAxis = right;
        def.upAxis = up;
        def.forwardAxis = forward;
        return def;
    }

    static glm::dvec3 unit(FxAxis axis)
    {
        glm::dvec3 out(0.0);
        out[int(axis) % 3] = axis < FX_AXIS_NEGATIVE_X ? 1.0 : -1.0;
        return out;
    }
    bool isLeftHanded() const { return glm::dot(glm::cross(unit(right), unit(up)), unit(forward)) > 0.0; }
    /// The direction that the library has as `d`.
    glm::dvec3 direction(const glm::dvec3& d) const
    {
        return d.x * unit(right) + d.y * unit(up) - d.z * unit(forward) + 0.0; // no negative zeros
    }
    glm::dvec3 vector(const glm::dvec3& v) const { return unitsPerMeter * direction(v); }
    glm::quat rotation(const glm::quat& q) const
    {
        const glm::vec3 axis(direction({q.x, q.y, q.z}) * (isLeftHanded() ? -1.0 : 1.0) + 0.0);
        return {q.w, axis.x, axis.y, axis.z};
    }
    /// @param matrix of positions of the library, as many meters as numbers
    glm::mat4 ofWorld(const glm::mat4& matrix, bool toEye) const
    {
        glm::mat4 out(1.0f);
        const double scale = toEye ? 1.0 : 1.0 / unitsPerMeter;
        for (int i = 0; i < 3; ++i) {
            glm::dvec3 axis(0.0);
            axis[i] = 1.0;
            const glm::dvec3 inLibrary(glm::dot(axis, unit(right)), glm::dot(axis, unit(up)),
                                       -glm::dot(axis, unit(forward)));
            out[i] = glm::vec4(glm::dmat4(matrix) * glm::dvec4(inLibrary, 0.0) * scale);
        }
        out[3] = matrix[3];
        if (toEye)
            out[3] = glm::vec4(glm::vec3(glm::dvec3(matrix[3]) * unitsPerMeter), 1.0f);
        return out;
    }
    glm::mat4 projection(glm::mat4 matrix) const
    {
        if (matrix[2].w != 0.0f)
            matrix[3] = glm::vec4(glm::dvec4(matrix[3]) * unitsPerMeter);
        else
            for (int i = 0; i < 3; ++i)
                matrix[i] = glm::vec4(glm::dvec4(matrix[i]) / unitsPerMeter);
        return matrix;
    }

    template <class Number>
    void set(Number* out, const glm::dvec3& value) const
    {
        for (int i = 0; i < 3; ++i)
            out[i] = Number(value[i]);
    }
};

inline std::ostream& operator<<(std::ostream& out, const HostConvention& convention)
{
    return out << convention.name;
}

constexpr HostConvention kLibraryWorld{"library", 1.0, FX_AXIS_X, FX_AXIS_Y, FX_AXIS_NEGATIVE_Z};

/// Units that convert without rounding.
constexpr std::array<HostConvention, 6> kExactWorlds{{
    {"Unity", 1.0, FX_AXIS_X, FX_AXIS_Y, FX_AXIS_Z},
    {"Blender", 1.0, FX_AXIS_X, FX_AXIS_Z, FX_AXIS_Y},
    {"axes of Unreal", 128.0, FX_AXIS_Y, FX_AXIS_Z, FX_AXIS_X},
    {"axes of Source", 32.0, FX_AXIS_NEGATIVE_Y, FX_AXIS_Z, FX_AXIS_X},
    {"only units", 0.5, FX_AXIS_X, FX_AXIS_Y, FX_AXIS_NEGATIVE_Z},
    {"all turned", 0.25, FX_AXIS_NEGATIVE_Z, FX_AXIS_NEGATIVE_X, FX_AXIS_NEGATIVE_Y},
}};

constexpr std::array<HostConvention, 2> kRoundedWorlds{{
    {"Unreal", 100.0, FX_AXIS_Y, FX_AXIS_Z, FX_AXIS_X},
    {"Source", 39.37007874, FX_AXIS_NEGATIVE_Y, FX_AXIS_Z, FX_AXIS_X},
}};

/// All 48 worlds of three axes, with units of 1 cm.
inline std::vector<HostConvention> allWorlds()
{
    std::vector<HostConvention> out;
    for (int right = 0; right < 6; ++right)
        for (int up = 0; up < 6; ++up)
            for (int forward = 0; forward < 6; ++forward)
                if (right % 3 != up % 3 && right % 3 != forward % 3 && up % 3 != forward % 3)
                    out.push_back({"signed axes", 100.0, FxAxis(right), FxAxis(up), FxAxis(forward)});
    return out;
}

} // namespace fx::test
