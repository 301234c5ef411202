/// @file check.h
/// Validation of arguments. Error messages name the argument.
#pragma once

#include "foundation/math/bits.h"
#include "foundation/result/status.h"

#include <cstdint>
#include <string>

namespace fx::api {

inline base::Status invalid(const std::string& what)
{
    return {base::Code::InvalidArgument, what};
}

/// Runs checks in order and keeps the first failure. Allocates memory only for a failure.
class Checks
{
public:
    void notNull(const void* pointer, const char* name)
    {
        if (status_.ok() && !pointer)
            status_ = refusal(std::string(name) + " is null");
    }

    /// Fails if the value is outside of the range or not finite.
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
            status_ = refusal(failure);
    }

    /// Fails if `fault` is not null.
    /// @param fault description of the argument's fault, or null
    void noFault(const char* fault, const char* name)
    {
        if (status_.ok() && fault)
            status_ = refusal(std::string(name) + " " + fault);
    }

    const base::Status& status() const { return status_; }

private:
    static base::Status outOfRange(double value, double least, double most, const char* name);
    static base::Status refusal(const std::string& failure); ///< not inline: checks fail rarely
    base::Status status_;
};

/// Whether the quaternion (x, y, z, w) has unit length within 1e-3; false if a component is not finite.
bool isUnitQuaternion(const float* xyzw);
/// Whether the column-major matrix is orthonormal within 1e-3 and right-handed, with last row 0 0 0 1.
bool isRigid(const float* matrix);
/// The reason why the matrix, in axes of the library, is not a view matrix, with the remedy; null for a view
/// matrix.
const char* viewFault(const float* matrix);

} // namespace fx::api
