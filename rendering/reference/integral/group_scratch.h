/// @file group_scratch.h
/// Scratch data of the integral for a group of rays: memory, quadrature rules and constants. A group has one
/// ray for each SIMD lane.
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

/// An array whose memory is aligned to a cache line, so that no vector load crosses a line. The content is
/// lost when the array grows.
template <class T>
class LineArray
{
public:
    /// Returns memory for `count` values, aligned to 64 bytes.
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

/// Scratch memory of a group of rays. Lane arrays have one number per ray for each blob or event.
template <class T>
struct GroupScratch
{
    LineArray<T> center, chord2, events, perInterval;
    LineArray<T> offset, square, margin; ///< lane arrays of the nearby blobs, for two intervals
    std::vector<uint32_t> nearby;
    uint32_t nearbyCount[2] = {};
    /// four numbers for each blob: extinction and three sources, divided by radius^(2 degree)
    LineArray<T> weights;
    T largest = T(0), unit = T(1);        ///< largest radius of the last group, and the power of two below it
    T brightest = T(0), lightUnit = T(1); ///< largest source of the last group, and the power of two below it
    std::vector<T> first, last;           ///< by blob: least begin and largest end over all lanes
    std::vector<T> low, high;             ///< by event: least and largest value over all lanes
    std::vector<uint32_t> byFirst, byLast;
    std::vector<uint64_t> candidates; ///< bit i is set if blob i may overlap the present interval
};

/// The blobs that overlap the present interval, in the order of summation, and terms that several sums use.
template <class T>
struct NearbyBlobs
{
    T* offset; ///< symbol d of formula blob-polynomial
    T* square; ///< symbol g of formula blob-polynomial
    T* margin; ///< > 0 in lanes whose interval is within the blob
    uint32_t* blob;
    uint32_t* count;
};

/// The scaled blobs of a group, with the candidates of the present interval.
template <class T>
struct BlobLanes
{
    const T* center;
    const T* chord2;
    const T* weights;
    const uint64_t* candidates;
    uint32_t words;
    /// Nearby blobs of two intervals. Two are stored, because the light of an interval may be summed after
    /// the extinction of the next interval.
    NearbyBlobs<T> nearby[2];
};

/// Inputs of the integral for the rays of a group. Lane arrays of blob k begin at k * stride.
template <class T>
struct GroupInput
{
    uint32_t count; ///< number of blobs
    uint32_t stride;
    T largest;   ///< [m] largest radius of all blobs of the caller, including blobs that all rays miss
    T brightest; ///< [cd/m2] largest source of all blobs of the caller in any channel
    const T* center;
    const T* chord2;
    const T* nearest;
    const T* farthest;
    const T* background[3];
};

/// Output arrays for the results of a group, one value per lane.
template <class T>
struct GroupOutput
{
    T* radiance[3];
    T* opticalDepth;
    T* transmittance;
    uint32_t* flags;
};

/// Settings and quadrature rules that all rays share.
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
    /// Largest optical depths of a part of an interval, for kernels of degree 2, 3 and 4.
    T caps[3];
    GaussRule<T> gauss3 = gaussRule<T>(3), gauss5 = gaussRule<T>(5), gauss8 = gaussRule<T>(8);
    std::vector<T> positive; ///< nodes from -1 to 1, see pieceNodes()
};

} // namespace fx::render::integral
