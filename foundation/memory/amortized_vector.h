/// @file amortized_vector.h
/// Fills vectors whose memory is kept from frame to frame. assign(), and resize() and insert() after clear(),
/// allocate exactly what is needed, so that a list that becomes a little longer in each frame would allocate
/// in each frame. With these functions capacities at least double.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

namespace fx::base {

/// Ensures room for `count` elements.
template <class Vector>
void reserveAmortized(Vector& io, size_t count)
{
    if (count > io.capacity())
        io.reserve(std::max(count, 2 * io.capacity()));
}

/// Like io.assign(count, value).
template <class Vector>
void assignAmortized(Vector& io, size_t count, const typename Vector::value_type& value)
{
    io.clear();
    reserveAmortized(io, count);
    io.resize(count, value);
}

/// Replaces the elements by copies of those of `from`, which is not part of `io`.
template <class Vector>
void assignAmortized(Vector& io, std::span<const typename Vector::value_type> from)
{
    io.clear();
    reserveAmortized(io, from.size());
    io.insert(io.end(), from.begin(), from.end());
}

} // namespace fx::base
