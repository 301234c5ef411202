/// @file state_reader.h
/// Reads and validates the output of a StateWriter. The first failure is recorded, and all later values are
/// zero. Therefore callers need only one check at the end. The reader never reads beyond the given bytes.
#pragma once

#include "foundation/math/bits.h"
#include "foundation/result/status.h"
#include "simulation/state/state_writer.h"

#include <algorithm>

namespace fx::sim {

class StateReader
{
public:
    explicit StateReader(std::span<const std::byte> bytes) : left_(bytes) {}

    bool ok() const { return status_.ok(); }
    const base::Status& status() const { return status_; }
    size_t left() const { return left_.size(); } ///< [byte]

    /// Records the failure `what` unless `condition` holds. If a failure is already recorded, this failure
    /// does not change.
    void require(bool condition, const char* what)
    {
        if (!condition && status_.ok())
            status_ = {base::Code::Parse, what};
    }
    /// Records `status` as the failure, unless a failure is already recorded.
    void fail(const base::Status& status)
    {
        if (status_.ok())
            status_ = status;
    }

    template <StateValue T>
    T value()
    {
        T value{};
        take(&value, sizeof value);
        return value;
    }
    /// Reads a number in [least, most]. For any other number, and for NaN, records a failure and returns
    /// `least`.
    template <StateValue T>
    T value(T least, T most, const char* what)
    {
        const T found = value<T>();
        const bool inside = found >= least && found <= most;
        require(inside, what);
        return ok() ? found : least;
    }
    bool flag() { return value<uint8_t>(0, 1, "a flag of the state is neither 0 nor 1") == 1; }
    /// Reads a finite vector.
    glm::vec3 vector()
    {
        float xyz[3] = {};
        values(std::span<float>(xyz));
        return {xyz[0], xyz[1], xyz[2]};
    }
    glm::dvec3 doubleVector()
    {
        double xyz[3] = {};
        values(std::span<double>(xyz));
        return {xyz[0], xyz[1], xyz[2]};
    }
    glm::quat rotation()
    {
        float xyzw[4] = {};
        values(std::span<float>(xyzw));
        return {xyzw[3], xyzw[0], xyzw[1], xyzw[2]};
    }
    /// Reads all elements of `out`. Floating-point elements must be finite.
    template <StateValue T>
    void values(std::span<T> out)
    {
        take(out.data(), out.size_bytes());
        if constexpr (std::is_floating_point_v<T>)
            require(std::all_of(out.begin(), out.end(), [](T x) { return base::isFinite(x); }),
                    "a number of the state is not finite");
    }
    /// Reads the bytes of StateWriter::block(). The result is valid as long as the bytes of the reader, and
    /// empty after a failure.
    std::span<const std::byte> block()
    {
        const uint64_t size = value<uint64_t>();
        require(size <= left_.size(), "the state ends early");
        if (!ok())
            return {};
        const std::span<const std::byte> bytes = left_.first(size_t(size));
        left_ = left_.subspan(size_t(size));
        return bytes;
    }

private:
    void take(void* out, size_t size)
    {
        require(size <= left_.size(), "the state ends early");
        if (size == 0)
            return;
        if (!ok()) {
            std::memset(out, 0, size);
            return;
        }
        std::memcpy(out, left_.data(), size);
        left_ = left_.subspan(size);
    }

    std::span<const std::byte> left_;
    base::Status status_;
};

} // namespace fx::sim
