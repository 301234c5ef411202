#include "fxsdk/api/check.h"

#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>

#include <array>
#include <cmath>
#include <cstdio>

namespace fx::api {

namespace {
constexpr float kUnitTolerance = 1e-3f;
bool isAlmost(float value, float wanted)
{
    return std::abs(value - wanted) <= kUnitTolerance;
}
} // namespace

base::Status Checks::refusal(const std::string& failure)
{
    return invalid(failure);
}

base::Status Checks::outOfRange(double value, double least, double most, const char* name)
{
    std::array<char, 160> text;
    std::snprintf(text.data(), text.size(), "%s is %g; allowed is %g to %g", name, value, least, most);
    return invalid(text.data());
}

bool isUnitQuaternion(const float* xyzw)
{
    return isAlmost(std::sqrt(xyzw[0] * xyzw[0] + xyzw[1] * xyzw[1] + xyzw[2] * xyzw[2] + xyzw[3] * xyzw[3]),
                    1.0f);
}

bool isRigid(const float* matrix)
{
    if (!base::allFinite(matrix, 16))
        return false;
    const glm::mat4 m = glm::make_mat4(matrix);
    const glm::vec3 x(m[0]), y(m[1]), z(m[2]);
    const bool orthonormal = isAlmost(glm::length(x), 1.0f) && isAlmost(glm::length(y), 1.0f) &&
                             glm::length(glm::cross(x, y) - z) <= 2 * kUnitTolerance &&
                             isAlmost(glm::dot(x, y), 0.0f);
    return orthonormal && m[0].w == 0.0f && m[1].w == 0.0f && m[2].w == 0.0f && m[3].w == 1.0f;
}

const char* viewFault(const float* matrix)
{
    if (!base::allFinite(matrix, 16))
        return "is not finite";
    if (isRigid(matrix))
        return nullptr;
    const glm::mat4 mirror(glm::vec4(1, 0, 0, 0), glm::vec4(0, 1, 0, 0), glm::vec4(0, 0, -1, 0),
                           glm::vec4(0, 0, 0, 1));
    const glm::mat4 mirrored = mirror * glm::make_mat4(matrix);
    if (isRigid(glm::value_ptr(mirrored)))
        return "mirrors the world that the axes of FxContextDef state: give a matrix to eye coordinates with "
               "x to "
               "the right, y up and a camera that looks along -z, or state the axes of the host";
    const glm::mat4 transposed = glm::transpose(glm::make_mat4(matrix));
    return isRigid(glm::value_ptr(transposed))
               ? "looks row-major: transpose it"
               : "is not a rotation and a translation: take scale and shear out of it";
}

} // namespace fx::api
