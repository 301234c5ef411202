/// @file drawing_hints.h
/// How an effect is meant to be drawn, and what several effects together ask for. For renderers: the
/// simulation does not depend on it.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace fx::sim {

/// How the media of an effect are meant to be put together where they overlap.
enum class PreferredComposition : uint8_t
{
    None,
    Sorted,
    Slabs,
    Volume,
};

/// How light that the media of an effect scatter again is meant to be computed.
enum class PreferredScattering : uint8_t
{
    Automatic, ///< no preference
    Single,    ///< light that is scattered once
    ClosedForm,
    Network, ///< an illumination network
};

/// When a picture has several effects, the greatest value of each member applies.
struct DrawingHints
{
    PreferredComposition composition = PreferredComposition::None;
    PreferredScattering scattering = PreferredScattering::Automatic;

    bool operator==(const DrawingHints&) const = default;
};

inline DrawingHints greatest(const DrawingHints& a, const DrawingHints& b)
{
    return {std::max(a.composition, b.composition), std::max(a.scattering, b.scattering)};
}

/// Numbers of effects by their hints.
class HintCounts
{
public:
    /// @param more 1: an effect has come, -1: one has gone
    void add(const DrawingHints& hints, int more)
    {
        compositions_[size_t(hints.composition)] += uint32_t(more);
        scatterings_[size_t(hints.scattering)] += uint32_t(more);
    }
    DrawingHints greatest() const
    {
        return {PreferredComposition(last(compositions_)), PreferredScattering(last(scatterings_))};
    }

private:
    using Counts = std::array<uint32_t, 4>;
    static size_t last(const Counts& counts)
    {
        size_t most = counts.size() - 1;
        while (most > 0 && counts[most] == 0)
            --most;
        return most;
    }

    Counts compositions_{}, scatterings_{};
};

} // namespace fx::sim
