/// @file check.h
/// Tests of arguments that name the argument when it fails.
#pragma once

#include "foundation/math/bits.h"
#include "foundation/result/status.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <string>

namespace fx::api {

inline base::Status invalid(const std::string& what)
{
    return {base::Code::InvalidArgument, what};
}

/// Runs checks in order and keeps the first failure. Allocates only for that.
class Checks
{
public:
    void notNull(const void* pointer, const char* name)
    {
        if (status_.ok() && !pointer)
            status_ = invalid(std::string(name) + " is null");
    }

    /// A value that is not finite fails as a value outside of the range does.
    template <class T>
    void range(T value, T least, T most, const char* name)
    {
        if (status_.ok() && !(value >= least && value <= most))
            status_ = outOfRange(double(value), double(least), double(most), name);
    }

    template <class T>
    void range3(const T* values, T least, T most, const char* name)
    {
        for (int i = 0; i < 3; ++i)
            range(values[i], least, most, name);
    }

    void flag(uint32_t value, const char* name) { range(value, 0u, 1u, name); }

    void that(bool condition, const char* failure)
    {
        if (status_.ok() && !condition)
            status_ = invalid(failure);
    }

    /// @param fault description of the argument's fault, or null
    void noFault(const char* fault, const char* name)
    {
        if (status_.ok() && fault)
            status_ = invalid(std::string(name) + " " + fault);
    }

    const base::Status& status() const { return status_; }

private:
    static base::Status outOfRange(double value, double least, double most, const char* name);
    base::Status status_;
};

/// Unit within 1e-3, in the order x, y, z, w. False for components that are not finite.
bool isUnitQuaternion(const float* xyzw);
/// The rotation of a unit quaternion, normalized.
glm::quat toRotation(const float* xyzw);
/// Orthonormal within 1e-3, right-handed, last row 0 0 0 1, column-major.
bool isRigid(const float* matrix);
/// Null, or why the matrix is no camera's, with the remedy.
const char* viewFault(const float* matrix);

} // namespace fx::api
