/// @file ray_hits.h
/// The balls that one ray meets.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace fx::render {

/// Columns with one entry a ball, by rising place until sort() is called. The columns are longer than size(),
/// so that vectors can be stored whole.
class RayHits
{
public:
    static constexpr size_t kSlack = 8; ///< entries behind the last one that may be overwritten

    size_t size() const { return size_; }
    void clear() { size_ = 0; }
    /// Makes room for `more` entries and the slack.
    void reserve(size_t more)
    {
        if (size_ + more + kSlack > place.size())
            grow(size_ + more + kSlack);
    }
    void setSize(size_t size) { size_ = size; }
    /// Sorts by `enter`, then by `place`, so that the result does not depend on the order of insertion.
    void sort();

    std::vector<double> enter;   ///< [m] ray parameter where the ray enters; may lie before the ray's start
    std::vector<double> nearest; ///< [m] ray parameter of the point nearest to the center
    std::vector<double> chordSquare; ///< [m2] square of half the chord, > 0
    std::vector<uint32_t> place;     ///< of the ball in the order of its tree

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
