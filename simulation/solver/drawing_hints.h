/// @file drawing_hints.h
/// Drawing hints: the author's intended way of drawing an effect, and the combination of the hints of several
/// effects. Only renderers use the hints. The simulation does not depend on them.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace fx::sim {

/// Intended composition of overlapping media of an effect.
enum class PreferredComposition : uint8_t
{
    None,
    Sorted,
    Slabs,
    Volume,
};

/// Intended computation of the light that the media of an effect scatter.
enum class PreferredScattering : uint8_t
{
    Automatic, ///< no preference
    Single,    ///< single scattering only
    ClosedForm,
    Network, ///< an illumination network
};

/// Drawing hints of an effect. If a picture has several effects, the greatest value of each member applies.
/// The alignment equals the size, so that every compiler loads and stores the struct atomically without
/// libatomic.
struct alignas(uint16_t) DrawingHints
{
    PreferredComposition composition = PreferredComposition::None;
    PreferredScattering scattering = PreferredScattering::Automatic;

    bool operator==(const DrawingHints&) const = default;
};
static_assert(sizeof(DrawingHints) == alignof(DrawingHints));

inline DrawingHints greatest(const DrawingHints& a, const DrawingHints& b)
{
    return {std::max(a.composition, b.composition), std::max(a.scattering, b.scattering)};
}

/// Counts effects by their hints.
class HintCounts
{
public:
    /// Adds or removes one effect with the given hints.
    /// @param more 1: adds an effect; -1: removes an effect
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
