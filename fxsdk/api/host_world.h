/// @file host_world.h
/// Units of length and axes of the host's world (FxContextDef), and their conversion. The library behind the
/// C API has meters, right-handed, +Y up. Only the functions of the C API convert, where a value enters or
/// leaves.
///
/// @formula host-world
/// Change of basis between the host's world and that of the library, by a signed permutation and one factor.
///
/// symbol   unit     meaning
///   u        1/m    units of length of the host in a meter
///   a_i, s_i 1      host axis 0..2 along the library's axis i, and its sign, +1 or -1
///   P        1      matrix with the elements P[i][a_i] = s_i, the others 0
///   h, p     -      coordinates of the host, of the library
/// @derivation
///   A direction has p = P h, so p_i = s_i h_(a_i), and h = P^T p, so h_(a_i) = s_i p_i           (1)
///   A length has p = h / u, so a position, velocity or acceleration has p = P h / u             (2)
///   A rotation R_h of the host is R = P R_h P^T. Its axis is a pseudovector: the quaternion (v, w) becomes
///   (det(P) P v, w), because a reflection reverses the sense of rotation                        (3)
///   A matrix A of world coordinates, A h, is A u P^T p: column i is u s_i times column a_i of A, and the
///   translation stays                                                                           (4)
///   Eye coordinates have no axes of the world. A view matrix gives e_h = u e, so its columns follow (4)
///   without u, and its translation is divided by u                                              (5)
///   A projection A of e_h is A diag(u, u, u, 1) of e. Of a perspective, clip coordinates may be divided by
///   u: the last column is divided by u. Else the other columns are multiplied by u              (6)
/// @source    elementary
/// @deviation none
/// @valid     P is a permutation, u is finite and above 0
/// @accuracy  exact if u is a power of two; else each component is correctly rounded from double precision
/// @tests     tests/api/test_host_world.cpp
#pragma once

#include "foundation/math/geometry.h"
#include "foundation/result/status.h"
#include "fxsdk/fx_context.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include <array>

namespace fx::api {

class HostWorld
{
public:
    /// The library's own world: all conversions keep every bit.
    HostWorld() = default;
    /// @param def of which check() is ok
    explicit HostWorld(const FxContextDef& def);
    /// Whether the members of a definition state a world; the message names the member and the remedy.
    static base::Status check(const FxContextDef& def);

    /// Whether conversions change nothing.
    bool isLibraryWorld() const { return isLibraryWorld_; }

    double toMeters(double length) const { return length / unitsPerMeter_; }
    float toMeters(float length) const { return float(double(length) / unitsPerMeter_); }
    double fromMeters(double length) const { return length * unitsPerMeter_; }
    float fromMeters(float length) const { return float(double(length) * unitsPerMeter_); }

    // From the host to the library.
    glm::dvec3 position(const double* host) const { return directionOf<glm::dvec3>(host) / unitsPerMeter_; }
    /// of a position with few digits, a velocity or an acceleration
    glm::vec3 vector(const float* host) const
    {
        return glm::vec3(glm::dvec3(direction(host)) / unitsPerMeter_);
    }
    glm::vec3 direction(const float* host) const { return directionOf<glm::vec3>(host); }
    /// @param xyzw quaternion @return as long as the quaternion
    glm::quat rotation(const float* xyzw) const;
    /// @param matrix from world to eye coordinates, column-major
    glm::mat4 view(const float* matrix) const;
    /// @param matrix from eye to clip coordinates, column-major, perspective or orthographic
    glm::mat4 projection(const float* matrix) const;
    /// @param matrix from world coordinates to coordinates that are not of the world, column-major
    glm::mat4 ofWorld(const float* matrix) const;

    // From the library to the host.
    void writePosition(const glm::dvec3& position, double* out) const;
    void writeVector(const glm::vec3& vector, float* out) const;
    void writeDirection(const glm::vec3& direction, float* out) const;
    void writeRotation(const glm::quat& rotation, float* outXyzw) const;
    base::Bounds bounds(const base::Bounds& bounds) const;

private:
    /// sign * value, of which 0 stays +0, so that a zero has the same bits in every world.
    template <class Number>
    static Number flipped(float sign, const Number& value)
    {
        return sign < 0.0f ? Number(0) - value : value;
    }
    template <class Vector, class Number>
    Vector directionOf(const Number* host) const
    {
        return {flipped(signs_[0], host[axes_[0]]), flipped(signs_[1], host[axes_[1]]),
                flipped(signs_[2], host[axes_[2]])}; // (1)
    }

    double unitsPerMeter_ = 1.0;
    std::array<int, 3> axes_{0, 1, 2};             ///< a_i
    std::array<float, 3> signs_{1.0f, 1.0f, 1.0f}; ///< s_i
    float determinant_ = 1.0f;                     ///< det(P), -1 if the host's axes are left-handed
    bool isLibraryWorld_ = true;
};

} // namespace fx::api
