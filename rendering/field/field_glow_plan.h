/// @file field_glow_plan.h
/// Grids in which light is propagated through fields. Fields that overlap each other share one grid. Without
/// illumination networks, a grid is created only if one of its fields emits light.
///
/// Grids are fixed in the world, so that their cells do not move with the eye.
#pragma once

#include "rendering/field/field_blocks.h"
#include "rendering/field/network_choice.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

namespace fx::render {

/// Numbers of cells along the sides of the grid of a network: multiples of kNetworkRound in this range.
constexpr int kNetworkRound = 4, kMinNetworkSide = 8, kMaxNetworkSide = 96;

/// Number of cells along each side of the grid of a network: enough cells of side `side` [m] for a box of
/// `extent` [m] and kSpareGlowCells.
glm::ivec3 networkSides(const glm::vec3& extent, float side);

/// Number of cells of a grid along a side that its place and the rounding of its cells may take.
constexpr int kSpareGlowCells = 2;

/// Largest number of grids per view; the fields that emit least get no grid.
constexpr size_t kMaxGlowGrids = 4;

/// Builds the list of grids of a frame. The memory is kept from frame to frame, and so are the places of the
/// networks: a medium that had one is the last to lose it, see kKeptNetworkShare and kNetworkPromotion.
/// Threads: one at a time.
class FieldGlowPlan
{
public:
    /// What decides which media have networks.
    struct Choice
    {
        std::span<const MediumMoments> media; ///< medium of each field, relative to the eye
        float pixelsPerSlope; ///< [pixel] of 1 m at a distance of 1 m, or anywhere if orthographic
        bool orthographic;
    };

    explicit FieldGlowPlan(std::pmr::memory_resource* memory);

    /// Builds the grids. Sets FieldBlock::limits.w of each field to the index of the field's grid + 1, or to
    /// 0 if the field has no grid.
    /// @param emitted [exposed m2] for each field: the sum of cross section times emitted light of its balls
    /// @param eye [m] world position to which fields are relative
    /// @param networkCells side of the cube whose number of cells the grid of an illumination network does
    ///         not exceed; all fields get grids, in the order of their size on the picture. 0: no networks;
    ///         fields that emit light get cubes of kGlowCells
    /// @param choice null: all fields may have networks
    void build(std::span<FieldBlock> ioFields, std::span<const float> emitted, const glm::dvec3& eye,
               int networkCells = 0, const Choice* choice = nullptr);
    /// Removes the grids. The next frame still knows which media had networks.
    void clear() { grids_.clear(); }
    /// Forgets which media had networks, for a frame without any.
    void forget() { kept_.clear(); }

    std::span<const FieldGlowBlock> grids() const { return grids_; }

private:
    /// Overlapping fields that share a grid.
    struct Source
    {
        glm::vec3 low, high; ///< [m] corners of the fields' common box, relative to the eye
        /// [exposed m2] emitted light; with networks, the size on the picture [sr], that of a medium that had
        /// a network times the square of kNetworkPromotion
        float emitted;
        MediumMoments medium; ///< empty without Choice
        bool had = false;     ///< true: it had a network in the last frame
    };
    /// A medium with a network.
    struct Kept
    {
        glm::dvec3 low, high; ///< [m] corners of its box in the world
    };

    /// True if `a` is sorted before `b`. Sources are sorted by decreasing `emitted`, and for equal `emitted`
    /// by position.
    static bool brighter(const Source& a, const Source& b);
    void listSources(std::span<const FieldBlock> fields, std::span<const float> emitted, bool all,
                     const Choice* choice);
    void recallNetworks(const glm::dvec3& eye);
    void rememberNetworks(const glm::dvec3& eye);
    void placeGrid(const Source& source, std::span<FieldBlock> ioFields, const glm::dvec3& eye);

    int networkCells_ = 0; ///< as in build()
    std::pmr::vector<Source> sources_;
    std::pmr::vector<Kept> kept_; ///< of the last frame
    std::pmr::vector<FieldGlowBlock> grids_;
};

} // namespace fx::render
