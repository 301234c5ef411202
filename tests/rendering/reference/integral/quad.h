/// @file quad.h
/// Defines the functions that the ray integral needs for the number type __float128 with 113 bits of
/// mantissa.
#pragma once

#include "rendering/reference/integral/lane_numbers.h"

extern "C" {
__extension__ __float128 expq(__float128);
__extension__ __float128 expm1q(__float128);
__extension__ __float128 sqrtq(__float128);
}

namespace fx::render {

__extension__ using Quad = __float128;

namespace integral {

template <>
struct Real<Quad>
{
    static constexpr int kDigits = 113;
    static Quad root(Quad x) { return sqrtq(x); }
    static Quad expOfMinus(Quad x) { return expq(-x); }
};

} // namespace integral
} // namespace fx::render

#include "rendering/reference/integral/ray_integrator-inl.h"
