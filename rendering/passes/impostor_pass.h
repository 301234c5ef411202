/// @file impostor_pass.h
/// Passes that render impostors of far effects to tiles of one texture, and draw impostors as squares that
/// face the eye.
#pragma once

#include "rendering/frame/view_block.h"
#include "rendering/frame_graph/frame_graph.h"
#include "rendering/passes/media_source.h"

#include <cstdint>
#include <span>

namespace fx::render {

constexpr int kImpostorTile = 32;    ///< [texel] width and height of an impostor
constexpr int kImpostorColumns = 64; ///< number of tiles along x in the texture of impostors
constexpr int kImpostorRows = 32;    ///< number of tiles along y in the texture of impostors
constexpr uint32_t kImpostorTiles = uint32_t(kImpostorColumns * kImpostorRows);
constexpr int kTakingColumns = 12; ///< number of impostors along x and along y that one frame can render
constexpr uint32_t kImpostorTakings = uint32_t(kTakingColumns * kTakingColumns);

/// One impostor that is rendered in this frame.
struct ImpostorTaking
{
    glm::vec3 center; ///< [m] center relative to the eye
    float extent;     ///< [m] half the side of the square
    glm::vec3 right, up, forward;
    uint32_t tile; ///< index of the tile in the texture of impostors
};

/// One drawn impostor; layout of shaders/blobs/impostor.vert.glsl.
struct ImpostorInstance
{
    glm::vec4 center; ///< xyz [m] center relative to the eye; w half the side of the square [m]
    glm::vec4 right;  ///< xyz unit axis to the right; w index of the tile of the newer impostor
    glm::vec4 up;     ///< xyz unit axis upwards; w index of the tile of the older impostor
    /// x weight of the newer impostor; y fraction of the effect that is drawn as an impostor; z radius [m];
    /// w side of the newer impostor's square divided by the side of the older impostor's square.
    glm::vec4 appearance;
};
static_assert(sizeof(ImpostorInstance) == 64);

inline constexpr ProgramDesc kImpostorProgram{"impostors", "blobs/impostor.vert.glsl",
                                              "blobs/impostor.frag.glsl", nullptr, "FX_CARDS=0"};
inline constexpr ProgramDesc kImpostorCardProgram{"impostor cards", "blobs/impostor.vert.glsl",
                                                  "blobs/impostor.frag.glsl", nullptr, "FX_CARDS=1"};
inline constexpr ProgramDesc kImpostorKeepProgram{"impostor keep", "blobs/impostor_keep.vert.glsl",
                                                  "blobs/impostor_keep.frag.glsl", nullptr, nullptr};

/// Returns the camera for all impostors that are rendered in one frame. The camera is orthographic, has the
/// axes of the view, and one unit per texel.
CameraView takingCamera(const CameraGeometry& view);
/// Returns the position of a blob in the space of takingCamera(). @param blob [m] position relative to the
/// eye
/// @param outScale receives the factor by which lengths change
glm::vec3 placeInTaking(const ImpostorTaking& taking, uint32_t slot, const CameraGeometry& view,
                        const glm::vec3& blob, float& outScale);

/// Copies rendered impostors to their tiles.
///
/// reads   taken     RGBA32F premultiplied radiance of up to kTakingColumns^2 impostors
/// writes  atlas     RGBA16F, only the given tiles
class ImpostorKeepPass
{
public:
    struct Inputs
    {
        ResourceId taken;
        ResourceId atlas;
        ResourceId tiles; ///< buffer with the tile index of each rendered impostor, as uint
        uint32_t count;
    };
    struct Outputs
    {
        ResourceId atlas;
    };
    [[nodiscard]] static Outputs addTo(FrameGraph& graph, const Inputs& in);
};

/// Draws effects as impostors.
class ImpostorSource final : public MediaSource
{
public:
    void read(FrameGraph::Builder& builder) const override;
    void draw(Backend& backend, const DrawBatch& batch, const MediaTarget& target) const override;

    ResourceId instances; ///< buffer of ImpostorInstance
    ResourceId atlas;
};

} // namespace fx::render
