// A blob as drawn; written by rendering/media/frame_builder.cpp, layout asserted in rendering/passes/blob_instance.h.
struct BlobInstance
{
    vec4 centerRadius; // xyz [m] relative to the eye, world axes; w radius [m]
    vec4 medium;       // x cross section [m2]; y heat [K]; z detail amount [1]; w seed of the detail [0, 1)
    vec4 sun;          // rgb light scattered to the eye from the sun [exposed]; w noise periods across the radius [1]
    vec4 sky;          // rgb light scattered from everywhere else [exposed]; w layer * 2 + share of fire
    vec4 emission;     // rgb emitted light [exposed]; w power of temperature by which it follows the detail
};

layout(std430, binding = 0) readonly buffer BlobBuffer
{
    BlobInstance blobs[];
};
