/// @file state_writer.h
/// Serializes the state of solvers and scenes, either to memory for restoring or to a hash for comparison.
/// Values are written one by one in the byte order of the machine, without pointers and padding. Therefore
/// equal states give equal bytes. A StateReader reads the values in the same order.
#pragma once

#include "foundation/math/hash.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory_resource>
#include <span>
#include <type_traits>
#include <vector>

namespace fx::sim {

/// Types without padding whose every bit is part of the value.
template <class T>
concept StateValue = (std::is_arithmetic_v<T> && !std::is_same_v<T, bool> &&
                      !std::is_same_v<T, long double>) ||
                     std::is_enum_v<T>; // std::byte is one

class StateWriter
{
public:
    virtual ~StateWriter() = default;

    template <StateValue T>
    void value(T value)
    {
        put(&value, sizeof value);
    }
    void flag(bool flag) { value(uint8_t(flag ? 1 : 0)); }
    void vector(const glm::vec3& v)
    {
        const float xyz[3] = {v.x, v.y, v.z};
        put(xyz, sizeof xyz);
    }
    void vector(const glm::dvec3& v)
    {
        const double xyz[3] = {v.x, v.y, v.z};
        put(xyz, sizeof xyz);
    }
    void rotation(const glm::quat& q)
    {
        const float xyzw[4] = {q.x, q.y, q.z, q.w};
        put(xyzw, sizeof xyzw);
    }
    /// Writes the elements without their count. The reader must know the count.
    template <StateValue T>
    void values(std::span<const T> values)
    {
        put(values.data(), values.size_bytes());
    }
    /// Writes the number of bytes, then the bytes. The bytes may have any format.
    void block(std::span<const std::byte> bytes)
    {
        value(uint64_t(bytes.size()));
        put(bytes.data(), bytes.size());
    }

protected:
    virtual void put(const void* data, size_t size) = 0;
};

/// Stores the written bytes in memory.
class StateBuffer final : public StateWriter
{
public:
    explicit StateBuffer(std::pmr::memory_resource* memory) : bytes_(memory) {}
    std::span<const std::byte> bytes() const { return bytes_; }
    void shrink() { bytes_.shrink_to_fit(); }
    /// Copies the bytes to another writer.
    void copyTo(StateWriter& other) const { other.values(std::span<const std::byte>(bytes_)); }

private:
    void put(const void* data, size_t size) override
    {
        const auto* first = static_cast<const std::byte*>(data);
        bytes_.insert(bytes_.end(), first, first + size);
    }
    std::pmr::vector<std::byte> bytes_;
};

/// Computes a hash of the written values, without storing them. Allocates no memory.
class StateHasher final : public StateWriter
{
public:
    uint64_t hash() const { return hash_; }

private:
    void put(const void* data, size_t size) override { hash_ = base::hashBytes(hash_, data, size); }
    uint64_t hash_ = 0;
};

} // namespace fx::sim
