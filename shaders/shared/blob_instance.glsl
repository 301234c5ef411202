// A blob as drawn; written by rendering/media/frame_builder.cpp, layout asserted in rendering/passes/blob_instance.h.
struct BlobInstance
{
    vec4 centerRadius; // xyz [m] relative to the eye, world axes; w radius [m]
    vec4 medium;       // x cross section [m2]; y heat [K]; z detail amount [1]; w seed of the detail [0, 1)
    vec4 scatter;      // rgb albedo; w mean cosine of the phase function
    vec4 layer;        // x layer * 2 + share of fire; y rank, for lists without room for all;
                       // z number of the tile + 1, see blocks/block_chord.glsl, 0: the quartic kernel
    vec4 emission;     // rgb emitted light [exposed]; w power of temperature by which it follows the detail
    vec4 lit;          // xyz [m] where the ball is lit, relative to the eye; w noise periods across the radius, or -1 minus
                       // those of a ball in a picture, which is lit in its center alone
};

layout(std430, binding = 0) readonly buffer BlobBuffer
{
    BlobInstance blobs[];
};
