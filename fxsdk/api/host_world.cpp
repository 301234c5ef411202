#include "fxsdk/api/host_world.h"

#include "fxsdk/api/check.h"

#include <glm/gtc/type_ptr.hpp>

#include <array>
#include <cmath>
#include <cstdio>

namespace fx::api {

namespace {

constexpr double kFewestUnits = 1e-3; ///< [1/m] kilometers
constexpr double kMostUnits = 1e6;    ///< [1/m] micrometers

static_assert(FX_AXIS_NEGATIVE_X == FX_AXIS_X + 3 && FX_AXIS_NEGATIVE_Z == FX_AXIS_Z + 3);

int indexOf(uint32_t axis)
{
    return int(axis % 3);
}

float signOf(uint32_t axis)
{
    return axis < FX_AXIS_NEGATIVE_X ? 1.0f : -1.0f;
}

} // namespace

base::Status HostWorld::check(const FxContextDef& def)
{
    if (!(def.unitsPerMeter >= kFewestUnits && def.unitsPerMeter <= kMostUnits)) {
        std::array<char, 200> text;
        std::snprintf(
            text.data(), text.size(),
            "def.unitsPerMeter is %g: give the number of the host's units of length in a meter, %g to "
            "%g, such as 100 for centimeters",
            def.unitsPerMeter, kFewestUnits, kMostUnits);
        return invalid(text.data());
    }
    Checks check;
    check.range(def.rightAxis, uint32_t(FX_AXIS_X), uint32_t(FX_AXIS_NEGATIVE_Z), "def.rightAxis (FxAxis)");
    check.range(def.upAxis, uint32_t(FX_AXIS_X), uint32_t(FX_AXIS_NEGATIVE_Z), "def.upAxis (FxAxis)");
    check.range(def.forwardAxis, uint32_t(FX_AXIS_X), uint32_t(FX_AXIS_NEGATIVE_Z),
                "def.forwardAxis (FxAxis)");
    check.range(def.reserved, 0u, 0u, "def.reserved");
    const int right = indexOf(def.rightAxis), up = indexOf(def.upAxis), forward = indexOf(def.forwardAxis);
    check.that(
        right != up && right != forward && up != forward,
        "def.rightAxis, def.upAxis and def.forwardAxis are not along three different axes: give one along "
        "X, one along Y and one along Z, each with either sign");
    return check.status();
}

HostWorld::HostWorld(const FxContextDef& def)
    : unitsPerMeter_(def.unitsPerMeter), axes_{indexOf(def.rightAxis), indexOf(def.upAxis),
                                               indexOf(def.forwardAxis)},
      signs_{signOf(def.rightAxis), signOf(def.upAxis), -signOf(def.forwardAxis)}
{
    // The last sign is negated because the library's -Z is forward.
    const bool isCyclic = (axes_[0] + 1) % 3 == axes_[1];
    determinant_ = signs_[0] * signs_[1] * signs_[2] * (isCyclic ? 1.0f : -1.0f);
    isLibraryWorld_ =
        unitsPerMeter_ == 1.0 && axes_ == std::array{0, 1, 2} && signs_ == std::array{1.0f, 1.0f, 1.0f};
}

glm::quat HostWorld::rotation(const float* xyzw) const
{
    glm::quat out(xyzw[3], 0.0f, 0.0f, 0.0f);
    out.x = flipped(determinant_ * signs_[0], xyzw[axes_[0]]); // (3)
    out.y = flipped(determinant_ * signs_[1], xyzw[axes_[1]]);
    out.z = flipped(determinant_ * signs_[2], xyzw[axes_[2]]);
    return out;
}

glm::mat4 HostWorld::view(const float* matrix) const
{
    if (isLibraryWorld_)
        return glm::make_mat4(matrix);
    const glm::mat4 host = glm::make_mat4(matrix);
    glm::mat4 out(1.0f);
    for (int i = 0; i < 3; ++i)
        out[i] = flipped(signs_[size_t(i)], host[axes_[size_t(i)]]);                // (5)
    out[3] = glm::vec4(glm::vec3(glm::dvec3(host[3]) / unitsPerMeter_), host[3].w); // (5)
    return out;
}

glm::mat4 HostWorld::projection(const float* matrix) const
{
    if (isLibraryWorld_)
        return glm::make_mat4(matrix);
    glm::mat4 out = glm::make_mat4(matrix);
    const bool isPerspective = std::abs(matrix[11]) > std::abs(matrix[15]);
    if (isPerspective)
        out[3] = glm::vec4(glm::dvec4(out[3]) / unitsPerMeter_); // (6)
    for (int i = 0; !isPerspective && i < 3; ++i)
        out[i] = glm::vec4(glm::dvec4(out[i]) * unitsPerMeter_); // (6)
    return out;
}

glm::mat4 HostWorld::ofWorld(const float* matrix) const
{
    if (isLibraryWorld_)
        return glm::make_mat4(matrix);
    const glm::mat4 host = glm::make_mat4(matrix);
    glm::mat4 out = host;
    for (int i = 0; i < 3; ++i)
        out[i] =
            glm::vec4(glm::dvec4(flipped(signs_[size_t(i)], host[axes_[size_t(i)]])) * unitsPerMeter_); // (4)
    return out;
}

void HostWorld::writePosition(const glm::dvec3& position, double* out) const
{
    for (int i = 0; i < 3; ++i)
        out[axes_[size_t(i)]] = flipped(signs_[size_t(i)], position[i]) * unitsPerMeter_; // (2)
}

void HostWorld::writeVector(const glm::vec3& vector, float* out) const
{
    for (int i = 0; i < 3; ++i)
        out[axes_[size_t(i)]] = flipped(signs_[size_t(i)], fromMeters(vector[i])); // (2)
}

void HostWorld::writeDirection(const glm::vec3& direction, float* out) const
{
    for (int i = 0; i < 3; ++i)
        out[axes_[size_t(i)]] = flipped(signs_[size_t(i)], direction[i]); // (1)
}

void HostWorld::writeRotation(const glm::quat& rotation, float* outXyzw) const
{
    const glm::vec3 axis(rotation.x, rotation.y, rotation.z);
    for (int i = 0; i < 3; ++i)
        outXyzw[axes_[size_t(i)]] = flipped(determinant_ * signs_[size_t(i)], axis[i]); // (3)
    outXyzw[3] = rotation.w;
}

base::Bounds HostWorld::bounds(const base::Bounds& bounds) const
{
    if (bounds.empty())
        return bounds; // stays empty with every axis
    base::Bounds out;
    glm::vec3 first, second;
    writeVector(bounds.min, glm::value_ptr(first));
    writeVector(bounds.max, glm::value_ptr(second));
    out.min = glm::min(first, second);
    out.max = glm::max(first, second);
    return out;
}

} // namespace fx::api
