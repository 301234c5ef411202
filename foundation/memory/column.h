/// @file column.h
/// One attribute of many particles: a contiguous array of fixed capacity, aligned to 64 bytes or more.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory_resource>
#include <span>
#include <type_traits>
#include <utility>

namespace fx::base {

/// One array of a structure of arrays. The capacity is fixed at construction, so that pointers to elements
/// stay valid.
template <class T>
class Column
{
    static_assert(std::is_trivially_copyable_v<T>);
    static constexpr size_t kAlignment = alignof(T) > 64 ? alignof(T) : 64;

public:
    Column() = default;
    Column(std::pmr::memory_resource* memory, size_t capacity) : memory_(memory), capacity_(capacity)
    {
        if (capacity_ > 0)
            data_ = static_cast<T*>(memory_->allocate(capacity_ * sizeof(T), kAlignment));
    }
    ~Column()
    {
        if (data_)
            memory_->deallocate(data_, capacity_ * sizeof(T), kAlignment);
    }
    Column(Column&& other) noexcept
        : memory_(std::exchange(other.memory_, nullptr)), data_(std::exchange(other.data_, nullptr)),
          capacity_(std::exchange(other.capacity_, 0))
    {}
    Column& operator=(Column&& other) noexcept
    {
        std::swap(memory_, other.memory_);
        std::swap(data_, other.data_);
        std::swap(capacity_, other.capacity_);
        return *this;
    }

    T* data() { return data_; }
    const T* data() const { return data_; }
    size_t capacity() const { return capacity_; }
    T& operator[](size_t i) { return data_[i]; }
    const T& operator[](size_t i) const { return data_[i]; }
    std::span<T> first(size_t count) { return {data_, count}; }
    std::span<const T> first(size_t count) const { return {data_, count}; }

private:
    std::pmr::memory_resource* memory_ = nullptr;
    T* data_ = nullptr;
    size_t capacity_ = 0;
};

} // namespace fx::base
