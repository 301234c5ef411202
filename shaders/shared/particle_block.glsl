// A group of particles or ribbons within a view; filled from rendering/passes/particle_batch.h, which asserts this layout.
//
// placePosition   xyz [m] origin of the group relative to the eye, world axes; w scale
// placeRotation   quaternion x, y, z, w from the group's axes to the world's
// alignAxis       xyz world unit axis; w SpriteAlignment
// appearance      x aspect, of ribbons the age at which they end [s]; y stretch [s]; z softness [m]; w ParticleBlend
// shine           x exposed luminance of color 1; y share of the view's light scattered; z MediaLayer; w 1 when the first index of a mesh
//                 is at meshPlace.x
// moment          x share of the newer snapshot; y seconds between both; z 1 when there is an older one; w least radius [pixel]
// atlas           x frames; y 1 to mix frames; z motion of a vector of 1 [frame]; w 1 with texture
// strip           x 1 with motion vectors; y length of a ribbon for one width of texture [m], 0: its own;
//                 z OrderForm: which rows are drawn, and how; w share of a ribbon's half width that is soft
// newerAt         places of the columns in the newer rows, in words of 4 bytes; -1: not there. olderAt the same in the older
// rows            x rows of the newer; y of the older; z first of this draw; w first index of the mesh in words
// Where FX_MARKS is defined:
// drift           rows of a matrix: velocity of a point of the group's axes that rests in them, relative to the world [m/s]
// markInstance    xy id of the instance, low word first
#ifdef FX_MARKS
#define FX_MARK_EXTRA \
    vec4 drift[3]; \
    uvec4 markInstance;
#else
#define FX_MARK_EXTRA
#endif
#define FX_VIEW_EXTRA \
    vec4 placePosition; \
    vec4 placeRotation; \
    vec4 alignAxis; \
    vec4 appearance; \
    vec4 shine; \
    vec4 moment; \
    vec4 atlas; \
    vec4 strip; \
    ivec4 newerAt[4]; \
    ivec4 olderAt[4]; \
    ivec4 rows; \
    FX_MARK_EXTRA
