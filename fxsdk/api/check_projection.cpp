#include "fxsdk/api/check_projection.h"

#include "foundation/math/bits.h"

#include <cmath>
#include <cstddef>
#include <initializer_list>

namespace fx::api {

namespace {

constexpr float kTolerance = 1e-4f; ///< [1] of elements that are 0 or 1 in exact arithmetic

bool isAlmost(float value, float wanted)
{
    return std::abs(value - wanted) <= kTolerance;
}

bool isPerspective(const float* m)
{
    return std::abs(m[11]) > std::abs(m[15]);
}

/// Whether the elements are nothing beside `of`.
bool areZero(const float* m, std::initializer_list<size_t> elements, float of)
{
    for (const size_t i : elements)
        if (!(std::abs(m[i]) <= kTolerance * std::abs(of)))
            return false;
    return of != 0.0f;
}

bool isIdentity(const float* m)
{
    for (size_t i = 0; i < 16; ++i)
        if (m[i] != (i % 5 == 0 ? 1.0f : 0.0f))
            return false;
    return true;
}

/// The last row makes w: -z of a perspective, 1 of an orthographic projection. Of a transposed matrix that
/// row is the last column, where the translation belongs.
const char* rowFault(const float* m)
{
    constexpr const char* kRowMajor = "looks row-major: transpose it";
    if (areZero(m, {3, 7, 15}, m[11])) {
        // both rows may look so; w = -z is what is meant, and a distance of 1 m in its place is not
        const bool isOne = isAlmost(std::abs(m[11]), 1.0f) && !(m[11] > 0.0f && m[14] < 0.0f);
        if (isAlmost(std::abs(m[14]), 1.0f) && !isOne && areZero(m, {12, 13}, 1.0f))
            return kRowMajor;
        return m[11] < 0.0f
                   ? nullptr
                   : "is for a camera that looks along +Z (its element 11 is positive): use a right-handed "
                     "one, which looks along -Z";
    }
    if (areZero(m, {3, 7, 11}, m[15]) && m[15] > 0.0f)
        return nullptr;
    if (areZero(m, {12, 13, 14}, m[15]))
        return kRowMajor;
    return "is neither perspective nor orthographic: its elements 3, 7, 11, 15 must be 0, 0, -1, 0 or 0, 0, "
           "0, 1";
}

} // namespace

const char* projectionFault(const float* m)
{
    if (!base::allFinite(m, 16))
        return "is not finite";
    if (m[0] == 0.0f || m[5] == 0.0f)
        return "has no extent: its first or second diagonal element is 0";
    if (const char* fault = rowFault(m))
        return fault;
    if (isPerspective(m) ? !isAlmost(m[11], -1.0f) : !isAlmost(m[15], 1.0f))
        return isPerspective(m) ? "is scaled: divide it by its element 11, negated, so that that is -1"
                                : "is scaled: divide it by its element 15, so that that is 1";
    if (isPerspective(m) && m[14] == 0.0f)
        return "is singular: its element 14 is 0, so that all is at the same depth";
    if (!isPerspective(m) && m[10] == 0.0f)
        return "is singular: its element 10 is 0, so that all is at the same depth";
    return nullptr;
}

const char* frameProjectionFault(const float* m, bool isReversed)
{
    if (isIdentity(m))
        return "is identity, the default: set it to the matrix of your camera "
               "(docs/howto/effect-in-your-game.md)";
    const bool perspective = isPerspective(m);
    if (!areZero(m, {1, 4}, 1.0f))
        return "rolls or shears the picture (its elements 1 and 4 are not 0): put that into frame.view";
    if (perspective && !areZero(m, {12, 13}, 1.0f))
        return "moves the eye (its elements 12 and 13 are not 0): put that into frame.view";
    if (!perspective && !areZero(m, {8, 9}, 1.0f))
        return "is an oblique orthographic one (its elements 8 and 9 are not 0): use a straight one";
    if (!areZero(m, {2, 6}, 1.0f))
        return "has an oblique near plane (its elements 2 and 6 are not 0): use a straight one";
    const bool mapsNearToMore = perspective ? m[14] > 0.0f : m[10] > 0.0f;
    if (mapsNearToMore != isReversed)
        return isReversed
                   ? "maps near to the smaller depth, but frame.depthConvention is FX_DEPTH_REVERSED: make "
                     "them agree"
                   : "maps near to the larger depth, but frame.depthConvention is FX_DEPTH_STANDARD: make "
                     "them agree";
    return nullptr;
}

} // namespace fx::api
