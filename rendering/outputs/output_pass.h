/// @file output_pass.h
/// The passes that tell what a pixel shows: whose it is, how it moves, how far away it is.
#pragma once

#include "rendering/compositions/slabs/slab_media.h"
#include "rendering/frame/view_types.h"

#include <array>
#include <span>

namespace fx::render {

inline constexpr ProgramDesc kOutputWholeProgram{"outputs (nothing)", "shared/fullscreen.vert.glsl",
                                                 "outputs/outputs.frag.glsl", nullptr, "FX_MEDIA=0"};
inline constexpr ProgramDesc kOutputMediaProgram{"outputs", "outputs/outputs.vert.glsl",
                                                 "outputs/outputs.frag.glsl", nullptr,
                                                 "FX_MEDIA=1 FX_FIELD_DETAIL=0"};
/// All programs that outputs need; nothing else compiles them.
std::span<const ProgramDesc* const> outputPrograms();

/// Of the nearest solid thing in each pixel.
struct SolidMarks
/// RGBA32F, xyz [m/s], w 1; 0: there is none. Invalid: there is none anywhere
{
    ResourceId velocity;
    ResourceId instance; ///< RG32UI its id, low word first
};

/// Draws what hides once more, for its marks.
///
/// reads   what the sources read
///         distance  [m] along the ray to the host's opaque geometry
/// Adds nothing without sources. Keeps no state.
class SolidMarkPass
{
public:
    struct Inputs
    /// with solids; must stay until the graph has executed
    {
        std::span<const MediaSource* const> sources;
        ResourceId distance;
        int width, height;
        ViewBlock view;
    };
    [[nodiscard]] static SolidMarks addTo(FrameGraph& graph, const Inputs& in);
};

/// The camera of the frame before, and when that was.
struct PastFrame
{
    CameraView camera;
    float seconds = 0.0f; ///< >= 0 of scene time since then
};

/// Remembers it.
class FrameHistory
{
public:
    /// Begins a frame. The first one, and one after a cut, has its own camera as that of the frame before, by
    /// FrameRequest::deltaTime earlier.
    void advance(const FrameRequest& request);
    void forget() { hasFrame_ = false; }
    const PastFrame& past() const { return past_; }

private:
    PastFrame past_;
    CameraView camera_; ///< of this frame
    double time_ = 0.0; ///< [s] of this frame
    bool hasFrame_ = false;
};

/// One picture for each bit of view_output, in their order; invalid: it was not asked for.
using OutputTextures = std::array<ResourceId, view_output::kCount>;

/// Sums up what a ray sees of each ball, card and solid thing, at the size of the picture, for any
/// composition. Definitions: docs/howto/outputs.md.
///
/// reads   lists     what SlabMedia has listed, with marks
///         marks     BlobMark of each ball
///         solids    of SolidMarkPass
///         distance  [m] along the ray to the host's opaque geometry and solid things
/// writes  RG32UI instance, RG32F motion [pixel], R32F first depth [m], mean depth [m], optical depth [1]
/// Keeps no state.
class OutputPass
{
public:
    struct Inputs
    /// view_output bits, not 0
    {
        uint32_t outputs;
        SlabMedia::Lists lists;
        ResourceId marks; ///< invalid without balls
        SolidMarks solids;
        ResourceId distance;
        int width, height;
        ViewBlock view;
        const CameraView* camera;
        PastFrame past;
    };
    static constexpr uint32_t kMaxOfTile = kMaxLoopTurns / 12; ///< of SlabTilePass
    [[nodiscard]] static OutputTextures addTo(FrameGraph& graph, const Inputs& in);
};

} // namespace fx::render
