/// @file ray_hits.h
/// List of the balls that one ray meets.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace fx::render {

/// The hits of a ray, as columns with one entry per ball, sorted by ascending place until sort() is called. A
/// place is an index in the order of the tree. The columns are longer than size(), so that whole vectors can
/// be stored.
class RayHits
{
public:
    static constexpr size_t kSlack = 8; ///< number of entries behind the last entry that may be overwritten

    size_t size() const { return size_; }
    void clear() { size_ = 0; }
    /// Reserves memory for `more` additional entries plus kSlack entries.
    void reserve(size_t more)
    {
        if (size_ + more + kSlack > place.size())
            grow(size_ + more + kSlack);
    }
    void setSize(size_t size) { size_ = size; }
    /// Sorts by `enter`, then by `place`, so that the result does not depend on the order of insertion.
    void sort();

    /// [m] Ray parameter at which the ray enters the ball; may be before the beginning of the ray.
    std::vector<double> enter;
    std::vector<double> nearest;     ///< [m] ray parameter of the point nearest to the ball's center
    std::vector<double> chordSquare; ///< [m2] square of half the chord, > 0
    std::vector<uint32_t> place;     ///< place of the ball

private:
    void grow(size_t capacity);

    struct Entry
    {
        double enter, nearest, chordSquare;
        uint32_t place;
    };
    size_t size_ = 0;
    std::vector<Entry> entries_;
};

} // namespace fx::render
