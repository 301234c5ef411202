/// @file view_types.h
/// Input of the renderer for one frame of one view.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

namespace fx::render {

/// Mapping of distance to depth-buffer values. The host chooses the mapping.
enum class DepthConvention : uint8_t
{
    Standard, ///< the near plane has the smaller depth value
    Reversed, ///< the near plane has the depth value 1, and the far plane or infinity has 0
};

/// Camera of one frame. The matrices are relative to `origin`, so that floats are precise far from the
/// world's center.
struct CameraView
{
    glm::dvec3 origin{0.0};     ///< [m] world position to which the matrices are relative
    glm::mat4 view{1.0f};       ///< rigid transform, right-handed; the camera looks along -Z
    glm::mat4 projection{1.0f}; ///< perspective or orthographic; an infinite far plane is allowed
    DepthConvention depth = DepthConvention::Standard;
    bool zeroToOne = false; ///< clip space z is in [0, w] (glClipControl GL_ZERO_TO_ONE) instead of [-w, w]
    bool upperLeftOrigin = false; ///< glClipControl GL_UPPER_LEFT

    bool operator==(const CameraView&) const = default;
};

/// Model by which the optical depth of a blob along a ray is computed.
enum class BillboardForm : uint8_t
{
    /// A flat card. Its opacity depends only on the distance from its center, as for classical particles.
    Planar,
    Constant, ///< a homogeneous ball with the total extinction of the kernel; [USS06]
    Kernel,   ///< the quartic kernel of the gas, with its exact integral over the visible part of a ray
};

/// Way in which overlapping media are combined. rendering/compositions implements all values except
/// Automatic.
enum class Composition : uint8_t
{
    Sorted, ///< balls and cards (flat particles) are blended one after another, the farthest first
    Slabs, ///< all media are summed in slabs along each ray; the result does not depend on the order of media
    /// Balls of an effect are summed in voxels, and rays march through the voxels. The result does not
    /// depend on the order of balls.
    Volume,
    Automatic, ///< the caller of the renderer chooses the composition that the visible effects prefer
};
constexpr size_t kCompositionCount = size_t(Composition::Automatic);

/// Returns `asked`, or `preferred` if `asked` is Automatic.
inline Composition resolved(Composition asked, Composition preferred)
{
    return asked == Composition::Automatic ? preferred : asked;
}

/// Bits of ViewSettings::outputs. Each bit requests a picture of reference data, such as motion or depth.
namespace view_output {
enum : uint32_t
{
    InstanceId = 1,   ///< id of the instance that contributes most to the pixel
    Motion = 2,       ///< [pixel] motion since the previous frame
    FirstDepth = 4,   ///< [m] distance at which media begin to be visible
    MeanDepth = 8,    ///< [m] mean distance of visible particles
    OpticalDepth = 16 ///< [1] optical depth of the media
};
constexpr size_t kCount = 5;
constexpr uint32_t kAll = (1u << kCount) - 1;
} // namespace view_output

/// One directional light (the sun), and uniform light of sky and ground.
struct Lighting
{
    glm::vec3 sunDirection{0.3f, 0.8f, 0.5f}; ///< unit vector towards the light
    /// [lx] Illuminance of a surface perpendicular to the direction, in channels of linear Rec. 709; (E, E,
    /// E) is white light of E lx.
    glm::vec3 sunIlluminance{0.0f};
    glm::vec3 skyLuminance{0.0f}; ///< [cd/m2] luminance of the sky, uniform over all directions
    float groundAlbedo = 0.2f;    ///< [1] albedo of the ground, which reflects light from below

    bool operator==(const Lighting&) const = default;
};

/// A light of the host: a glowing ball, or a spot.
struct HostLight
{
    glm::dvec3 position{0.0};  ///< [m] world
    glm::vec3 intensity{0.0f}; ///< [cd] largest intensity over all directions
    float radius = 0.05f;      ///< [m] > 0, radius of the glowing ball
    glm::vec3 axis{0, -1, 0};  ///< unit vector, direction in which a spot emits
    float cosInner = -1.0f;    ///< [1] cosine of the angle up to which a spot has its full intensity
    /// [1] cosine of the angle beyond which a spot is dark; -1: light in all directions
    float cosOuter = -1.0f;

    bool operator==(const HostLight&) const = default;
};

constexpr size_t kMaxHostLights = 8;

struct HostLights
{
    HostLight lights[kMaxHostLights];
    size_t count = 0;

    bool operator==(const HostLights&) const = default;
};

/// Size of the light slices of a light.
struct SliceResolution
{
    /// Number of texels along a side of a plane of the sun, 8..512, a multiple of 8. Planes of point lights
    /// have half of this number.
    int texels = 128;
    int planes = 32; ///< number of planes, 3..128; 1 and 2 become 3; 0: media cast no shadow

    bool operator==(const SliceResolution&) const = default;
};

/// Light slices: shadows of media on media and on the host's surfaces.
struct SliceSettings
{
    bool enabled = true;
    SliceResolution resolution;
    int castingPoints = 2; ///< number of brightest point lights for which media cast shadows, 0..4
    int samples = 2;       ///< number of points along a ray through a ball at which light is sampled, 1..4
    bool multiple = true;  ///< true: multiple scattering is computed
    /// True: an illumination network computes multiple scattering, for media that the
    /// compositions Volume and Slabs draw.
    /// False: a formula computes multiple scattering.
    bool network = false;
    /// True: the caller of the renderer sets `multiple` and `network` to the values that the visible effects
    /// prefer.
    bool automatic = false;
    /// Number of cells along a side of the network's grids, 24..64, a multiple of 8; 0: a third of
    /// ViewSettings::voxels.
    uint8_t networkCells = 0;
    int refreshFrames = 1; ///< number of frames between updates of the planes for moving media, 1..16

    /// True: texels and planes are fixed in the world. False: texels and planes move with media and eye.
    /// Only measurements of the difference use false.
    bool snapped = true;

    bool operator==(const SliceSettings&) const = default;
};

/// Heat shimmer.
struct ShimmerSettings
{
    float strength = 1.0f;   ///< [1] factor of every offset; 0: the picture does not change at all
    float maxOffset = 12.0f; ///< [pixel] largest offset, for a picture height of 720 pixels
};

/// Glare: light above the saturation level (overflow) is distributed over the picture, [UBT96].
struct DazzleSettings
{
    bool enabled = true;
    float white = 8.0f; ///< [1] exposed luminance at which the sensor saturates, > 0
    /// Sensor law f(over) = over (a + b exp(-c over)), where `over` is the overflow of a pixel in units of
    /// `white`. For a clean lens, `a` is about 0.01. With a = 1, the whole overflow is distributed to other
    /// pixels.
    float a = 0.01f;
    float b = 0.0f;
    float c = 1.0f;         ///< >= 0
    float riseTime = 0.05f; ///< [s] time constant for increasing glare; 0: glare increases at once
    float fallTime = 0.4f;  ///< [s] time constant for decreasing glare
};

/// Level of detail of distant effects. The simulation does not depend on these settings.
struct LodSettings
{
    /// [1] Number of pixels per drawn blob: an effect draws one blob per `bias` pixels of its disc on the
    /// picture, and at least twelve. The drawn blobs are enlarged to represent all blobs. 0: all blobs are
    /// drawn.
    float bias = 0.0f;

    /// [pixel] Largest radius on the picture at which an effect is drawn as an impostor; at most
    /// kMaxImpostorPixels. 0: no impostors.
    float impostorPixels = 0.0f;
    /// [pixel] Upper limit of impostorPixels. An impostor has 32 x 32 texels, including a margin.
    static constexpr float kMaxImpostorPixels = 13.0f;

    /// True: levels and impostors do not change when the camera moves. Only measurements use true.
    bool hold = false;

    bool operator==(const LodSettings&) const = default;
};

/// Settings of the impostors of blocks of medium. An impostor stands for all balls of a block.
struct BlockSettings
{
    /// [pixel] Largest shift of the front of a block against its middle, by which a tile may differ from the
    /// true direction, and largest motion of animated content until a tile is drawn again. 0: all balls are
    /// drawn.
    float parallax = 0.5f;
    float resolution = 1.0f; ///< texels of a tile per pixel, 0.25..4
    /// [pixel] Largest diameter on the picture of blocks that are drawn as impostors, up to kMaxPixels.
    float maxPixels = 96.0f;
    /// [1] Largest predicted root mean square error of an impostor, in units of white. 0: not limited.
    float error = 4.0f / 255.0f;
    static constexpr float kMaxPixels = 128.0f;
    static constexpr float kMaxParallax = 16.0f;

    bool operator==(const BlockSettings&) const = default;
};

/// Settings for all frames until the host changes the settings.
struct ViewSettings
{
    float exposureEv100 = 13.0f; ///< [EV100]
    Lighting lighting;
    HostLights hostLights;
    SliceSettings slices;
    ShimmerSettings shimmer;
    DazzleSettings dazzle;
    BillboardForm form = BillboardForm::Kernel;
    Composition composition = Composition::Sorted;
    int slabs = 16; ///< number of slabs along each ray, 6 or 16, for Composition::Slabs
    /// Number of voxels along 16 radii of an effect's balls, 16..256, for Composition::Volume.
    int voxels = 96;
    /// True: the renderer restores every GL state that it changes. False: the host restores the state.
    bool saveState = true;
    bool detail = true; ///< true: draw the procedural detail of blobs
    /// [1] Fraction of the particles that are drawn, (0, 1]. The drawn particles are enlarged to keep the
    /// total cross section.
    float particleShare = 1.0f;
    bool toneMap = false; ///< true: write display-referred values
    /// True: also write fire, smoke, dust, depth and optical depth to separate textures.
    bool layerOutputs = false;
    uint32_t outputs = 0; ///< bits of view_output; 0: no outputs are rendered, at no cost
    /// True: count contributing fragments and read statistics back. The count needs an additional pass and
    /// waits for the GPU.
    bool countOverdraw = false;
    LodSettings lod;
    BlockSettings blocks;
    /// True: draw the boxes of FrameRequest::overlay, which the caller of the renderer fills.
    bool overlay = false;
    /// Least divisor of layers: 1, 2 or 4. Media and transparent particles are drawn to layers, with at most
    /// 1, 1/2 or 1/4 of the picture's width and height. Opaque particles are always drawn at the full size.
    int layerDivisor = 1;
    /// Largest estimated number of fragments per frame. If the number is exceeded, the size of layers is
    /// reduced. 0: no limit.
    uint64_t fragmentBudget = 0;
};

/// The host's shadow map of the sun: depth of the host's opaque surfaces, rendered from the direction of the
/// sun.
struct HostShadowMap
{
    uint32_t texture = 0; ///< GL name of a 2-D depth texture; 0: surfaces cast no shadow on media
    DepthConvention depth = DepthConvention::Standard;
    /// Affine map from world position minus CameraView::origin [m] to texture coordinates and stored depth,
    /// each 0..1.
    glm::mat4 fromWorld{1.0f};
    float edge = 0.1f; ///< [m] radius over which shadow edges are blurred
};

/// Meaning of the values in the host's color targets.
enum class TargetEncoding : uint8_t
{
    Linear,      ///< exposed radiance
    DisplaySrgb, ///< display light 0..1, encoded by the curve of sRGB
    DisplayGamma ///< display light 0..1, encoded by a gamma of 2.2
};

/// GL names of the host's targets for one frame; 0 means absent.
struct HostTargets
{
    /// 2-D texture with the opaque picture [cd/m2 times exposure]; media are drawn into it
    uint32_t color = 0;
    uint32_t depth = 0; ///< 2-D depth texture of the opaque picture; 0: no surface occludes media
    /// GL name of a framebuffer. If useFramebuffer is true, media are blended into its attachment of draw
    /// buffer 0.
    uint32_t framebuffer = 0;
    bool useFramebuffer = false; ///< true: draw into `framebuffer` (0 is the window) instead of `color`
    int width = 0;               ///< [pixel]
    int height = 0;              ///< [pixel]
    int x = 0;                   ///< [pixel] left column of the frame in all targets
    int y = 0;                   ///< [pixel] low row of the frame in all targets
    TargetEncoding encoding = TargetEncoding::Linear;
    /// [1] exposed radiance, >= 1, that the host has drawn as 1, for display encodings
    float displayWhite = 2.0f;
    bool depthFromFramebuffer = false; ///< true: depth is the depth attachment of `framebuffer`
    bool keepScissor = false;          ///< true: the host's scissor test limits writes to the target

    bool isDisplay() const { return encoding != TargetEncoding::Linear; }
};

/// Maps ids of instances in snapshots to the host's ids. Without a function, the ids are equal.
struct InstanceNames
{
    uint64_t (*name)(const void* owner, uint64_t instance) = nullptr;
    const void* owner = nullptr;

    uint64_t of(uint64_t instance) const { return name ? name(owner, instance) : instance; }
};

/// A box whose edges are drawn in the activation overlay.
struct OverlayBox
{
    glm::vec4 centerHalf; ///< [m] xyz center relative to the camera's origin; w half of the side
    glm::vec4 color;      ///< color, premultiplied, in the unit of the picture
};

/// Part of the depth that a call draws. The calls of one frame draw adjacent ranges, the farthest first.
struct DepthRange
{
    static constexpr float kUnlimited = std::numeric_limits<float>::infinity();

    float from = -kUnlimited; ///< [m] depth along the view axis; media nearer than this are not drawn
    float to = kUnlimited;    ///< [m] depth along the view axis; media farther than this are not drawn
    /// True: the last call has drawn another range of the same frame, with the same snapshots and camera.
    /// Everything that it gathered, uploaded and computed is used again.
    bool isContinued = false;
    bool isLast = true; ///< true: shimmer, glare and tone mapping complete the picture
};

/// Input of one frame.
struct FrameRequest
{
    CameraView camera;
    HostTargets targets;
    HostShadowMap sunShadow;
    /// [s] time since the last frame of this view; used only for the adaptation of glare
    double deltaTime = 0.0;
    double interpolation = 1.0; ///< [0, 1] moment between the older and the newer snapshot
    double time = 0.0;          ///< [s] scene time, which animates noise
    bool resetHistory = false;  ///< true: the camera has jumped, so that adaptation starts from this frame
    std::span<const OverlayBox> overlay{}; ///< boxes that are drawn over the finished picture
    InstanceNames instances;               ///< maps ids for ViewSettings::outputs; constant for a scene
    DepthRange range;
};

/// Counters of one rendered frame. Counts are exact, except where the comment says "estimated".
struct FrameStatistics
{
    uint32_t blobs = 0;          ///< blobs that were drawn
    uint32_t blobsCulled = 0;    ///< blobs that were omitted because they are outside of the view
    uint32_t blobsNonFinite = 0; ///< blobs that were omitted because a value was not finite
    uint32_t blobsThinned = 0;   ///< blobs that the level of detail omitted
    uint32_t impostors = 0;      ///< effects drawn as impostors
    uint32_t impostorsTaken = 0; ///< number of impostor images rendered in this frame
    /// Number of groups of blobs with a drawn fraction of 1; at least 1/2; at least 1/8; less than 1/8.
    uint32_t lodGroups[4] = {0, 0, 0, 0};
    uint64_t particles = 0;        ///< drawn sprites, meshes and pieces of ribbons
    uint64_t sprites = 0;          ///< number of sprites in `particles`
    uint64_t meshes = 0;           ///< number of meshes in `particles`
    uint64_t ribbonPieces = 0;     ///< number of pieces of ribbons in `particles`
    uint64_t gpuParticles = 0;     ///< drawn particles whose rows the GPU computed
    uint64_t particlesThinned = 0; ///< particles that the level of detail omitted
    uint64_t particlesOrdered = 0; ///< drawn particles that were sorted by depth or age
    /// [byte] Size of the data of blobs and particles that were uploaded for this frame.
    uint64_t uploadedBytes = 0;
    /// [byte] Size of the rows that were uploaded for earlier steps and are reused.
    uint64_t keptRowBytes = 0;
    /// [byte] size of the rows that were not uploaded because another group has equal rows
    uint64_t sharedRowBytes = 0;
    uint64_t sortedElements = 0; ///< number of elements that were sorted by distance or age for this frame
    /// True: the gathered, sorted and uploaded data of the last frame were reused.
    bool keptLists = false;
    uint32_t passes = 0; ///< number of executed passes
    uint64_t glCalls = 0;
    uint32_t drawCalls = 0;
    /// Number of programs that were compiled during this frame; 0 after warm-up.
    uint32_t programsCompiled = 0;
    uint64_t textureBytes = 0; ///< [byte] size of the textures that the view has allocated
    /// [byte] size of the frame's transient resources if they did not share memory
    uint64_t unsharedBytes = 0;
    uint64_t sharedBytes = 0;   ///< [byte] size of the frame's transient resources, which share memory
    uint64_t coveredPixels = 0; ///< texels of layers that media cover; counted only with countOverdraw
    /// Contributing fragments at the size of layers; counted only with countOverdraw.
    uint64_t shadedFragments = 0;
    /// Estimated fragments of the bounding rectangles of blobs and particles, at the size of layers.
    uint64_t estimatedFragments = 0;
    /// divisor of layers in this frame: ViewSettings::layerDivisor, or larger to keep within fragmentBudget
    int layerDivisor = 1;
    /// Entries in the lists of all tiles. listedBalls, spilledBalls and spilledCards are set only with
    /// countOverdraw.
    uint64_t listedBalls = 0;
    /// Entries that were dropped because lists were full. The listed balls are weighted to represent the
    /// dropped balls.
    uint64_t spilledBalls = 0;
    /// Fragments of sprites, ribbons and impostors that were dropped because lists were full.
    uint64_t spilledCards = 0;
    Composition composition = Composition::Sorted;
    /// Number of slabs or voxels in the settings of the composition; 0 for Composition::Sorted.
    uint32_t compositionSize = 0;
    /// Mean overflow per pixel in units of DazzleSettings::white; set only with countOverdraw and dazzle.
    double overflow[3] = {0, 0, 0};
    uint32_t blocks = 0;         ///< block types of the visible effects; each phase in use counts
    uint32_t blockInstances = 0; ///< blocks of the visible effects, at all levels of their hierarchies
    uint64_t blockParticles = 0; ///< blobs to which these blocks expand
    /// Blobs of blocks that are missing because they are beyond the bounds of their effects.
    uint64_t blockParticlesRefused = 0;
    uint32_t blockImpostors = 0;     ///< blocks that were drawn as impostors
    uint32_t blockTilesDrawn = 0;    ///< tiles that were drawn in this frame
    uint32_t blockTilesDeferred = 0; ///< impostors with the tile of a neighboring direction or moment
};

} // namespace fx::render
