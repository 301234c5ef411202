/// @file group_scratch.h
/// Scratch data of the integral for a group of rays: memory, rules and constants. A group has one ray for
/// each vector lane.
#pragma once

#include "rendering/reference/integral/integral_scheme.h"
#include "rendering/reference/integral/quadrature.h"
#include "rendering/reference/integral/ray_records.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <vector>

namespace fx::render::integral {

/// Memory on the boundary of a cache line, which whole vectors never cross. Contents are lost when it grows.
template <class T>
class LineArray
{
public:
    /// Room for `count` values; the start is aligned to 64 bytes.
    T* room(size_t count)
    {
        if (count > capacity_) {
            capacity_ = count + count / 2;
            data_.reset(static_cast<T*>(::operator new[](capacity_ * sizeof(T), kAlignment)));
        }
        return data_.get();
    }

private:
    static constexpr std::align_val_t kAlignment{64};
    struct Release
    {
        void operator()(T* data) const { ::operator delete[](data, kAlignment); }
    };
    std::unique_ptr<T[], Release> data_;
    size_t capacity_ = 0;
};

/// Scratch of a group with W rays. Lane arrays have W numbers for each blob or event.
template <class T>
struct GroupScratch
{
    LineArray<T> center, chord2, events, perInterval;
    LineArray<T> offset, square, margin; ///< of nearby blobs, twice
    std::vector<uint32_t> nearby;
    uint32_t nearbyCount[2] = {};
    LineArray<T> weights; ///< 4 numbers a blob: extinction, then three sources, divided by radius^(2 degree)
    T largest = T(0), unit = T(1);        ///< the last group's largest radius, and the power of two below it
    T brightest = T(0), lightUnit = T(1); ///< its brightest source, and the power of two below it
    std::vector<T> first, last;           ///< extremes of each blob over the lanes
    std::vector<T> low, high;             ///< of each event over the lanes
    std::vector<uint32_t> byFirst, byLast;
    std::vector<uint64_t> candidates; ///< bit i: blob i may matter in the present interval
};

/// The active blobs of the present interval in the order of summation, with terms shared by sums over them.
template <class T>
struct NearbyBlobs
/// d of formula blob-polynomial
{
    T* offset;
    T* square; ///< g
    T* margin; ///< > 0 where the lane's interval lies within the blob
    uint32_t* blob;
    uint32_t* count;
};

/// The blobs of a group as sums see them: scaled, with the present candidates.
template <class T>
struct BlobLanes
{
    const T* center;
    const T* chord2;
    const T* weights;
    const uint64_t* candidates;
    uint32_t words;
    NearbyBlobs<T>
        nearby[2]; ///< two: the light of one interval may be summed after the extinction of the next
};

/// Inputs of the rays of a group. Lane arrays of blob k begin at k * stride.
template <class T>
struct GroupInput
/// of blobs
{
    uint32_t count;
    uint32_t stride;
    T largest;   ///< [m] radius of the caller's blobs, those that all rays miss among them
    T brightest; ///< [cd/m2] source of the same blobs, in any channel
    const T* center;
    const T* chord2;
    const T* nearest;
    const T* farthest;
    const T* background[3];
};

/// Where the results of a group go, lane by lane.
template <class T>
struct GroupOutput
{
    T* radiance[3];
    T* opticalDepth;
    T* transmittance;
    uint32_t* flags;
};

/// Data shared by all rays.
template <class T>
struct GroupRules
{
    explicit GroupRules(const IntegralSettings& from)
        : settings(from),
          stopDepth(static_cast<T>(from.scheme.stopDepth)), caps{static_cast<T>(from.scheme.cap),
                                                                 static_cast<T>(0.25 * from.scheme.cap),
                                                                 static_cast<T>(0.1 * from.scheme.cap)},
          positive(pieceNodes<T>(from.scheme.method == IntegralMethod::Positive ? from.scheme.count : 4))
    {}

    IntegralSettings settings;
    T stopDepth;
    T caps[3]; ///< of kernels of degree 2, 3 and 4: the steeper, the more nodes for the same light
    GaussRule<T> gauss3 = gaussRule<T>(3), gauss5 = gaussRule<T>(5), gauss8 = gaussRule<T>(8);
    std::vector<T> positive; ///< from -1 to 1
};

} // namespace fx::render::integral
