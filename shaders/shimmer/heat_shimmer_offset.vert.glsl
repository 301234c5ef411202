#include "shared/view_block.glsl"
#include "shared/blob_instance.glsl"
#include "shared/blob_quad.glsl"

// One covering rectangle a hot blob; cold ones fall outside of the window.
flat out vec4 blobCenterRadius;
flat out vec2 blobHeatSeed;

void main()
{
    BlobInstance blob = blobs[gl_InstanceID];
    blobCenterRadius = blob.centerRadius;
    blobHeatSeed = blob.medium.yw;
    gl_Position = blob.medium.y > 0.0 ? blobQuadCorner(blob.centerRadius.xyz, blob.centerRadius.w, gl_VertexID)
                                      : vec4(2.0, 2.0, 0.5, 1.0);
}
