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

/// Mapping of distance to depth-buffer values. Read from the host, never changed.
enum class DepthConvention : uint8_t
{
    Standard, ///< near maps to the smaller value
    Reversed, ///< near maps to 1, the far plane or infinity to 0
};

/// Camera of one frame. The matrices are relative to `origin`, so that floats stay exact far from the world's
/// center.
struct CameraView
{
    glm::dvec3 origin{0.0};     ///< [m] world position that the matrices are relative to
    glm::mat4 view{1.0f};       ///< rigid; right-handed, looks along -Z
    glm::mat4 projection{1.0f}; ///< perspective or orthographic, infinite far plane allowed
    DepthConvention depth = DepthConvention::Standard;
    bool zeroToOne = false; ///< clip space z in [0, w] (glClipControl GL_ZERO_TO_ONE) instead of [-w, w]
    bool upperLeftOrigin = false; ///< glClipControl GL_UPPER_LEFT

    bool operator==(const CameraView&) const = default;
};

/// How a blob's optical depth is computed along the ray.
enum class BillboardForm : uint8_t
{
    Planar,   ///< flat card, opacity from the distance to the center only; the classical particle
    Constant, ///< homogeneous ball of the same total extinction; [USS06]
    Kernel,   ///< the gas's own quartic kernel, exact clipped integral
};

/// How media that overlap are put together; rendering/compositions has an entry for each but Automatic.
enum class Composition : uint8_t
{
    Sorted,    ///< one ball or card after the other, farthest first
    Slabs,     ///< in slabs across each ray, in which all are summed up: no order is seen
    Volume,    ///< balls of an effect are summed up in voxels, through which rays march: no order is seen
    Automatic, ///< the composition that the visible effects prefer; the caller of the renderer states it
};
constexpr size_t kCompositionCount = size_t(Composition::Automatic);

/// `asked`, or `preferred` where it is Automatic.
inline Composition resolved(Composition asked, Composition preferred)
{
    return asked == Composition::Automatic ? preferred : asked;
}

/// Bits of ViewSettings::outputs. Each adds a picture of reference data, such as motion or depth.
namespace view_output {
enum : uint32_t
{
    InstanceId = 1,   ///< of what has the largest share of the pixel
    Motion = 2,       ///< [pixel] since the frame before
    FirstDepth = 4,   ///< [m] where media begin to be seen
    MeanDepth = 8,    ///< [m] mean distance of visible particles
    OpticalDepth = 16 ///< [1] of the media
};
constexpr size_t kCount = 5;
constexpr uint32_t kAll = (1u << kCount) - 1;
} // namespace view_output

/// One directional light, and light from everywhere.
struct Lighting
{
    glm::vec3 sunDirection{0.3f, 0.8f, 0.5f}; ///< towards the light, unit
    glm::vec3 sunIlluminance{0.0f}; ///< [lx] perpendicular to the direction, linear Rec. 709 weighted
    glm::vec3 skyLuminance{0.0f};   ///< [cd/m2] from all directions
    float groundAlbedo = 0.2f;      ///< [1] of the ground's reflected light from below

    bool operator==(const Lighting&) const = default;
};

/// A light of the host: a glowing ball, or a spot.
struct HostLight
{
    glm::dvec3 position{0.0};  ///< [m] world
    glm::vec3 intensity{0.0f}; ///< [cd] in the direction of its maximum
    float radius = 0.05f;      ///< [m] > 0, of the ball that glows
    glm::vec3 axis{0, -1, 0};  ///< unit, where a spot shines
    float cosInner = -1.0f;    ///< [1] of the angle up to which a spot has its full intensity
    float cosOuter = -1.0f;    ///< [1] of the angle from which on it has none; -1: light in all directions

    bool operator==(const HostLight&) const = default;
};

constexpr size_t kMaxHostLights = 8;

struct HostLights
{
    HostLight lights[kMaxHostLights];
    size_t count = 0;

    bool operator==(const HostLights&) const = default;
};

/// Size of the planes of a light.
struct SliceResolution
{
    /// Along a side of a plane of the sun, 8..512, a multiple of 8; half as many for point lights.
    int texels = 128;
    int planes = 32; ///< 3..128; fewer become 3, 0: media cast no shadow

    bool operator==(const SliceResolution&) const = default;
};

/// Light slices: shadows of media on media and on the host's surfaces.
struct SliceSettings
{
    bool enabled = true;
    SliceResolution resolution;
    int castingPoints = 2; ///< 0..4 lights at points that cast shadows through media, those that light most
    int samples = 2;       ///< 1..4 points of a ray through a ball at which light is looked up
    bool multiple = true;  ///< light that is scattered more than once counts
    bool network = false;  ///< by an illumination network, where media are drawn in voxels; else by a formula
    /// `multiple` and `network` are what the visible effects prefer; the caller of the renderer sets them.
    bool automatic = false;
    uint8_t networkCells = 0; ///< 24..64 along a side of its grids, a multiple of 8; 0: a third of the voxels
    int refreshFrames = 1;    ///< 1..16 frames after which planes follow media that move

    /// Texels and planes are fixed in the world; false: they follow media and eye, to measure the difference.
    bool snapped = true;

    bool operator==(const SliceSettings&) const = default;
};

/// Heat shimmer.
struct ShimmerSettings
{
    float strength = 1.0f;   ///< [1] scales every offset; 0 does not change the picture, bit for bit
    float maxOffset = 12.0f; ///< [pixel] at a height of 720 pixels
};

/// Glare by overflow redistribution, [UBT96].
struct DazzleSettings
{
    bool enabled = true;
    float white = 8.0f; ///< [1] exposed value at which the sensor saturates, > 0
    float a = 0.01f; ///< sensor law f(over) = over (A + B exp(-C over)), over in units of `white` per pixel;
                     ///< a clean lens spreads about a hundredth, 1 spreads all that is too bright
    float b = 0.0f;
    float c = 1.0f;         ///< >= 0
    float riseTime = 0.05f; ///< [s] time constant when glare grows; 0 is immediate
    float fallTime = 0.4f;  ///< [s] when it fades
};

/// Level of detail of distant effects. The simulation does not depend on it.
struct LodSettings
{
    /// [1] pixels of an effect's disc on the picture for which it keeps one blob, at least twelve blobs in
    /// all, which take over the light of the others; 0: all are drawn.
    float bias = 0.0f;

    /// [pixel] effects with a smaller radius on the picture are drawn as impostors, at most
    /// kMaxImpostorPixels; 0: none.
    float impostorPixels = 0.0f;
    static constexpr float kMaxImpostorPixels = 13.0f; ///< a picture has 32 texels, some of them a margin

    /// Levels and impostors do not change, for any camera motion: to measure the effect of their changes on
    /// the picture.
    bool hold = false;

    bool operator==(const LodSettings&) const = default;
};

/// Settings of all frames until the host changes them.
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
    int slabs = 16;        ///< 6 or 16 along each ray, of Composition::Slabs
    int voxels = 96;       ///< 16..256 along 16 radii of an effect's balls, of Composition::Volume
    bool saveState = true; ///< restore every GL state that is touched; false: the host does
    bool detail = true;    ///< procedural detail of blobs
    float particleShare =
        /// [1] (0, 1], share of the particles that are drawn; they take over the cross section of the others.
        1.0f;
    bool toneMap = false;      ///< write display-referred values
    bool layerOutputs = false; ///< keep fire, smoke, dust, depth and optical depth as textures of their own
    uint32_t outputs = 0;      ///< view_output bits; 0: no pass, program or memory exists for them
    bool countOverdraw =
        false; ///< count contributing fragments and read statistics back: costs a pass and waits for the GPU
    LodSettings lod;
    bool overlay = false; ///< the host of the renderer fills FrameRequest::overlay
    /// 1, 2, 4: media and transparent particles are drawn at no more than 1, 1/2, 1/4 of the width and
    /// height; opaque ones always at 1.
    int layerDivisor = 1;
    uint64_t fragmentBudget = 0; ///< estimated fragments a frame above which they are drawn smaller; 0: never
};

/// The host's shadow map of the sun: depth of its opaque surfaces as the sun sees them.
struct HostShadowMap
{
    uint32_t texture = 0; ///< GL name of a 2-D depth texture; 0: the sun reaches all media
    DepthConvention depth = DepthConvention::Standard;
    /// World minus CameraView::origin [m] to texture coordinates and stored depth, each 0..1; affine.
    glm::mat4 fromWorld{1.0f};
    float edge = 0.1f; ///< [m] radius of the soft edge
};

/// GL names of the host's targets for one frame; 0 means absent.
struct HostTargets
{
    uint32_t color =
        0; ///< 2-D texture, already holding the opaque picture [cd/m2 times exposure]; read and written
    uint32_t depth = 0; ///< 2-D depth texture of the opaque picture; 0: nothing occludes
    uint32_t framebuffer =
        0; ///< used instead of `color` when that is 0: the attachment of draw buffer 0 is blended into
    bool useFramebuffer = false; ///< true: draw into `framebuffer` (0 is the window) instead of `color`
    int width = 0;               ///< [pixel]
    int height = 0;              ///< [pixel]
};

/// How ids of instances are called outside; without a function they are called as in snapshots.
struct InstanceNames
{
    uint64_t (*name)(const void* owner, uint64_t instance) = nullptr;
    const void* owner = nullptr;

    uint64_t of(uint64_t instance) const { return name ? name(owner, instance) : instance; }
};

/// A box of which the activation overlay draws the edges.
struct OverlayBox
{
    glm::vec4 centerHalf; ///< [m] center relative to the camera's origin; half of the side
    glm::vec4 color;      ///< premultiplied, in the picture's own unit
};

/// One frame.
struct FrameRequest
{
    CameraView camera;
    HostTargets targets;
    HostShadowMap sunShadow;
    double deltaTime = 0.0;                ///< [s] since this view's last frame, for adaptation only
    double interpolation = 1.0;            ///< [0, 1] between the older and the newer snapshot
    double time = 0.0;                     ///< [s] scene time, drives moving noise
    bool resetHistory = false;             ///< camera cut: adaptation starts from this frame
    std::span<const OverlayBox> overlay{}; ///< drawn over the finished picture
    InstanceNames instances;               ///< of ViewSettings::outputs; those of a scene do not change
};

/// Counters of one rendered frame; exact counts except for the times.
struct FrameStatistics
{
    uint32_t blobs = 0;                   ///< drawn after culling
    uint32_t blobsCulled = 0;             ///< outside the view
    uint32_t blobsNonFinite = 0;          ///< dropped because a value was not finite
    uint32_t blobsThinned = 0;            ///< left to others by the level of detail
    uint32_t impostors = 0;               ///< effects drawn as pictures of themselves
    uint32_t impostorsTaken = 0;          ///< pictures taken anew for this frame
    uint32_t lodGroups[4] = {0, 0, 0, 0}; ///< groups of blobs drawn in full; at least half, an eighth; less
    uint64_t particles = 0;               ///< sprites, meshes and pieces of ribbons that were drawn
    uint64_t sprites = 0;                 ///< of them
    uint64_t meshes = 0;                  ///< of them
    uint64_t ribbonPieces = 0;            ///< of them
    uint64_t gpuParticles = 0;            ///< rows of those that the GPU computed
    uint64_t particlesThinned = 0;        ///< left to others by the level of detail
    uint64_t particlesOrdered = 0;        ///< sorted by depth or age, of those drawn
    uint64_t uploadedBytes = 0;           ///< [byte] of blobs and particles, written for this frame
    uint64_t keptRowBytes = 0;            ///< [byte] of rows kept from earlier steps
    uint64_t sharedRowBytes = 0;          ///< [byte] of rows that are the same as another group's of the step
    uint64_t sortedElements = 0;          ///< put into an order of distance or age for this frame
    /// Gathered, sorted and uploaded data of the last frame were reused.
    bool keptLists = false;
    uint32_t passes = 0; ///< executed
    uint64_t glCalls = 0;
    uint32_t drawCalls = 0;
    uint32_t programsCompiled = 0;   ///< during this frame; 0 after warm-up
    uint64_t textureBytes = 0;       ///< [byte] held by the view
    uint64_t unsharedBytes = 0;      ///< [byte] of the frame's own resources if none shared memory
    uint64_t sharedBytes = 0;        ///< [byte] of the same with shared memory
    uint64_t coveredPixels = 0;      ///< texels of the media's layers; with countOverdraw
    uint64_t shadedFragments = 0;    ///< at the layers' scale; with countOverdraw
    uint64_t estimatedFragments = 0; ///< of the rectangles of blobs and particles, at the layers' scale
    int layerDivisor = 1;            ///< of this frame: that of the settings, or more to keep the budget
    uint64_t listedBalls = 0; ///< in lists of tiles, one for each tile; with countOverdraw, as the next two
    uint64_t spilledBalls =
        0; ///< missing from the lists because they were full; the listed ones are weighted to replace them
    /// Fragments of sprites, ribbons and impostors that were left out because lists were full.
    uint64_t spilledCards = 0;
    Composition composition = Composition::Sorted;
    uint32_t compositionSize = 0; ///< slabs or voxels; 0: sorted
    double overflow[3] = {0, 0,
                          0}; ///< with countOverdraw and dazzle: mean overflow per pixel, units of white
};

} // namespace fx::render
