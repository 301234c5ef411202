/// @file output_pass.h
/// The passes that compute outputs (view_output): instance id, motion and distance of the effect in each
/// pixel.
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
/// Returns all programs of outputs. These programs are compiled only if outputs are requested.
std::span<const ProgramDesc* const> outputPrograms();

/// Data of the nearest opaque particle in each pixel.
struct SolidMarks
{
    /// RGBA32F xyz velocity [m/s]; w is 1, or 0 in pixels without a particle. Invalid: the picture has no
    /// particles
    ResourceId velocity;
    ResourceId instance; ///< RG32UI id of the particle's instance, low word first
};

/// Draws opaque particles a second time, to write SolidMarks.
///
/// reads   the buffers of the sources
///         distance  [m] along the ray to the host's opaque geometry
/// No pass is added without sources. The pass keeps no state.
class SolidMarkPass
{
public:
    struct Inputs
    {
        /// Sources of opaque particles; must stay valid until the graph has executed.
        std::span<const MediaSource* const> sources;
        ResourceId distance;
        int width, height;
        ViewBlock view;
    };
    [[nodiscard]] static SolidMarks addTo(FrameGraph& graph, const Inputs& in);
};

/// Camera and time of the previous frame.
struct PastFrame
{
    CameraView camera;
    float seconds = 0.0f; ///< [s] >= 0, scene time since the previous frame
};

/// Stores the camera and the time of the previous frame.
class FrameHistory
{
public:
    /// Begins a frame. For the first frame, and after FrameRequest::resetHistory, there is no previous
    /// frame. Then past() has the camera of this frame, and the time difference FrameRequest::deltaTime.
    void advance(const FrameRequest& request);
    void forget() { hasFrame_ = false; }
    const PastFrame& past() const { return past_; }

private:
    PastFrame past_;
    CameraView camera_; ///< camera of this frame
    double time_ = 0.0; ///< [s] scene time of this frame
    bool hasFrame_ = false;
};

/// One texture for each bit of view_output, in the order of the bits; invalid if the output is not
/// requested.
using OutputTextures = std::array<ResourceId, view_output::kCount>;

/// Computes the outputs of each pixel from the balls, cards and opaque particles on its ray. Outputs have
/// the size of the picture, and do not depend on the composition. Definitions: docs/howto/outputs.md.
///
/// reads   lists     lists of SlabMedia, with marks
///         marks     BlobMark of each ball
///         solids    output of SolidMarkPass
///         distance  [m] along the ray to the host's opaque geometry and opaque particles
/// writes  RG32UI instance, RG32F motion [pixel], R32F first depth [m], mean depth [m], optical depth [1]
/// The pass keeps no state.
class OutputPass
{
public:
    struct Inputs
    {
        uint32_t outputs; ///< view_output bits, not 0
        SlabMedia::Lists lists;
        ResourceId marks; ///< invalid without balls
        SolidMarks solids;
        ResourceId distance;
        int width, height;
        ViewBlock view;
        const CameraView* camera;
        PastFrame past;
    };
    static constexpr uint32_t kMaxOfTile = kMaxLoopTurns / 12; ///< value of SlabTilePass::Inputs::maxOfTile
    [[nodiscard]] static OutputTextures addTo(FrameGraph& graph, const Inputs& in);
};

} // namespace fx::render
